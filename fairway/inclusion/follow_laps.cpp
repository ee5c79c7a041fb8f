// That the core goes round, and how long a lap takes.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "fairway/inclusion/follow_prover.hpp"

namespace fairway {
namespace {

constexpr std::uint32_t core_group = 1;
constexpr int fewest_chords = 3;
constexpr int most_chords = 64;

}  // namespace

/// Whoever comes to it has come to the core.
void FollowProver::close_as_core(Leaf& leaf) {
  leaf.state = LeafState::closed;
  leaf.verdict = Verdict::reach;
  leaf.group = core_group;
}

GroupRecord FollowProver::groups_to_core() {
  constexpr float none = std::numeric_limits<float>::quiet_NaN();
  return {{none, none}, {std::numeric_limits<float>::infinity(), 0.0F}};
}

/// Where the path bends so sharply that the tube's places see it from all sides, its tangents say
/// little. The longest way, in parts, through such stretches, with `margin` of others before and
/// after them, where the nearest point moves on: from groups, each with a direction. Infinite when
/// some behaviour may stay there.
double FollowProver::through_bends(const std::vector<bool>& core, const std::vector<bool>& bent,
                                   std::size_t margin) const {
  const std::size_t n = bent.size();
  std::vector<bool> about(n, false);
  for (std::size_t k = 0; k < n; ++k) {
    for (std::size_t m = 0; bent[k] && m <= 2 * margin; ++m) about[(k + n + m - margin) % n] = true;
  }
  const auto begin = std::find(about.begin(), about.end(), false);
  if (begin == about.end()) return std::numeric_limits<double>::infinity();
  const auto first = static_cast<std::size_t>(begin - about.begin());
  double sum = 0.0;
  for (std::size_t k = first; k < first + n; ++k) {
    if (!about[k % n] || about[(k + n - 1) % n]) continue;
    std::size_t last = k;  // of the run that begins here
    while (about[(last + 1) % n]) ++last;
    CrossingGraph run = graph_;
    for (Id id = 0; id < run.leaves(); ++id) {
      Leaf& leaf = run.leaf(id);
      const double along = static_cast<double>(tube_.station_m(part_of_[id])) / tube_.length_m();
      const auto at = std::min(n - 1, static_cast<std::size_t>(along * static_cast<double>(n)));
      if (!core[id]) {
        leaf.state = LeafState::idle;
      } else if ((at + n - k % n) % n > last - k) {
        close_as_core(leaf);
      }
    }
    GroupRecord groups = groups_to_core();
    static_cast<void>(decide_groups(parts_, run, groups));
    double longest = 0.0;
    for (Id id = 0; id < run.leaves(); ++id) {
      const Leaf& leaf = run.leaf(id);
      if (leaf.state == LeafState::open) return std::numeric_limits<double>::infinity();
      if (core[id]) longest = std::max(longest, static_cast<double>(groups.flown[leaf.group]));
    }
    sum += longest;
  }
  return sum;
}

/// Whether all come through three gates across the path, one after the other, again and again. The
/// nearest point alone would not tell: where a path runs beside itself it may fall back.
bool FollowProver::passes_gates(const std::vector<bool>& core, double long_m) const {
  constexpr int gates = 3;
  if (gates * long_m > 0.5 * tube_.length_m()) return false;
  std::vector<int> gate(graph_.leaves(), -1);
  for (Id id = 0; id < graph_.leaves(); ++id) {
    if (!core[id]) continue;
    const auto at = static_cast<double>(tube_.station_m(part_of_[id]));
    for (int k = 0; k < gates; ++k) {
      const double ahead_m = tube_.ahead_m(tube_.length_m() * k / gates, at);
      if (ahead_m >= 0.0 && ahead_m < long_m) gate[id] = k;
    }
  }
  for (int k = 0; k < gates; ++k) {
    // Everybody comes to it.
    CrossingGraph others = graph_;
    for (Id id = 0; id < others.leaves(); ++id) {
      if (!core[id]) {
        others.leaf(id).state = LeafState::idle;
      } else if (gate[id] == k) {
        close_as_core(others.leaf(id));
      }
    }
    GroupRecord groups = groups_to_core();
    static_cast<void>(decide_groups(parts_, others, groups));
    for (Id id = 0; id < others.leaves(); ++id) {
      if (others.leaf(id).state == LeafState::open) return false;
    }
    // And from it to the next one before the one before.
    std::vector<bool> seen(graph_.leaves(), false);
    std::vector<Id> reached;
    for (Id id = 0; id < graph_.leaves(); ++id) {
      if (gate[id] == k) reached.push_back(id);
    }
    while (!reached.empty()) {
      const Id id = reached.back();
      reached.pop_back();
      for (const CrossingLink& link : graph_.links(id)) {
        const CrossingGraph::Range range = graph_.leaves_of(link);
        for (Id to = range.first; to < range.last; ++to) {
          if (gate[to] == (k + gates - 1) % gates) return false;
          if (seen[to] || gate[to] == (k + 1) % gates) continue;
          seen[to] = true;
          reached.push_back(to);
        }
      }
    }
  }
  return true;
}

/// No lap is shorter: it comes within `aside_m` of every place of the path, so of the corners of
/// any polygon in it, in their order.
double FollowProver::least_lap_m(double aside_m) const {
  double best = 0.0;
  for (int n = fewest_chords; n <= most_chords; ++n) {
    double sum = 0.0;
    for (int k = 0; k < n; ++k) {
      const Vec2 from = tube_.place_m(tube_.length_m() * k / n);
      const Vec2 to = tube_.place_m(tube_.length_m() * (k + 1) / n);
      sum += std::max(0.0, norm(to - from) - 2.0 * aside_m);
    }
    best = std::max(best, sum);
  }
  return best;
}

}  // namespace fairway
