// A certificate: what was proved of a plan, with all that queries and the checker need.
//
// Properties that always hold: those of plan.hpp for the arrays taken from the plan; kind follows
// from region and region_of_interest (cell_kinds); those of section_verdicts.hpp.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "fairway/base/grid.hpp"
#include "fairway/plan/plan.hpp"
#include "fairway/verify/flow.hpp"
#include "fairway/verify/section_verdicts.hpp"

namespace fairway {

/// What flights are to reach. It takes the goal's place: with another region, goal cells are
/// ordinary cells; with obstacles, touching one is to reach.
struct RegionOfInterest {
  enum class Kind { goal, obstacle, rectangle };
  Kind kind = Kind::goal;
  std::array<double, 4> rectangle_m{};  ///< x0, y0, x1, y1; cells wholly inside
};

struct Certificate {
  Grid grid;
  Vehicle vehicle;
  RegionOfInterest region_of_interest;
  std::vector<float> heading_rad;  ///< [iy][ix]
  std::vector<Region> region;      ///< [iy][ix]
  std::vector<CellKind> kind;      ///< [iy][ix]
  SectionVerdicts sections;
  /// The rest of the metadata, one JSON object: digests of the plan, options, volumes.
  std::string record_json = "{}";

  Flow flow() const {
    return {grid.nx,
            grid.ny,
            grid.x0_m,
            grid.y0_m,
            {grid.cell_m, vehicle.turn_radius_m},
            vehicle.speed_mps,
            heading_rad.data(),
            kind.data()};
  }
};

}  // namespace fairway
