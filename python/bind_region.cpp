#include "bind_region.hpp"

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "fairway/run/region_request.hpp"

namespace fairway::python {
namespace {

using Kind = RegionOfInterest::Kind;

[[noreturn]] void refuse() {
  throw py::type_error(
      "region: expected \"goal\", \"obstacle\", (x0, y0, x1, y1) in metres, a mask of bool [ny, "
      "nx], a polygon [n, 2] in metres, or a pathlib.Path");
}

RegionOfInterest of_mask(const py::array& mask, const Plan& plan) {
  if (mask.ndim() != 2 || mask.shape(0) != plan.grid.ny || mask.shape(1) != plan.grid.nx) {
    throw py::value_error("region: expected a mask of the plan's shape, [" +
                          std::to_string(plan.grid.ny) + ", " + std::to_string(plan.grid.nx) + "]");
  }
  const auto cells = py::array_t<bool, py::array::c_style | py::array::forcecast>(mask);
  const bool* const first = cells.data();
  return region_of_cells(std::vector<std::uint8_t>(first, first + plan.grid.size()), plan,
                         "region");
}

RegionOfInterest rectangle_of(const std::array<double, 4>& box) {
  const auto& [x0, y0, x1, y1] = box;
  if (!(x0 < x1 && y0 < y1)) {
    throw py::value_error("region: expected (x0, y0, x1, y1) with x0 < x1 and y0 < y1");
  }
  return {Kind::rectangle, box, {}};
}

}  // namespace

RegionOfInterest region_from(const py::object& region, const Plan& plan) {
  if (py::isinstance<py::str>(region)) {
    const auto kind = choice_of<Kind>("region", region.cast<std::string>(),
                                      {{"goal", Kind::goal}, {"obstacle", Kind::obstacle}});
    return {kind, {}, {}};
  }
  if (py::hasattr(region, "__fspath__")) {
    return region_on_plan({Kind::cells, {}, region.cast<std::filesystem::path>()}, plan);
  }
  const py::array array = py::array::ensure(region);
  if (!array) {
    PyErr_Clear();
    refuse();
  }
  if (array.dtype().kind() == 'b') return of_mask(array, plan);
  if (array.ndim() == 2) return region_of_polygon(points_of(region, "region"), plan, "region");
  try {
    return rectangle_of(region.cast<std::array<double, 4>>());
  } catch (const py::cast_error&) {
    refuse();
  }
}

}  // namespace fairway::python
