#include "worker/held_leases.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace radfarm {

void HeldLeases::add(std::vector<Lease> leases) {
  std::move(leases.begin(), leases.end(), std::back_inserter(waiting_));
}

std::optional<Lease> HeldLeases::start() {
  if (waiting_.empty()) return std::nullopt;
  Lease lease = std::move(waiting_.front());
  waiting_.pop_front();
  running_.insert(lease.token);
  return lease;
}

void HeldLeases::lose(const std::vector<std::string>& tokens) {
  const std::set<std::string> gone(tokens.begin(), tokens.end());
  std::erase_if(waiting_, [&](const Lease& lease) { return gone.contains(lease.token); });
  lost_.insert(gone.begin(), gone.end());
  std::erase_if(lost_, [&](const std::string& token) { return !running_.contains(token); });
}

std::vector<Lease> HeldLeases::drop_waiting() {
  std::vector<Lease> dropped(std::make_move_iterator(waiting_.begin()), std::make_move_iterator(waiting_.end()));
  waiting_.clear();
  return dropped;
}

std::vector<std::string> HeldLeases::tokens() const {
  std::vector<std::string> tokens;
  for (const Lease& lease : waiting_) tokens.push_back(lease.token);
  std::set_difference(running_.begin(), running_.end(), lost_.begin(), lost_.end(), std::back_inserter(tokens));
  return tokens;
}

}  // namespace radfarm
