// Verdicts of boxes of states, as they were asked for: what makes queries of states near each other
// fast.
//
// A box is a part of a cell with a sixteenth of a turn, or a sixteenth of that part with a quarter
// of that range of headings. Where all of a box has one verdict, each of its states has; states of
// other boxes are flown one by one.
//
// Properties that always hold:
//   1. An answer other than undecided holds for every behaviour within the contract that starts in
//      the state; a state that contract_answer decides is decided. worst_time_s is that of the box.
//   2. Answers depend on the state alone, not on what was asked before, nor by which thread. (What
//      a box has is computed again when another one took its place.)
//   3. Nothing is allocated after the start but what a flight takes and gives back.
// Safe to ask from several threads at once.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>

#include "fairway/base/grid.hpp"
#include "fairway/base/vec2.hpp"
#include "fairway/inclusion/contract_lookup.hpp"
#include "fairway/inclusion/contract_verdicts.hpp"
#include "fairway/inclusion/parts.hpp"

namespace fairway {

class VerdictCache {
 public:
  /// Keeps a reference to `parts`, and what `verdicts` points to. It has room for 2^12 to
  /// 2^20 boxes, by the number of parts, of 8 bytes each.
  VerdictCache(const Parts& parts, const ContractVerdictsView& verdicts, double speed_least_mps);

  /// `place`: in parts, on the grid; no side is held.
  ContractAnswer answer(Vec2 place, double heading_rad) const;
  /// The same for a state in metres, wherever it is.
  ContractAnswer answer(const Grid& grid, Vec2 position_m, double heading_rad) const;

 private:
  struct Box;

  ContractAnswer answer_of(const Box& box) const;
  ContractAnswer fly(const Box& box) const;

  const Parts& parts_;
  ContractVerdictsView verdicts_;
  double speed_least_mps_;
  int size_log2_;
  std::unique_ptr<std::atomic<std::uint64_t>[]> known_;  ///< a box and its answer each, or 0
};

}  // namespace fairway
