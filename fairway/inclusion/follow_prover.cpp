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

/// Behaviours that follow do not come so far along the path in one crossing: else a neighbouring
/// stretch of it is too near.
constexpr double longest_hop = 0.125;
constexpr std::size_t most_stretches = 512;
/// The station of a part is that of its middle, so it may fall by some parts although that of the
/// nearest point rises. A path that comes back to itself makes it fall by more.
constexpr double farthest_back = 4.0;

}  // namespace

FollowProver::FollowProver(const Parts& parts, const Tube& tube, const FollowOptions& options)
    : parts_(parts),
      tube_(tube),
      options_(options),
      graph_(parts, 1U << static_cast<unsigned>(options.limits.first_level)) {
  require(tube.closed(), "a path that is followed for ever is closed");
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
  for (Id id = 0; id < graph_.leaves(); ++id) {
    const Leaf& leaf = graph_.leaf(id);
    which[id] = leaf.state == LeafState::open && !leaf.gave_up && leaf.ends == 0 &&
                leaf.distance_m < Tube::outside;
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
    bool leaks = graph_.links(id).empty();
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

/// All that leads on from a group of leaves in which behaviours may be for ever: one without a
/// direction in which all move on.
std::vector<bool> FollowProver::core_of(const std::vector<bool>& stays) const {
  std::vector<bool> core(graph_.leaves(), false);
  std::vector<Id> reached;
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
        for (const Id id : members) core[id] = true;
        reached.insert(reached.end(), members.begin(), members.end());
      });
  while (!reached.empty()) {
    const Id id = reached.back();
    reached.pop_back();
    for_targets(id, [&](Id to, const CrossingLink&) {
      if (core[to]) return;
      core[to] = true;
      reached.push_back(to);
    });
  }
  return core;
}

/// What is true of the core; false when it does not go round.
bool FollowProver::measure(const std::vector<bool>& core, SizeRange speed_mps,
                           Following& found) const {
  const double length_m = tube_.length_m();
  const std::size_t stretches = std::clamp<std::size_t>(
      static_cast<std::size_t>(length_m / (2.0 * parts_.part_m())), 8, most_stretches);
  found.profile.assign(stretches, {});
  std::vector<bool> bent(stretches);
  const double stretch_m = length_m / static_cast<double>(stretches);
  const double part_m = 1.5 * parts_.part_m();  // from its middle, and more
  double hop_m = 0.0;
  for (Id id = 0; id < graph_.leaves(); ++id) {
    if (!core[id]) continue;
    const Leaf& leaf = graph_.leaf(id);
    const auto from = static_cast<double>(tube_.station_m(part_of_[id]));
    double back = -part_m;
    double on = part_m;
    for (const CrossingLink& link : graph_.links(id)) {
      const std::size_t part = link.section / sections_per_part;
      const double hop = tube_.ahead_m(from, static_cast<double>(tube_.station_m(part)));
      if (std::abs(hop) > longest_hop * length_m) return false;
      hop_m = std::max(hop_m, std::abs(hop));
      back = std::min(back, hop - part_m);
      on = std::max(on, hop + part_m);
    }
    const auto first = static_cast<long>(std::floor((from + back) / stretch_m));
    const auto last = static_cast<long>(std::floor((from + on) / stretch_m));
    for (long k = first; k <= last; ++k) {
      const auto n = static_cast<long>(stretches);
      const auto at = static_cast<std::size_t>(((k % n) + n) % n);
      TubeStretch& s = found.profile[at];
      s.distance_m = std::max(s.distance_m, static_cast<double>(leaf.distance_m));
      s.off_rad = std::max(s.off_rad, static_cast<double>(leaf.off_rad));
      if (back < -farthest_back * parts_.part_m()) bent[at] = true;
    }
  }
  double most_m = 0.0;  // of way, as if straight along the path
  for (std::size_t k = 0; k < stretches; ++k) {
    const TubeStretch& s = found.profile[k];
    if (s.distance_m == 0.0) return false;  // nobody comes by
    found.tube_m = std::max(found.tube_m, s.distance_m);
    found.off_rad = std::max(found.off_rad, s.off_rad);
    if (s.off_rad > most_off_progress_rad) bent[k] = true;
    if (bent[k]) continue;
    // Around a corner, on its outer side, the nearest point stands still.
    const double begin_m = static_cast<double>(k) * stretch_m;
    const double turning = tube_.turning_rad(begin_m, begin_m + stretch_m);
    most_m += (stretch_m + s.distance_m * turning) / std::cos(s.off_rad);
  }
  if (std::find(bent.begin(), bent.end(), false) == bent.end()) return false;
  const auto margin = static_cast<std::size_t>(std::ceil((hop_m + part_m) / stretch_m));
  const double through = through_bends(core, bent, margin);
  most_m += through * parts_.part_m();
  found.lap_least_s = least_lap_m(found.tube_m + hop_m + part_m) / speed_mps.most;
  found.lap_most_s = most_m / speed_mps.least;
  return std::isfinite(through) && passes_gates(core, 2.0 * hop_m + 2.0 * part_m);
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
    part_of_.clear();
    for (std::size_t s = 0; s < graph_.sections(); ++s) {
      for (Id id = graph_.first(s); id < graph_.first(s + 1); ++id) {
        part_of_.push_back(static_cast<std::uint32_t>(s / sections_per_part));
      }
    }
    stays = near_path();
    remove_leaks(stays);
    if (level == options_.stay_levels) break;
    std::vector<bool> which(graph_.leaves(), false);
    for (Id id = 0; id < graph_.leaves(); ++id) {
      which[id] = !stays[id] && graph_.leaf(id).state == LeafState::open &&
                  tube_.distance_m(part_of_[id]) < Tube::outside;
    }
    graph_.cut(which);
  }
  Following found;
  core_ = core_of(stays);
  found.staying = static_cast<std::size_t>(std::count(stays.begin(), stays.end(), true));
  found.core = static_cast<std::size_t>(std::count(core_.begin(), core_.end(), true));
  if (found.core == 0 || !measure(core_, speed_mps, found)) return {};
  return found;
}

bool FollowProver::join(const std::function<void(const InclusionLevel&)>& progress) {
  CrossingGraph start = graph_;
  for (Id id = 0; id < start.leaves(); ++id) {
    Leaf& leaf = start.leaf(id);
    if (leaf.state == LeafState::aside) leaf.state = LeafState::fresh;
    if (core_[id]) close_as_core(leaf);
  }
  InclusionLimits limits = options_.limits;
  limits.flight.tube = nullptr;
  joining_.emplace(parts_, limits, std::move(start), groups_to_core());
  return joining_->run(progress);
}

}  // namespace fairway
