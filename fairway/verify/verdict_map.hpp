// What is known of sampled states of a plan, place by place: a noun for pictures and statistics.
//
// Properties that always hold:
//   1. Sample (ix, iy) looks at one cell: the middle one of its block of cells_per_sample^2 cells
//      (of those that lie in the grid).
//   2. Where that cell is not ordinary there are no states: verdicts are undecided, counts 0.
//      Elsewhere the counts sum to states_per_sample.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "fairway/base/grid.hpp"
#include "fairway/verify/flow.hpp"
#include "fairway/verify/verdict.hpp"

namespace fairway {

struct VerdictMap {
  Grid grid;  ///< of the plan
  int cells_per_sample = 1;
  int nx = 0;  ///< samples: cells / cells_per_sample, rounded up
  int ny = 0;
  std::vector<double> heading_rad;  ///< [headings]
  std::vector<CellKind> kind;       ///< [ny][nx], of the cell looked at
  std::vector<Verdict> verdict;     ///< [headings][ny][nx], at the cell's middle
  int states_per_sample = 0;
  /// [ny][nx][Verdict]: verdicts of states spread evenly over the cell's places and all headings.
  std::vector<std::array<std::uint16_t, verdict_count>> count;

  std::size_t samples() const {
    return static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny);
  }
  std::size_t index(int ix, int iy) const {
    return static_cast<std::size_t>(iy) * static_cast<std::size_t>(nx) +
           static_cast<std::size_t>(ix);
  }
  Verdict verdict_at(std::size_t heading, std::size_t sample) const {
    return verdict[heading * samples() + sample];
  }
  /// The cell that a sample looks at.
  Cell cell_of_sample(std::size_t sample) const {
    const auto columns = static_cast<std::size_t>(nx);
    return {middle(static_cast<int>(sample % columns), grid.nx),
            middle(static_cast<int>(sample / columns), grid.ny)};
  }

 private:
  int middle(int block, int cells) const {
    const int begin = block * cells_per_sample;
    const int end = begin + cells_per_sample < cells ? begin + cells_per_sample : cells;
    return begin + (end - begin) / 2;
  }
};

}  // namespace fairway
