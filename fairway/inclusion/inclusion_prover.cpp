#include "fairway/inclusion/inclusion_prover.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "fairway/base/parallel.hpp"

namespace fairway {

namespace {

/// At most 1 % more, one of few, so that groups are few.
float coarse_above(double length) {
  constexpr std::uint32_t rest = 0xffffU;
  const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(length * (1.0 + 1e-6)));
  return std::bit_cast<float>((bits + rest) & ~rest);
}

}  // namespace

InclusionProver::InclusionProver(const Parts& parts, const InclusionLimits& limits)
    : parts_(parts),
      limits_(limits),
      graph_(parts, 1U << static_cast<unsigned>(limits.first_level)) {}

InclusionLevel InclusionProver::level_now(int level) const {
  InclusionLevel now{.level = level, .leaves = graph_.leaves()};
  double all = 0.0;
  double open = 0.0;
  for (std::size_t s = 0; s < graph_.sections(); ++s) {
    for (auto id = graph_.first(s); id < graph_.first(s + 1); ++id) {
      const Leaf& leaf = graph_.leaf(id);
      if (leaf.state == LeafState::idle) continue;
      const double length = graph_.end_of(id, s) - leaf.begin;
      all += length;
      if (leaf.verdict != Verdict::undecided) continue;
      open += length;
      ++now.undecided;
    }
  }
  now.undecided_share = all > 0.0 ? open / all : 0.0;
  return now;
}

std::vector<bool> InclusionProver::to_cut(int level) const {
  std::vector<bool> which(graph_.leaves(), false);
  const std::uint32_t least = side_units >> static_cast<unsigned>(level);
  const CutHope enough = level <= limits_.faint_level ? CutHope::faint : CutHope::fair;
  for (std::size_t s = 0; s < graph_.sections(); ++s) {
    for (auto id = graph_.first(s); id < graph_.first(s + 1); ++id) {
      which[id] = graph_.leaf(id).state == LeafState::open &&
                  last_.hope[graph_.slot(id)] >= enough &&
                  graph_.end_of(id, s) - graph_.leaf(id).begin >= 2 * least;
    }
  }
  return which;
}

void InclusionProver::cut(const std::vector<bool>& which) {
  last_ = {};  // of leaves whose numbers change
  graph_.cut(which);
}

/// Asked before a leaf is flown, since most leaves of a further mode are handed over at once.
void InclusionProver::hand_over_fresh() {
  const std::uint32_t least = side_units >> static_cast<unsigned>(limits_.hand_over_level);
  struct Asked {
    CrossingGraph::Id id;
    std::size_t section;
    ContractHandOver found;
  };
  std::vector<Asked> asked;
  for (std::size_t s = 0; s < graph_.sections(); ++s) {
    for (auto id = graph_.first(s); id < graph_.first(s + 1); ++id) {
      const Leaf& leaf = graph_.leaf(id);
      const bool is_long = graph_.end_of(id, s) - leaf.begin >= least;
      if (leaf.state == LeafState::fresh && is_long) asked.push_back({id, s, {}});
    }
  }
  constexpr std::size_t chunk = 64;
  for_ranges((asked.size() + chunk - 1) / chunk, 1, [&](std::size_t a, std::size_t b) {
    for (std::size_t k = a * chunk; k < std::min(asked.size(), b * chunk); ++k) {
      if (k % chunk == 0 && !limits_.go_on()) return;
      Asked& one = asked[k];
      one.found = hand_over(parts_, parts_.place(one.section / sections_per_part),
                            static_cast<PartSide>(one.section % sections_per_part),
                            graph_.leaf(one.id).begin / static_cast<double>(side_units),
                            graph_.end_of(one.id, one.section) / static_cast<double>(side_units),
                            error_, earlier_);
    }
  });
  groups_.begin();
  for (const Asked& one : asked) {
    if (one.found.mode == no_mode) continue;
    constexpr double spare = 1.01;  // whoever checks flies other sets
    const double flown = spare * one.found.time_s * speed_least_mps_ / parts_.part_m();
    const float rounded = coarse_above(flown);
    const auto [at, is_new] = group_handed_.try_emplace({one.found.mode, rounded}, 0);
    if (is_new) {
      at->second = groups_.add(std::numeric_limits<float>::quiet_NaN(), rounded);
      groups_.next_mode.resize(at->second, no_mode);
      groups_.next_mode.push_back(one.found.mode);
    }
    Leaf& leaf = graph_.leaf(one.id);
    leaf.state = LeafState::closed;
    leaf.verdict = Verdict::reach;
    leaf.group = at->second;
  }
}

bool InclusionProver::run(const std::function<void(const InclusionLevel&)>& progress) {
  const auto decide_levels = [&] {
    double before = 1.0;
    for (int level = limits_.first_level; level <= limits_.last_level; ++level) {
      // Within a level, until it decides next to nothing more.
      while (true) {
        if (!earlier_.empty()) hand_over_fresh();
        graph_.fly(parts_, limits_.flight, limits_.go_on);
        last_ = {};  // not there twice
        last_ = decide_groups(parts_, graph_, groups_);
        const InclusionLevel now = level_now(level);
        progress(now);
        const double gain = before - now.undecided_share;
        before = now.undecided_share;
        if (!limits_.go_on()) return false;
        if (limits_.memory_bytes > 0 && graph_.bytes() > limits_.memory_bytes) return false;
        const std::vector<bool> which = to_cut(level);
        if (std::abs(gain) < limits_.least_gain ||
            std::find(which.begin(), which.end(), true) == which.end()) {
          break;
        }
        cut(which);
      }
      if (level == limits_.last_level) break;
      cut(to_cut(level + 1));
    }
    return true;
  };
  const bool done = decide_levels();
  graph_.forget_links();
  return done;
}

ContractVerdicts InclusionProver::verdicts(double speed_least_mps) const {
  ContractVerdicts made;
  made.first.resize(graph_.sections() + 1);
  made.begin.reserve(graph_.leaves());
  made.group.reserve(graph_.leaves());
  made.verdict.reserve(graph_.leaves());
  for (std::size_t s = 0; s < graph_.sections(); ++s) {
    made.first[s] = static_cast<std::uint32_t>(made.begin.size());
    for (auto id = graph_.first(s); id < graph_.first(s + 1); ++id) {
      const Leaf& leaf = graph_.leaf(id);
      // Neighbours about which the same is known are one leaf.
      const bool same = made.first[s] < made.begin.size() && leaf.group == 0 &&
                        made.group.back() == 0 &&
                        made.verdict.back() == static_cast<std::uint8_t>(leaf.verdict) &&
                        leaf.verdict == Verdict::undecided;
      if (same) continue;
      made.begin.push_back(leaf.begin * static_cast<std::uint32_t>(0x100000000U / side_units));
      made.group.push_back(leaf.group);
      made.verdict.push_back(static_cast<std::uint8_t>(leaf.verdict));
    }
  }
  made.first.back() = static_cast<std::uint32_t>(made.begin.size());
  made.group_heading_rad = groups_.heading_rad;
  made.group_time_s.reserve(groups_.flown.size());
  for (const float flown : groups_.flown) {
    const double s = static_cast<double>(flown) * parts_.part_m() / speed_least_mps;
    made.group_time_s.push_back(
        std::nextafter(static_cast<float>(s), std::numeric_limits<float>::infinity()));
  }
  if (earlier_.empty()) return made;
  made.group_next_mode = groups_.next_mode;
  made.group_next_mode.resize(made.group_time_s.size(), no_mode);
  return made;
}

}  // namespace fairway
