#include "fairway/inclusion/follow_prover.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "fairway/base/error.hpp"
#include "fairway/inclusion/contract_verdicts.hpp"
#include "fairway/inclusion/leaf_components.hpp"

namespace fairway {
namespace {

/// Beside the line: parts so near, with commands so near its tangent.
constexpr double beside_parts = 1.5;
constexpr double beside_rad = 0.25 * pi;

constexpr std::uint8_t only_reach = 1U << static_cast<unsigned>(Verdict::reach);

}  // namespace

FollowProver::FollowProver(const Parts& parts, const Tube& tube, const FollowOptions& options)
    : parts_(parts),
      tube_(tube),
      options_(options),
      graph_(parts, 1U << static_cast<unsigned>(options.limits.first_level)),
      groups_(groups_to_core()) {
  options_.limits.flight.tube = &tube;
}

template <typename Body>
void FollowProver::for_targets(Id id, const Body& body) const {
  for (const CrossingLink& link : graph_.links(id)) {
    const CrossingGraph::Range range = graph_.leaves_of(link);
    for (Id to = range.first; to < range.last; ++to) body(to, link);
  }
}

/// Leaves whose behaviours, as far as the next crossing, are in the tube.
std::vector<bool> FollowProver::near_path() const {
  std::vector<bool> which(graph_.leaves(), false);
  const unsigned bad_ends = tube_.closed() ? ~0U : ~unsigned{only_reach};
  for (Id id = 0; id < graph_.leaves(); ++id) {
    const Leaf& leaf = graph_.leaf(id);
    which[id] = leaf.state == LeafState::open && !leaf.gave_up && (leaf.ends & bad_ends) == 0 &&
                !leaf.is_beside_tube;
  }
  return which;
}

/// Removes leaves that lead to others than those that stay, until there is none.
void FollowProver::remove_leaks(std::vector<bool>& stays) const {
  // Who leads to each leaf.
  std::vector<std::uint32_t> first(graph_.leaves() + 1, 0);
  for (Id id = 0; id < graph_.leaves(); ++id) {
    if (stays[id]) for_targets(id, [&](Id to, const CrossingLink&) { ++first[to + 1]; });
  }
  for (std::size_t i = 1; i < first.size(); ++i) first[i] += first[i - 1];
  std::vector<Id> before(first.back());
  std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
  for (Id id = 0; id < graph_.leaves(); ++id) {
    if (stays[id]) for_targets(id, [&](Id to, const CrossingLink&) { before[next[to]++] = id; });
  }
  std::vector<Id> leaking;
  for (Id id = 0; id < graph_.leaves(); ++id) {
    if (!stays[id]) continue;
    bool leaks = graph_.links(id).empty() && graph_.leaf(id).ends == 0;
    for_targets(id, [&](Id to, const CrossingLink&) { leaks = leaks || !stays[to]; });
    if (leaks) leaking.push_back(id);
  }
  for (const Id id : leaking) stays[id] = false;
  while (!leaking.empty()) {
    const Id id = leaking.back();
    leaking.pop_back();
    for (std::uint32_t k = first[id]; k < first[id + 1]; ++k) {
      const Id from = before[k];
      if (!stays[from]) continue;
      stays[from] = false;
      leaking.push_back(from);
    }
  }
}

/// Groups of leaves in which behaviours may be for ever: without a direction in which all move on.
std::vector<FollowProver::Id> FollowProver::round_trips(const std::vector<bool>& stays) const {
  std::vector<Id> found;
  std::vector<std::uint32_t> group(graph_.leaves(), 0);
  std::uint32_t groups = 0;
  for_components(
      graph_, [&](Id id) { return bool{stays[id]}; },
      [&](std::span<const Id> members) {
        ++groups;
        for (const Id id : members) group[id] = groups;
        HeadingArc headings;
        bool comes_back = false;
        for (const Id id : members) {
          for_targets(id, [&](Id to, const CrossingLink& link) {
            if (group[to] != groups) return;
            headings = comes_back ? headings.with(link.headings()) : link.headings();
            comes_back = true;
          });
        }
        if (!comes_back || headings.width_rad < 2.0 * most_off_progress_rad - 1e-3) return;
        found.insert(found.end(), members.begin(), members.end());
      });
  return found;
}

std::vector<FollowProver::Id> FollowProver::beside_line(const std::vector<bool>& stays) const {
  std::vector<Id> found;
  for (Id id = 0; id < graph_.leaves(); ++id) {
    const std::size_t part = core_.part[id];
    if (stays[id] && static_cast<double>(tube_.distance_m(part)) < beside_parts * parts_.part_m() &&
        tube_.off_rad(part, parts_.arc(parts_.place(part))) < beside_rad) {
      found.push_back(id);
    }
  }
  return found;
}

/// All that leads on from these.
void FollowProver::take_core(std::vector<Id> reached) {
  core_.in.assign(graph_.leaves(), false);
  for (const Id id : reached) core_.in[id] = true;
  while (!reached.empty()) {
    const Id id = reached.back();
    reached.pop_back();
    for_targets(id, [&](Id to, const CrossingLink&) {
      if (core_.in[to]) return;
      core_.in[to] = true;
      reached.push_back(to);
    });
  }
}

/// Of an open path: all of the core come to its end, group by group.
bool FollowProver::leads_to_end(SizeRange speed_mps) {
  CrossingGraph core = graph_;
  for (Id id = 0; id < core.leaves(); ++id) {
    if (!core_.in[id]) core.leaf(id).state = LeafState::idle;
  }
  static_cast<void>(decide_groups(parts_, core, groups_));
  core_.group.assign(graph_.leaves(), core_group);
  double most = 0.0;  // parts
  for (Id id = 0; id < core.leaves(); ++id) {
    if (!core_.in[id]) continue;
    if (core.leaf(id).verdict != Verdict::reach) return false;
    core_.group[id] = core.leaf(id).group;
    most = std::max(most, static_cast<double>(groups_.flown[core.leaf(id).group]));
  }
  const auto most_s = static_cast<float>(most * parts_.part_m() / speed_mps.least);
  take_one_stage(std::nextafter(most_s, HUGE_VALF));
  return true;
}

void FollowProver::take_one_stage(float time_s) {
  constexpr float none = std::numeric_limits<float>::quiet_NaN();
  stages_ = {{0.0F}, {none}, {time_s}, {0.0F}, 0.0, static_cast<double>(time_s)};
  core_.stage.assign(graph_.leaves(), 0);
  for (Id id = 0; id < graph_.leaves(); ++id) {
    if (core_.in[id]) core_.stage[id] = 1;
  }
}

/// Round the path, or to its end, or nothing more is asked for.
bool FollowProver::goes_on(SizeRange speed_mps) {
  if (!tube_.closed()) return leads_to_end(speed_mps);
  if (!options_.laps) {
    core_.group.assign(graph_.leaves(), core_group);
    take_one_stage(0.0F);
    return true;
  }
  std::optional<LapStages> stages =
      find_lap_stages(parts_, tube_, graph_, speed_mps, core_, groups_);
  if (!stages) return false;
  stages_ = std::move(*stages);
  return true;
}

/// Until the core is known, only leaves near the path matter.
void FollowProver::set_aside_far_leaves() {
  for (std::size_t s = 0; s < graph_.sections(); ++s) {
    if (tube_.distance_m(s / sections_per_part) < Tube::outside) continue;
    for (Id id = graph_.first(s); id < graph_.first(s + 1); ++id) {
      Leaf& leaf = graph_.leaf(id);
      if (leaf.state == LeafState::fresh) leaf.state = LeafState::aside;
    }
  }
}

std::optional<Following> FollowProver::find_core(SizeRange speed_mps) {
  std::vector<bool> stays;
  set_aside_far_leaves();
  for (int level = 0;; ++level) {
    graph_.fly(parts_, options_.limits.flight, options_.limits.go_on);
    core_.part.clear();
    for (std::size_t s = 0; s < graph_.sections(); ++s) {
      for (Id id = graph_.first(s); id < graph_.first(s + 1); ++id) {
        core_.part.push_back(static_cast<std::uint32_t>(s / sections_per_part));
      }
    }
    stays = near_path();
    remove_leaks(stays);
    if (level == options_.stay_levels) break;
    std::vector<bool> which(graph_.leaves(), false);
    for (Id id = 0; id < graph_.leaves(); ++id) {
      which[id] = !stays[id] && graph_.leaf(id).state == LeafState::open &&
                  tube_.distance_m(core_.part[id]) < Tube::outside;
    }
    graph_.cut(which);
  }
  take_core(tube_.closed() ? round_trips(stays) : beside_line(stays));
  Following found;
  found.staying = static_cast<std::size_t>(std::count(stays.begin(), stays.end(), true));
  found.core = static_cast<std::size_t>(std::count(core_.in.begin(), core_.in.end(), true));
  if (found.core == 0 || !goes_on(speed_mps)) return {};
  measure_tube(found);
  found.lap_least_s = stages_.lap_least_s;
  found.lap_most_s = stages_.lap_most_s;
  return found;
}

bool FollowProver::join(const std::function<void(const InclusionLevel&)>& progress,
                        const ContractVerdicts* earlier) {
  CrossingGraph start = graph_;
  for (Id id = 0; id < start.leaves(); ++id) {
    Leaf& leaf = start.leaf(id);
    if (leaf.state == LeafState::aside) leaf.state = LeafState::fresh;
    if (core_.in[id]) {
      close_as_core(leaf);
    } else if ((leaf.ends & only_reach) != 0) {
      leaf.gave_up = true;
    }
  }
  if (earlier != nullptr) start.begin_as(*earlier);  // leaves of the core stay whole
  InclusionLimits limits = options_.limits;
  limits.flight.tube = nullptr;
  joining_parts_.emplace(parts_);
  joining_parts_->close_goal();
  joining_.emplace(*joining_parts_, limits, std::move(start), groups_);
  return joining_->run(progress);
}

FollowProver::Proved FollowProver::proved(double speed_least_mps) const {
  Proved made{joining_->verdicts(speed_least_mps), {}};
  made.proof.path.closed = tube_.closed();
  made.proof.stages = stages_;
  made.proof.tube = stretches_;
  made.proof.leaf_stage.assign(made.verdicts.leaves(), 0);
  // Leaves of the core are as they were, and in the same order.
  std::size_t id = 0;
  for (std::size_t k = 0; k < made.verdicts.leaves(); ++k) {
    if (made.verdicts.group[k] != core_group) continue;
    while (!core_.in[id]) ++id;
    made.verdicts.group[k] = core_.group[id];
    made.proof.leaf_stage[k] = core_.stage[id++];
  }
  return made;
}

}  // namespace fairway
