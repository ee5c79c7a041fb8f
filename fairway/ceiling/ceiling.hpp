// The ceiling of all plans: what any control could do, as a bracket.
//
// Properties that always hold: `inside` and `lost` have headings * grid.size() entries,
// [heading][iy][ix]; where a state is proved both cannot happen, so the two never add up to more
// than 1; both are 0 in obstacles and in the mission's cells.
#pragma once

#include <cstddef>
#include <vector>

#include "fairway/base/grid.hpp"
#include "fairway/vehicle/vehicle.hpp"

namespace fairway {

/// Shares of states that some control brings to the mission lie between these.
struct CeilingShare {
  double lower = 0.0;
  double upper = 1.0;
};

struct Ceiling {
  Grid grid;
  Vehicle vehicle;
  /// Bins of headings: bin k holds those from k to k + 1 times 2 pi / headings.
  int headings = 0;
  int nodes_per_cell = 0;     ///< along a cell's side
  std::vector<float> inside;  ///< share of a cell and bin that some control brings to the mission
  std::vector<float> lost;    ///< share of a cell and bin that none does
  CeilingShare all;           ///< of all states of cells that are neither obstacle nor mission
  CeilingShare free;          ///< of those of safe starts
  CeilingShare buffer;        ///< of those nearer to obstacles
  int levels = 0;             ///< how often nodes and bins were halved, with the first time
  bool complete = true;       ///< false: a limit of time or memory came first
};

}  // namespace fairway
