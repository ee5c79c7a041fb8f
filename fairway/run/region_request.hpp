// The region to be reached, as given to the command, in scenarios and in Python: before the plan,
// and hence its grid, is known.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "fairway/plan/plan.hpp"
#include "fairway/verify/region_of_interest.hpp"

namespace fairway {

struct RegionRequest {
  RegionOfInterest::Kind kind = RegionOfInterest::Kind::goal;
  std::array<double, 4> rectangle_m{};  ///< kind rectangle: x0, y0, x1, y1
  std::filesystem::path file;           ///< kind cells: read_region.hpp
};

/// "goal", "obstacle", "X0,Y0,X1,Y1" with X0 < X1 and Y0 < Y1, else the name of a file. Empty for
/// four numbers that are not a rectangle, and for an empty text.
[[nodiscard]] std::optional<RegionRequest> region_request_of(const std::string& text);

/// On a plan's grid. Throws InputError naming the file when it cannot be read or holds no cell but
/// obstacles.
[[nodiscard]] RegionOfInterest region_on_plan(const RegionRequest& request, const Plan& plan);

/// Cells of a mask, [iy][ix]. Throws InputError{where, ...} when it names no cell but obstacles.
[[nodiscard]] RegionOfInterest region_of_cells(std::vector<std::uint8_t> cells, const Plan& plan,
                                               const std::string& where);

/// The cells that lie wholly in a polygon, its corners in order, in the grid's frame. Throws
/// InputError{where, ...} when it crosses itself or holds no such cell.
[[nodiscard]] RegionOfInterest region_of_polygon(const std::vector<Vec2>& ring_m, const Plan& plan,
                                                 const std::string& where);

}  // namespace fairway
