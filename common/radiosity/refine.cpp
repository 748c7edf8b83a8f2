#include "radiosity/refine.h"

#include <algorithm>
#include <cmath>

#include "base/random.h"

namespace radfarm {
namespace {

constexpr std::uint64_t kFinalKey = 0x66696e616c;  // "final"

constexpr float kLeastReflectance = 0.5F;

/// What one round of refinement works with.
struct Round {
  const World& world;
  Hierarchy& hierarchy;
  NodePower& reflected;
  const RadiositySettings& settings;
  double max_error;       // lm
  float min_patch_area;   // m^2
  std::uint64_t seed;
};

double sender_emits(const Round& round, const Link& link) {
  if (is_source(link.sender)) return 1;  // its strength is in the factor
  return static_cast<double>(luminance(round.hierarchy.nodes[link.sender].emitted_power));
}

double sender_reflects(const Round& round, const Link& link) {
  return is_source(link.sender) ? 0 : static_cast<double>(luminance(round.reflected[link.sender]));
}

/// Power that the link may misplace, lm: rho A_r F D P. Light that a dark receiver swallows is light that others do not
/// get, all the more since what is sent is normalised: rho counts as at least kLeastReflectance.
double misplaced_power(const Round& round, const Link& link) {
  const Node& receiver = round.hierarchy.nodes[link.receiver];
  const float reflectance = std::max(max_component(receiver.reflectance), kLeastReflectance);
  const auto receives = static_cast<double>(reflectance * receiver.area);
  return receives * (static_cast<double>(link.emitted_error) * sender_emits(round, link) +
                    static_cast<double>(link.reflected_error) * sender_reflects(round, link));
}

/// Whether the sender has light now that the link was not evaluated for.
bool is_outdated(const Round& round, const Link& link) {
  return ((link.evaluated & kEmittedPart) == 0 && sender_emits(round, link) > 0) ||
         ((link.evaluated & kReflectedPart) == 0 && sender_reflects(round, link) > 0);
}

Link evaluate(const Round& round, const Link& link) {
  if (is_source(link.sender)) {
    return evaluate_source(round.world, round.hierarchy, link.receiver, source_index(link.sender),
                             round.settings.samples_per_link, round.seed, round.settings.oracle);
  }
  const std::uint32_t parts = (sender_emits(round, link) > 0 ? kEmittedPart : 0) |
                              (sender_reflects(round, link) > 0 ? kReflectedPart : 0);
  return evaluate_link(round.world, round.hierarchy, link.receiver, link.sender, parts,
                       round.settings.samples_per_link, round.seed, round.settings.oracle);
}

bool can_split(const Round& round, std::uint32_t node) {
  const Node& n = round.hierarchy.nodes[node];
  return n.child_count > 0 || n.area > 4 * round.min_patch_area;
}

/// The children of a node, cut first if it is a whole patch.
std::pair<std::uint32_t, std::uint32_t> children(const Round& round, std::uint32_t node) {
  if (round.hierarchy.nodes[node].child_count == 0) {
    subdivide(round.hierarchy, node);
    // The four parts reflect what the whole did, by area.
    const Node& whole = round.hierarchy.nodes[node];
    for (std::uint32_t i = 0; i < whole.child_count; ++i) {
      const float share = round.hierarchy.nodes[whole.first_child + i].area / whole.area;
      round.reflected.push_back(round.reflected[node] * share);
    }
  }
  const Node& n = round.hierarchy.nodes[node];
  return {n.first_child, n.child_count};
}

enum class Cut { kNone, kReceiver, kSender, kBoth };

Cut choose_cut(const Round& round, const Link& link) {
  if (link.receiver == link.sender) {
    return round.hierarchy.nodes[link.receiver].is_cluster() ? Cut::kBoth : Cut::kNone;
  }
  const bool receiver = can_split(round, link.receiver);
  if (is_source(link.sender)) return receiver ? Cut::kReceiver : Cut::kNone;
  const bool sender = can_split(round, link.sender);
  if (!receiver && !sender) return Cut::kNone;
  if (!sender) return Cut::kReceiver;
  if (!receiver) return Cut::kSender;
  const float receiver_size = length(round.hierarchy.nodes[link.receiver].bounds.size());
  const float sender_size = length(round.hierarchy.nodes[link.sender].bounds.size());
  return receiver_size >= sender_size ? Cut::kReceiver : Cut::kSender;
}

void push_candidate(const Round& round, std::uint32_t receiver, std::uint32_t sender, std::vector<Link>& next) {
  if (!is_source(sender) && receiver != sender && cannot_see(round.hierarchy, receiver, sender)) return;
  if (receiver == sender && !round.hierarchy.nodes[receiver].is_cluster()) return;
  Link link;
  link.receiver = receiver;
  link.sender = sender;
  next.push_back(link);
}

void split_link(const Round& round, const Link& link, Cut cut, std::vector<Link>& next) {
  std::pair<std::uint32_t, std::uint32_t> receivers(link.receiver, 1), senders(link.sender, 1);
  if (cut == Cut::kReceiver || cut == Cut::kBoth) receivers = children(round, link.receiver);
  if (cut == Cut::kSender || cut == Cut::kBoth) senders = children(round, link.sender);
  for (std::uint32_t r = 0; r < receivers.second; ++r) {
    for (std::uint32_t s = 0; s < senders.second; ++s) {
      push_candidate(round, receivers.first + r, senders.first + s, next);
    }
  }
}

/// Light that the link may misplace, lm. Of a cluster's light to itself all: its oracle sees no directions.
double link_error(const Round& round, const Link& link) {
  if (link.receiver != link.sender) return misplaced_power(round, link);
  const Node& node = round.hierarchy.nodes[link.receiver];
  const double own = sender_emits(round, link) + sender_reflects(round, link);
  return own * static_cast<double>(max_component(node.reflectance));
}

/// A link that is to be split, and by how many links that makes more.
struct Wish {
  double error = 0;
  std::size_t link = 0;
  std::size_t growth = 0;
};

std::size_t parts_of(const Round& round, std::uint32_t node, bool is_cut) {
  if (!is_cut) return 1;
  return round.hierarchy.nodes[node].is_cluster() ? 2 : 4;
}

/// How each candidate is cut. Where there is not room for all, a level takes half of what is left, for the links that may misplace
/// most (by number where equal): what lies deeper may be worse still.
std::vector<Cut> choose_cuts(const Round& round, const std::vector<Link>& candidates, std::size_t room) {
  std::vector<Cut> cuts(candidates.size(), Cut::kNone);
  std::vector<Wish> wishes;
  std::size_t growth = 0;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const Link& link = candidates[i];
    const double error = link_error(round, link);
    if (error < round.max_error) continue;
    cuts[i] = choose_cut(round, link);
    if (cuts[i] == Cut::kNone) continue;
    const bool is_both = cuts[i] == Cut::kBoth;
    wishes.push_back({error, i, parts_of(round, link.receiver, is_both || cuts[i] == Cut::kReceiver) *
                                    (is_source(link.sender) ? 1 : parts_of(round, link.sender, is_both || cuts[i] == Cut::kSender)) - 1});
    growth += wishes.back().growth;
  }
  if (growth <= room / 2) return cuts;
  std::sort(wishes.begin(), wishes.end(), [](const Wish& a, const Wish& b) { return a.error != b.error ? a.error > b.error : a.link < b.link; });
  growth = 0;
  for (const Wish& wish : wishes) {
    growth += wish.growth;
    if (growth > room / 2) cuts[wish.link] = Cut::kNone;
  }
  return cuts;
}

}  // namespace

