// map: obstacle maps, from files.
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "binding.hpp"
#include "fairway/map/read_map.hpp"

namespace fairway::python {
namespace {

using namespace pybind11::literals;

std::size_t obstacle_cells(const ObstacleMap& map) {
  std::size_t count = 0;
  for (const std::uint8_t cell : map.obstacle) count += cell;
  return count;
}

py::object georeference(const ObstacleMap& map) {
  if (!map.frame.geo) return py::none();
  return py::dict("latitude_deg"_a = map.frame.geo->latitude_deg,
                  "longitude_deg"_a = map.frame.geo->longitude_deg,
                  "worst_error_m"_a = map.frame.geo->worst_error_m);
}

ObstacleMap read(const std::filesystem::path& file, double cell_m,
                 std::optional<double> resolution_m, const std::optional<std::string>& inclusion,
                 const std::string& unknown, const std::string& outside, double footprint_radius_m,
                 const std::optional<std::pair<double, double>>& reference_deg,
                 std::optional<double> altitude_m, double margin_m,
                 std::optional<double> world_margin_m) {
  MapRequest request;
  request.file = file;
  request.cell_m = cell_m;
  request.resolution_m = resolution_m;
  if (inclusion) {
    request.inclusion = choice_of<Inclusion>("inclusion", *inclusion,
                                             {{"all", Inclusion::all}, {"any", Inclusion::any}});
  }
  request.unknown_is_obstacle =
      choice_of<bool>("unknown", unknown, {{"obstacle", true}, {"free", false}});
  request.outside_is_obstacle =
      choice_of<bool>("outside", outside, {{"obstacle", true}, {"free", false}});
  request.footprint_radius_m = footprint_radius_m;
  if (reference_deg) request.reference = GeodeticPoint{reference_deg->first, reference_deg->second};
  request.altitude_m = altitude_m;
  request.margin_m = margin_m;
  request.world_margin_m = world_margin_m;
  const py::gil_scoped_release unlocked;
  return read_map(request);
}

}  // namespace

void bind_map(py::module_& m) {
  add_enum(m, "Region", "The class of a cell, as in Plan.region.",
           {{"buffer", static_cast<int>(Region::buffer)},
            {"free", static_cast<int>(Region::free)},
            {"obstacle", static_cast<int>(Region::obstacle)},
            {"goal", static_cast<int>(Region::goal)}});

  py::class_<ObstacleMap, std::shared_ptr<ObstacleMap>>(
      m, "ObstacleMap", "A grid of cells, each an obstacle or not, and where it came from.")
      .def_property_readonly(
          "obstacle",
          [](const py::object& self) {
            const auto& map = self.cast<const ObstacleMap&>();
            return grid_view(map.obstacle.data(), map.grid, self);
          },
          "uint8 [ny, nx], the lowest row first: 1 obstacle, 0 not. A read-only view.")
      .def_property_readonly(
          "cell_m", [](const ObstacleMap& map) { return map.grid.cell_m; },
          "Side of a cell, metres.")
      .def_property_readonly(
          "origin_m",
          [](const ObstacleMap& map) { return py::make_tuple(map.grid.x0_m, map.grid.y0_m); },
          "(x, y) of the lower left corner, metres.")
      .def_property_readonly(
          "shape", [](const ObstacleMap& map) { return py::make_tuple(map.grid.ny, map.grid.nx); },
          "(ny, nx).")
      .def_property_readonly(
          "extent_m", [](const ObstacleMap& map) { return extent_of(map.grid); },
          "(x low, x high, y low, y high), metres: matplotlib's `extent`, with origin=\"lower\".")
      .def_property_readonly("georeference", &georeference,
                             "Reference point of the tangent plane, a dict of latitude_deg, "
                             "longitude_deg, worst_error_m, if the map was in degrees; else None.")
      .def_property_readonly(
          "projected_crs", [](const ObstacleMap& map) { return map.frame.projected_crs; },
          "WKT of a projected map's reference system, or None.")
      .def_property_readonly(
          "warnings", [](const ObstacleMap& map) { return map.warnings; },
          "Warnings, one sentence each.")
      .def("__repr__", [](const ObstacleMap& map) {
        return fmt::format("<fairway.ObstacleMap: {}, {} of them obstacles>", words_of(map.grid),
                           obstacle_cells(map));
      });

  const MapRequest defaults;
  m.def("read_map", &read, "file"_a, "cell_m"_a, py::kw_only(), "resolution_m"_a = py::none(),
        "inclusion"_a = py::none(), "unknown"_a = "obstacle", "outside"_a = "obstacle",
        "footprint_radius_m"_a = defaults.footprint_radius_m, "reference_deg"_a = py::none(),
        "altitude_m"_a = py::none(), "margin_m"_a = defaults.margin_m,
        "world_margin_m"_a = py::none(),
        R"(Reads a map file of any supported format into cells of side `cell_m` (metres).

ROS map_server .yaml, MovingAI .map, GeoJSON, QGroundControl .plan, ArduPilot fences, QGC
waypoints, or images (GeoTIFF; PNG, PGM, ... with a world file or `resolution_m`, metres per
pixel). Conservative: a cell is an obstacle if any obstacle point, grown by `footprint_radius_m`,
touches it. The keywords are the keys of a scenario's [map] table.

Raises InputError (a ValueError) naming the file and the line, key or feature.)");
}

}  // namespace fairway::python
