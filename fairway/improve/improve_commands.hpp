// Commands changed cell by cell, where more states then reach: coordinate ascent on a SampledFlow.
//
// A cell's command is tried in every direction and a little to either side; the best one is kept if
// it gains enough. Cells that most failing states meet come first; a cell is tried again when a
// command near it has changed.
//
// What is gained is starts that reach, less a price for every tear and every border that a change
// adds (SampledFlow): a plan whose commands differ wildly from cell to cell can be made to save
// more sampled states, but its motion is chaotic, and neither a proof nor a vehicle can rely on it.
//
// Properties that always hold:
//   1. Only commands of ordinary cells that have one are changed, and none of `frozen` cells.
//   2. A change never makes the difference to a neighbour's command both larger and larger than
//      `most_bend_rad`.
//   3. The result does not depend on the number of threads, unless `go_on` stops the work.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "fairway/improve/sampled_flow.hpp"

namespace fairway {

struct ImproveOptions {
  int sweeps = 4;                 ///< over all cells; fewer when nothing changes any more
  int directions = 24;            ///< tried for each cell, evenly spaced
  std::int64_t least_gain = 6;    ///< starts; smaller gains are not worth a change
  std::int64_t tear_price = 2;    ///< starts
  std::int64_t border_price = 1;  ///< starts
  double most_bend_rad = 4.0;     ///< between a changed command and a neighbour's; pi and more: any
};

struct ImproveProgress {
  int sweep = 0;
  std::size_t tried = 0;    ///< cells of this sweep
  std::size_t cells = 0;    ///< to be tried in this sweep
  std::size_t changed = 0;  ///< so far, in all
  double reached = 0.0;     ///< share of the model's starts
};

/// Changes the commands of `flow` and returns the changes in the order in which they were made; a
/// cell may be in them more than once. `grid` is the flow's. `frozen[cell]` is not 0 for cells that
/// keep their command; empty: none does. `go_on` is asked after every cell.
std::vector<CommandChange> improve_commands(
    SampledFlow& flow, const Grid& grid, const ImproveOptions& options,
    const std::vector<std::uint8_t>& frozen = {},
    const std::function<bool(const ImproveProgress&)>& go_on = {});

}  // namespace fairway
