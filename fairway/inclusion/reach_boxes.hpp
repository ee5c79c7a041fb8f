// Which boxes of states one mode of a plan is proved to bring to the goal, as they were asked for:
// what makes handing over to it fast, since neighbouring leaves ask about the same boxes.
//
// A box is a whole part, with its border, and a sixty-fourth of a turn. Answers depend on the box
// alone, not on what was asked before. Safe to ask from several threads at once.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>

#include "fairway/inclusion/contract_verdicts.hpp"
#include "fairway/inclusion/convex_set.hpp"
#include "fairway/inclusion/heading_arc.hpp"
#include "fairway/inclusion/parts.hpp"
#include "fairway/inclusion/quick_lookup.hpp"

namespace fairway {

class ReachBoxes {
 public:
  static constexpr double not_proved = std::numeric_limits<double>::infinity();

  /// Keeps a reference to `parts`, and what `verdicts` points to.
  ReachBoxes(const Parts& parts, const ContractVerdictsView& verdicts, double speed_least_mps);

  const Parts& parts() const { return parts_; }

  /// Seconds within which every behaviour reaches that starts in the ordinary part `part`, at a
  /// place of `set` and with a heading of `headings`, and holds no side; or not_proved.
  [[nodiscard]] double time_s(PartPlace part, const ConvexSet& set,
                              const HeadingArc& headings) const;

  /// A hint that costs little: whether about the state in the middle of an ordinary part with about
  /// this heading reaches.
  [[nodiscard]] bool may_reach(PartPlace part, double heading_rad) const;

 private:
  template <typename Find>
  double known_or(std::uint64_t key, const Find& find) const;
  double box_time_s(PartPlace part, std::uint64_t bin) const;
  double flown_time_s(PartPlace part, const ConvexSet& set, const HeadingArc& headings) const;
  double piece_time_s(PartPlace part, const ConvexSet& set, const HeadingArc& headings) const;

  const Parts& parts_;
  ContractVerdictsView verdicts_;
  double speed_least_mps_;
  QuickLookup quick_;
  int size_log2_;
  std::unique_ptr<std::atomic<std::uint64_t>[]> known_;  ///< a box and its time each, or 0
};

}  // namespace fairway
