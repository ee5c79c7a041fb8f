// What is known about sampled states of a plan, place by place: a noun for pictures and statistics.
//
// Properties that always hold:
//   1. Sample (ix, iy) stands for one cell: the middle one of its block of cells_per_sample^2 cells
//      (of those that lie in the grid).
//   2. Its state is slightly off the cell's centre, by less than a thirtieth of a cell and half a
//      thousandth of a radian: from the centre itself, flights at multiples of 45 degrees go
//      through corners and meet their commands exactly reversed. Such ties have no volume, but a
//      picture would show them as areas.
//   3. Where that cell is not ordinary there are no states: verdicts are undecided, counts 0.
//      Elsewhere the counts sum to states_per_sample.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "fairway/base/grid.hpp"
#include "fairway/base/heading.hpp"
#include "fairway/vehicle/modes.hpp"
#include "fairway/verify/flow.hpp"
#include "fairway/verify/verdict.hpp"

namespace fairway {

struct VerdictMap {
  Grid grid;  ///< of the plan
  int cells_per_sample = 1;
  int nx = 0;  ///< samples: cells / cells_per_sample, rounded up
  int ny = 0;
  std::vector<double> heading_rad;  ///< [headings], of the sampled states
  std::vector<CellKind> kind;       ///< [ny][nx], of the sampled cell
  std::vector<Verdict> verdict;     ///< [headings][ny][nx], at place_m
  /// [headings][ny][nx]: the first mode that is proved to reach from that state; no_mode where none
  /// is, and outside ordinary cells. Empty: the plan has one mode.
  std::vector<std::uint8_t> mode;
  int modes = 1;  ///< of the plan
  int states_per_sample = 0;
  /// [ny][nx][Verdict]: verdicts of states spread evenly over the cell's places and all headings.
  std::vector<std::array<std::uint16_t, verdict_count>> count;

  /// A map that knows nothing yet but its places: `count` headings, evenly spaced, the first all
  /// but east, and at most `most_across` samples along the longer side; both at least 1.
  static VerdictMap over(const Grid& grid, int headings, int most_across) {
    constexpr double aside_rad = 0.0005;  // property 2
    VerdictMap map;
    map.grid = grid;
    const int longer = grid.nx > grid.ny ? grid.nx : grid.ny;
    const int block = (longer + most_across - 1) / most_across;
    map.cells_per_sample = block > 1 ? block : 1;
    map.nx = (grid.nx + map.cells_per_sample - 1) / map.cells_per_sample;
    map.ny = (grid.ny + map.cells_per_sample - 1) / map.cells_per_sample;
    for (int k = 0; k < headings; ++k) {
      map.heading_rad.push_back(Heading::from_rad(aside_rad + two_pi * k / headings).rad());
    }
    map.kind.resize(map.samples());
    map.verdict.assign(map.samples() * map.heading_rad.size(), Verdict::undecided);
    map.count.assign(map.samples(), {});
    return map;
  }

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
  /// no_mode where none is proved to reach.
  std::uint8_t mode_at(std::size_t heading, std::size_t sample) const {
    if (!mode.empty()) return mode[heading * samples() + sample];
    return verdict_at(heading, sample) == Verdict::reach ? 0 : no_mode;
  }
  /// The cell that a sample stands for.
  Cell cell_of_sample(std::size_t sample) const {
    const auto columns = static_cast<std::size_t>(nx);
    return {middle(static_cast<int>(sample % columns), grid.nx),
            middle(static_cast<int>(sample / columns), grid.ny)};
  }
  /// Where the states of `verdict` are.
  Vec2 place_m(std::size_t sample) const {
    const Vec2 middle_m = grid.center(cell_of_sample(sample));
    return {middle_m.x + grid.cell_m / 37.0, middle_m.y - grid.cell_m / 53.0};
  }

 private:
  int middle(int block, int cells) const {
    const int begin = block * cells_per_sample;
    const int end = begin + cells_per_sample < cells ? begin + cells_per_sample : cells;
    return begin + (end - begin) / 2;
  }
};

}  // namespace fairway