std::vector<Link> initial_links(const World& world, const Hierarchy& hierarchy) {
  std::vector<Link> links;
  if (hierarchy.nodes.empty()) return links;
  links.emplace_back();
  for (std::uint32_t i = 0; i < source_count(world); ++i) {
    links.emplace_back();
    links.back().sender = source_sender(i);
  }
  return links;
}

std::size_t refine(const World& world, Hierarchy& hierarchy, NodePower& reflected, std::vector<Link>& links,
                   const RadiositySettings& settings, double emitted_flux, std::uint64_t seed,
                   const Progress& progress) {
  if (hierarchy.nodes.empty()) return 0;
  const Round round{world, hierarchy, reflected, settings, static_cast<double>(settings.max_link_error) * emitted_flux,
                    settings.min_patch_area * hierarchy.nodes[0].area, seed};
  set_reflected_power(hierarchy, reflected);
  // What a cluster sends where depends on which of its patches are lit: measured again with the light known now.
  for (Link& link : links) {
    if (!is_source(link.sender) && hierarchy.nodes[link.sender].is_cluster()) link.evaluated &= ~kReflectedPart;
  }
  std::vector<Link> accepted, candidates = std::move(links), next;
  std::size_t splits = 0;
  while (!candidates.empty() && !progress.is_cancelled()) {
    parallel_for(progress, "radiosity: links", candidates.size(), 256, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        Link& link = candidates[i];
        if (is_outdated(round, link)) link = evaluate(round, link);
      }
    });
    next.clear();
    const std::size_t links_now = accepted.size() + candidates.size();
    const std::size_t room = links_now < settings.max_links ? settings.max_links - links_now : 0;
    const std::vector<Cut> cuts = choose_cuts(round, candidates, room);
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      if (cuts[i] == Cut::kNone) {
        accepted.push_back(candidates[i]);
      } else {
        split_link(round, candidates[i], cuts[i], next);
        ++splits;
      }
    }
    candidates.swap(next);
  }
  links = std::move(accepted);
  return splits;
}

void measure_again(const World& world, Hierarchy& hierarchy, const NodePower& reflected, std::vector<Link>& links,
                   const RadiositySettings& settings, std::uint64_t seed, const Progress& progress) {
  set_reflected_power(hierarchy, reflected);
  std::erase_if(links, [&](const Link& link) {
    return is_source(link.sender) || !(luminance(reflected[link.sender]) > 0);
  });
  parallel_for(progress, "radiosity: measuring links", links.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      links[i] = evaluate_link(world, hierarchy, links[i].receiver, links[i].sender, kReflectedPart,
                               settings.samples_per_link, combine(seed, kFinalKey));
    }
  });
  std::erase_if(links, [](const Link& link) { return link.reflected == 0; });
}

}  // namespace radfarm
