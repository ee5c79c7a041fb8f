#include "fairway/run/region_request.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>
#include <vector>

#include "fairway/base/error.hpp"
#include "fairway/map/cells_in_polygon.hpp"
#include "fairway/map/read_region.hpp"
#include "fairway/map/simple_polygon.hpp"

namespace fairway {
namespace {

/// The numbers between the commas; none unless all are.
std::vector<double> numbers_of(const std::string& text) {
  std::vector<double> numbers;
  for (const char* at = text.c_str();; ++at) {
    char* end = nullptr;
    const double value = std::strtod(at, &end);
    if (end == at || (*end != ',' && *end != '\0')) return {};
    numbers.push_back(value);
    if (*end == '\0') return numbers;
    at = end;
  }
}

}  // namespace

std::optional<RegionRequest> region_request_of(const std::string& text) {
  using Kind = RegionOfInterest::Kind;
  if (text.empty()) return {};
  if (text == "goal") return RegionRequest{};
  if (text == "obstacle") return RegionRequest{Kind::obstacle, {}, {}};
  const std::vector<double> r = numbers_of(text);
  if (r.empty()) return RegionRequest{Kind::cells, {}, text};
  const bool fits = r.size() == 4 && r[0] < r[2] && r[1] < r[3] &&
                    std::all_of(r.begin(), r.end(), [](double x) { return std::isfinite(x); });
  if (!fits) return {};
  return RegionRequest{Kind::rectangle, {r[0], r[1], r[2], r[3]}, {}};
}

RegionOfInterest region_of_cells(std::vector<std::uint8_t> cells, const Plan& plan,
                                 const std::string& where) {
  RegionOfInterest region{RegionOfInterest::Kind::cells, {}, std::move(cells)};
  const std::vector<std::uint8_t> target = target_cells(plan.grid, plan.region, region);
  if (std::find(target.begin(), target.end(), 1) == target.end()) {
    throw InputError(where,
                     "contains no whole cell outside obstacles, so nothing could be reached");
  }
  return region;
}

RegionOfInterest region_of_polygon(const std::vector<Vec2>& ring_m, const Plan& plan,
                                   const std::string& where) {
  if (ring_m.size() < 3) throw InputError(where, "expected at least three corners");
  if (find_contact({ring_m})) throw InputError(where, "crosses or touches itself");
  std::vector<std::uint8_t> cells(plan.grid.size());
  mark_cells_in({{ring_m}}, plan.grid, cells);
  return region_of_cells(std::move(cells), plan, where);
}

RegionOfInterest region_on_plan(const RegionRequest& request, const Plan& plan) {
  if (request.kind != RegionOfInterest::Kind::cells) {
    return {request.kind, request.rectangle_m, {}};
  }
  return region_of_cells(read_region(request.file, plan.grid, frame_in(plan.record)), plan,
                         request.file.string());
}

}  // namespace fairway
