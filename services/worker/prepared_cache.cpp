#include "worker/prepared_cache.h"

#include <algorithm>
#include <utility>

#include "base/digest.h"
#include "rpc/limits.h"

namespace radfarm {
namespace {

constexpr std::size_t kKept = 2;  // views kept open: the present job and the one before

}  // namespace

/// A view and the files that it reads in place.
struct PreparedCache::Opened {
  MappedFile scene, solution, view;
  Prepared prepared;
};

Result<std::shared_ptr<const Prepared>> PreparedCache::get(const TaskInputs& inputs) {
  std::unique_lock lock(mutex_);
  const auto found =
      std::find_if(slots_.begin(), slots_.end(), [&](const auto& slot) { return slot->inputs == inputs; });
  std::shared_ptr<Slot> slot;
  if (found != slots_.end()) {
    slot = *found;
    slots_.splice(slots_.begin(), slots_, found);
    ready_.wait(lock, [&] { return slot->ready; });
  } else {
    slot = std::make_shared<Slot>();
    slot->inputs = inputs;
    slots_.push_front(slot);
    while (slots_.size() > kKept) slots_.pop_back();
    lock.unlock();
    auto opened = open(inputs);
    lock.lock();
    slot->opened = std::move(opened);
    slot->ready = true;
    if (!slot->opened) slots_.remove(slot);  // the next task tries again
    ready_.notify_all();
  }
  if (!slot->opened) return tl::unexpected(slot->opened.error());
  return std::shared_ptr<const Prepared>(*slot->opened, &(*slot->opened)->prepared);
}

Result<MappedFile> PreparedCache::fetch(const std::string& digest) const {
  if (!store_.contains(digest)) {
    RADFARM_TRY(const std::vector<std::byte> bytes, client_.download(digest, limits::kBlobBytes));
    RADFARM_TRY([[maybe_unused]] const BlobRef blob, store_.put(bytes));
  }
  return store_.read(digest);
}

Result<std::shared_ptr<PreparedCache::Opened>> PreparedCache::open(const TaskInputs& inputs) const {
  RADFARM_TRY(MappedFile scene, fetch(inputs.scene));
  MappedFile solution;
  if (!inputs.solution.empty()) {
    RADFARM_TRY(solution, fetch(inputs.solution));
  }
  RADFARM_TRY(MappedFile view, fetch(inputs.view));
  RADFARM_TRY(Prepared prepared, Prepared::open(scene.bytes(), solution.bytes(), view.bytes()));
  return std::make_shared<Opened>(std::move(scene), std::move(solution), std::move(view), std::move(prepared));
}

}  // namespace radfarm
