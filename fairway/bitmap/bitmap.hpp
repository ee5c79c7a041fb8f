// Paper 2's complete product for a plan: the samples of every border, and what a query needs
// besides.
//
// Properties that always hold: set.grid is the grid of the arrays; commands are those of the plan;
// kind follows from region and region_of_interest (cell_kinds); 0 < cell side < turning radius.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fairway/base/frame.hpp"
#include "fairway/bitmap/border_bitmap.hpp"
#include "fairway/map/region.hpp"
#include "fairway/plan/plan_digests.hpp"
#include "fairway/vehicle/vehicle.hpp"
#include "fairway/verify/flow.hpp"
#include "fairway/verify/region_of_interest.hpp"

namespace fairway {

struct Bitmap {
  Vehicle vehicle;
  RegionOfInterest region_of_interest;
  std::vector<float> heading_rad;  ///< [iy][ix], of the plan
  std::vector<Region> region;      ///< [iy][ix], of the plan
  std::vector<CellKind> kind;      ///< [iy][ix]
  BorderBitmap set;
  PlanDigests plan;            ///< of the plan it belongs to
  std::optional<Frame> frame;  ///< where the plan's grid lies; none: unknown to the plan
  /// How it was made and its results, one JSON object: program, options, shares.
  std::string evidence_json = "{}";

  const Grid& grid() const { return set.grid; }
  Flow flow() const { return {set.grid, vehicle, heading_rad.data(), kind.data()}; }
};

/// The metadata of a bitmap's file, except what follows from its arrays; one JSON object with
/// sorted keys.
[[nodiscard]] std::string record_text(const Bitmap& bitmap);

}  // namespace fairway
