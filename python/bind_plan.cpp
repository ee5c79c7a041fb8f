// plan: the product, its arrays without copies, its files.
#include <filesystem>
#include <memory>
#include <string>

#include <fmt/format.h>
#include <pybind11/stl/filesystem.h>

#include "binding.hpp"
#include "fairway/base/atomic_file.hpp"
#include "fairway/exchange/plan_rasters.hpp"
#include "fairway/plan/plan_file.hpp"
#include "fairway/run/contract_file.hpp"
#include "fairway/vehicle/contract_json.hpp"
#include "fairway/vehicle/vehicle_json.hpp"

namespace fairway::python {
namespace {

using namespace pybind11::literals;

template <typename T, typename Code>
py::array array_of(const py::object& self, const std::vector<T> Plan::*member) {
  const Plan& plan = self.cast<const HeldPlan&>().plan;
  return grid_view(reinterpret_cast<const Code*>((plan.*member).data()), plan.grid, self);
}

}  // namespace

void bind_plan(py::module_& m) {
  py::class_<HeldPlan, std::shared_ptr<HeldPlan>>(
      m, "Plan",
      "A feedback plan: for every cell the heading to steer.\n\n"
      "Arrays are [ny, nx], the lowest row first, and read-only views of the plan's own memory, "
      "which they keep alive. Cell [iy, ix] covers origin_m + cell_m * (ix, iy) to origin_m + "
      "cell_m * (ix + 1, iy + 1).")
      .def_property_readonly(
          "heading_rad",
          [](const py::object& self) { return array_of<float, float>(self, &Plan::heading_rad); },
          "float32 [ny, nx]: commanded heading, radians counter-clockwise from east, in (-pi, pi]; "
          "NaN: no command, the cell is crossed straight.")
      .def_property_readonly(
          "mode_heading_rad",
          [](const py::object& self) {
            const Plan& plan = self.cast<const HeldPlan&>().plan;
            constexpr auto size = static_cast<py::ssize_t>(sizeof(float));
            const py::ssize_t nx = plan.grid.nx;
            const py::ssize_t ny = plan.grid.ny;
            return view(plan.mode_heading_rad.data(),
                        {static_cast<py::ssize_t>(plan.further_modes()), ny, nx},
                        {ny * nx * size, nx * size, size}, self);
          },
          "float32 [modes, ny, nx]: the commands of the modes after the first, as heading_rad "
          "(docs/modes.md); [0, ny, nx] for a plan with one mode. record[\"modes\"] tells how "
          "each was made.")
      .def_property_readonly(
          "cost_m",
          [](const py::object& self) { return array_of<float, float>(self, &Plan::cost_m); },
          "float32 [ny, nx]: cost to go, metres; +inf where the goal cannot be reached.")
      .def_property_readonly(
          "region",
          [](const py::object& self) { return array_of<Region, std::int8_t>(self, &Plan::region); },
          "int8 [ny, nx]: 0 free (safe start), 1 obstacle, -1 buffer, 2 goal; see Region.")
      .def_property_readonly(
          "cell_m", [](const HeldPlan& p) { return p.plan.grid.cell_m; }, "Side of a cell, metres.")
      .def_property_readonly(
          "origin_m",
          [](const HeldPlan& p) { return py::make_tuple(p.plan.grid.x0_m, p.plan.grid.y0_m); },
          "(x, y) of the lower left corner, metres.")
      .def_property_readonly(
          "shape", [](const HeldPlan& p) { return py::make_tuple(p.plan.grid.ny, p.plan.grid.nx); },
          "(ny, nx).")
      .def_property_readonly(
          "extent_m", [](const HeldPlan& p) { return extent_of(p.plan.grid); },
          "(x low, x high, y low, y high), metres: matplotlib's `extent`, with origin=\"lower\".")
      .def_property_readonly(
          "vehicle",
          [](const HeldPlan& p) { return python_of_json(json_of(p.plan.vehicle).dump()); },
          "{\"speed_mps\": metres per second, \"turn_radius_m\": metres}.")
      .def_property_readonly(
          "contract",
          [](const HeldPlan& p) -> py::object {
            if (!p.plan.record.contract) return py::none();
            return python_of_json(json_of(*p.plan.record.contract).dump());
          },
          "What the vehicle keeps, a dict as in docs/formats.md, or None: it is exact "
          "(docs/model.md, \"Under a contract\").")
      .def_property_readonly(
          "record", [](const HeldPlan& p) { return python_of_json(json_text(p.plan.record)); },
          "How the plan was made, a dict: mission, every effective option, inputs, frame "
          "(docs/formats.md).")
      .def(
          "command",
          [](const HeldPlan& p, double x_m, double y_m, double heading_rad) {
            return tuple_of(bang_bang(p.plan.grid, p.plan.vehicle, p.plan.heading_rad.data(), x_m,
                                      y_m, heading_rad));
          },
          "x_m"_a, "y_m"_a, "heading_rad"_a, command_words)
      .def(
          "save",
          [](const HeldPlan& p, const std::filesystem::path& path, bool force) {
            const py::gil_scoped_release unlocked;
            write_plan(p.plan, path, force ? Existing::replace : Existing::keep);
          },
          "path"_a, py::kw_only(), "force"_a = true,
          "Writes a plan file (safetensors), whole or not at all. Replaces an existing file; with "
          "force=False raises InputError instead.")
      .def(
          "save_geotiff",
          [](const HeldPlan& p, const std::filesystem::path& path, bool force) {
            const py::gil_scoped_release unlocked;
            write_plan_raster(p.plan, path, force ? Existing::replace : Existing::keep);
          },
          "path"_a, py::kw_only(), "force"_a = true,
          "Writes heading, cost and region as the bands of a GeoTIFF, and the headings of further "
          "modes, georeferenced if the map was (docs/exchange.md).")
      .def(
          "states_from_deg",
          [](const HeldPlan& p, const py::object& rows) {
            return states_from_degrees(frame_in(p.plan.record), rows);
          },
          "states_deg"_a,
          R"(Converts states in degrees to the states that fly and query take.

states_deg  [n, 3]: latitude, longitude, and the course over ground, clockwise from true north

Returns float64 [n, 3]: x_m, y_m, heading_rad. Raises InputError when the map is not
georeferenced.)")
      .def(
          "states_to_deg",
          [](const HeldPlan& p, const py::object& rows) {
            return degrees_from_states(frame_in(p.plan.record), rows);
          },
          "states"_a,
          "The inverse: float64 [n, 3], latitude, longitude and course in [0, 360), of states "
          "x_m, y_m, heading_rad.")
      .def("__repr__", [](const HeldPlan& p) {
        return fmt::format("<fairway.Plan: {}, {:g} m/s, turning radius {:g} m>",
                           words_of(p.plan.grid), p.plan.vehicle.speed_mps,
                           p.plan.vehicle.turn_radius_m);
      });

  m.def(
      "load_plan",
      [](const std::filesystem::path& path) {
        const py::gil_scoped_release unlocked;
        return std::make_shared<HeldPlan>(read_plan(path));
      },
      "path"_a,
      "Reads a plan file strictly. Raises InputError (a ValueError) naming the field that is "
      "wrong.");

  m.def(
      "read_contract",
      [](const std::filesystem::path& path, double speed_mps, double turn_radius_m) {
        return python_of_json(json_of(read_contract(path, {speed_mps, turn_radius_m})).dump());
      },
      "path"_a, py::kw_only(), "speed_mps"_a, "turn_radius_m"_a,
      R"(Reads what a vehicle keeps from a TOML file with a table [vehicle.contract], alone or in a
scenario (docs/scenario.md).

speed_mps, turn_radius_m  the plan's vehicle: ranges that the file leaves out hold these alone, and
                          all must hold them

Returns a dict, as Plan.contract. Raises InputError naming file, line and key.)");
}

}  // namespace fairway::python
