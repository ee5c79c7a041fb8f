// The product of a proof: a verdict for every leaf of every section (section_flight.hpp).
//
// Properties that always hold:
//   1. A section has leaves exactly when its cell is ordinary, has a command that points out of
//      that side, and the cell beyond it is ordinary. Its leaves cover it: they start from 0, in
//      ascending order.
//   2. A leaf with verdict reach, collide or leave depends only on leaves of the same verdict and
//      of lower rank; one with verdict trapped only on leaves with verdict trapped. (The image of a
//      leaf under the flight to the section lies in those leaves, or ends with that verdict.)
//      Or it is handed over: it reaches by the commands of the mode next_mode, rank 0
//      (hand_over.hpp).
//   3. time_s of a leaf is at least the time of flight to any leaf it depends on plus that leaf's
//      time_s; +inf when trapped.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "fairway/verify/section_view.hpp"

namespace fairway {

struct SectionVerdicts {
  std::vector<std::uint32_t> first;   ///< [4 cells + 1]
  std::vector<std::uint32_t> begin;   ///< [leaves], units of cell_m / 2^32
  std::vector<std::uint32_t> rank;    ///< [leaves]
  std::vector<std::uint8_t> verdict;  ///< [leaves], Verdict
  std::vector<float> time_s;          ///< [leaves]
  /// [leaves], the earlier mode that the vehicle changes to there, or no_mode; empty: all no_mode.
  std::vector<std::uint8_t> next_mode;

  std::size_t leaves() const { return begin.size(); }
  SectionView view() const {
    return {first.data(), begin.data(), verdict.data(), time_s.data(),
            next_mode.empty() ? nullptr : next_mode.data()};
  }
  /// From a leaf's start to its end: the next leaf's start, or the last unit at the side's end.
  UnitRange range_of(std::size_t section, std::size_t leaf) const {
    return {begin[leaf], leaf + 1 < first[section + 1] ? begin[leaf + 1] : 0xffffffffU};
  }
};

}  // namespace fairway
