#include "fairway/inclusion/stage_finder.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace fairway {
namespace {

constexpr double stage_parts = 1.5;  ///< length of a stage
constexpr long fewest_stages = 9;
constexpr long most_stages = 60000;
/// Stages in which headings are farther than this from their direction are left by groups.
constexpr double most_off_rad = 1.2;
constexpr double more_off_rad = 2e-3;

constexpr float none = std::numeric_limits<float>::quiet_NaN();

}  // namespace

long StageFinder::stages_at_first(double length_m, double part_m) {
  return std::clamp(std::lround(length_m / (stage_parts * part_m)), fewest_stages, most_stages);
}

std::optional<LapStages> StageFinder::run() {
  if (!number() || !join_bends() || !leave_bends()) return {};
  begin_where_all_pass_together();
  return measure() ? std::optional(std::move(made_)) : std::nullopt;
}

/// By the station of the part. It may fall by some parts although the nearest point moves on: a
/// leaf that others of a later stage lead to has that stage, too.
bool StageFinder::number() {
  stage_.assign(graph_.leaves(), 0);
  for (Id id = 0; id < graph_.leaves(); ++id) {
    if (!core_.in[id]) continue;
    const double along = static_cast<double>(tube_.station_m(core_.part[id])) / tube_.length_m();
    stage_[id] = std::clamp(static_cast<long>(along * static_cast<double>(count_)), 0L, count_ - 1);
  }
  raise_behind();
  return !goes_back_ && jumps_are_short();
}

void StageFinder::raise_behind() {
  std::vector<long> raised(graph_.leaves(), 0);
  std::vector<Id> waiting;
  for (Id id = 0; id < graph_.leaves(); ++id) {
    if (core_.in[id]) waiting.push_back(id);
  }
  while (!waiting.empty() && !goes_back_) {
    const Id id = waiting.back();
    waiting.pop_back();
    for (const CrossingLink& link : graph_.links(id)) {
      const CrossingGraph::Range range = graph_.leaves_of(link);
      for (Id to = range.first; to < range.last; ++to) {
        const long behind = -ahead(stage_[id], stage_[to]);
        if (behind <= 0) continue;
        raised[to] += behind;
        goes_back_ = goes_back_ || raised[to] > count_ / 6;
        stage_[to] = stage_[id];
        waiting.push_back(to);
      }
    }
  }
}

bool StageFinder::jumps_are_short() const {
  bool are = true;
  for_links([&](Id id, const CrossingLink& link) {
    const CrossingGraph::Range range = graph_.leaves_of(link);
    for (Id to = range.first; to < range.last; ++to) {
      const long on = ahead(stage_[id], stage_[to]);
      are = are && on >= 0 && 3 * on < count_;
    }
  });
  return are;
}

std::vector<HeadingArc> StageFinder::headings_of_stages(std::vector<bool>& used) const {
  std::vector<HeadingArc> headings(static_cast<std::size_t>(count_));
  used.assign(headings.size(), false);
  for_links([&](Id id, const CrossingLink& link) {
    const auto k = static_cast<std::size_t>(stage_[id]);
    headings[k] = used[k] ? headings[k].with(link.headings()) : link.headings();
    used[k] = true;
  });
  return headings;
}

/// Directions of the stages; adjacent ones that have none become one.
bool StageFinder::join_bends() {
  std::vector<bool> used;
  std::vector<HeadingArc> headings = headings_of_stages(used);
  const auto n = static_cast<std::size_t>(count_);
  const auto bends = [&](std::size_t k) {
    return used[k] && 0.5 * headings[k].width_rad + more_off_rad > most_off_rad;
  };
  std::size_t first = 0;  // a straight one
  while (first < n && (!used[first] || bends(first))) ++first;
  if (first == n) return false;
  const std::vector<HeadingArc> was = headings;
  std::vector<long> now(n);
  made_ = {};
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t k = (first + i) % n;
    const bool bend = bends(k);
    // Nothing begins in one that is passed over: it is taken to the one before.
    const bool joins = !used[k] || (bend && std::isnan(made_.off_rad.back()));
    if (!joins) {
      const HeadingArc arc = was[k];
      made_.heading_rad.push_back(
          static_cast<float>(std::remainder(arc.lo_rad + 0.5 * arc.width_rad, whole_turn_rad)));
      made_.off_rad.push_back(bend ? none : static_cast<float>(0.5 * arc.width_rad + more_off_rad));
      made_.time_s.push_back(0.0F);
      made_.station_m.push_back(
          static_cast<float>(static_cast<double>(k) / static_cast<double>(n) * tube_.length_m()));
    }
    now[k] = static_cast<long>(made_.size()) - 1;
  }
  renumber(now, static_cast<long>(made_.size()));
  return count_ >= 3 && jumps_are_short();
}

void StageFinder::renumber(const std::vector<long>& now, long count) {
  for (Id id = 0; id < graph_.leaves(); ++id) {
    if (core_.in[id]) stage_[id] = now[static_cast<std::size_t>(stage_[id])];
  }
  count_ = count;
}

/// Stages without a direction are left by groups, each with one. Neighbours are not looked at
/// together, for each ends where the next one begins.
bool StageFinder::leave_bends() {
  core_.group.assign(graph_.leaves(), core_group);
  const auto bends = [](float off) { return std::isnan(off); };
  if (std::none_of(made_.off_rad.begin(), made_.off_rad.end(), bends)) return true;
  return leave_bends(0) && leave_bends(1) && leave_bends(2);
}

bool StageFinder::leave_bends(int of_three) {
  const auto counts = [&](Id id) {
    const long k = stage_[id];
    const int third = k == count_ - 1 ? 2 : static_cast<int>(k % 2);
    return core_.in[id] && third == of_three &&
           std::isnan(made_.off_rad[static_cast<std::size_t>(k)]);
  };
  CrossingGraph bend = graph_;
  for (Id id = 0; id < bend.leaves(); ++id) {
    Leaf& leaf = bend.leaf(id);
    if (!core_.in[id]) {
      leaf.state = LeafState::idle;
    } else if (!counts(id)) {
      close_as_core(leaf);
    }
  }
  static_cast<void>(decide_groups(parts_, bend, groups_));
  for (Id id = 0; id < bend.leaves(); ++id) {
    if (!counts(id)) continue;
    const Leaf& leaf = bend.leaf(id);
    if (leaf.state == LeafState::open || leaf.verdict != Verdict::reach) return false;
    core_.group[id] = leaf.group;
    float& time_s = made_.time_s[static_cast<std::size_t>(stage_[id])];
    const double s =
        static_cast<double>(groups_.flown[leaf.group]) * parts_.part_m() / speed_.least;
    time_s = std::max(time_s, std::nextafter(static_cast<float>(s), HUGE_VALF));
  }
  return true;
}

void close_as_core(Leaf& leaf) {
  leaf.state = LeafState::closed;
  leaf.verdict = Verdict::reach;
  leaf.group = core_group;
}

GroupRecord groups_to_core() {
  return {{none, none}, {std::numeric_limits<float>::infinity(), 0.0F}};
}

std::optional<LapStages> find_lap_stages(const Parts& parts, const Tube& tube,
                                         const CrossingGraph& graph, SizeRange speed_mps,
                                         LapCore& core, GroupRecord& groups) {
  return StageFinder(parts, tube, graph, speed_mps, core, groups).run();
}

}  // namespace fairway
