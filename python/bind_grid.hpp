// What everything over a grid tells of it: a plan's certificate of either kind, a bitmap.
#pragma once

#include <pybind11/pybind11.h>

#include "binding.hpp"

namespace fairway::python {

/// `grid_of(held)`: its grid.
template <typename Held, typename GridOf>
void add_grid(py::class_<Held, std::shared_ptr<Held>>& to, GridOf grid_of) {
  const auto property = [&](const char* name, auto value, const char* doc) {
    to.def_property_readonly(
        name, [grid_of, value](const Held& held) { return value(grid_of(held)); }, doc);
  };
  property(
      "shape", [](const Grid& g) { return py::make_tuple(g.ny, g.nx); }, "(ny, nx).");
  property(
      "cell_m", [](const Grid& g) { return g.cell_m; }, "Side of a cell, metres.");
  property(
      "origin_m", [](const Grid& g) { return py::make_tuple(g.x0_m, g.y0_m); },
      "(x, y) of the lower left corner, metres.");
  property(
      "extent_m", [](const Grid& g) { return extent_of(g); },
      "(x low, x high, y low, y high), metres: matplotlib's `extent`, with origin=\"lower\".");
}

/// states_from_deg and states_to_deg, as a plan has them. `held.certificate` may have a frame.
template <typename Held>
void add_degrees(py::class_<Held, std::shared_ptr<Held>>& to) {
  to.def(
        "states_from_deg",
        [](const Held& held, const py::object& rows) {
          return states_from_degrees(held.certificate.frame.value_or(Frame{}), rows);
        },
        py::arg("states_deg"), "As Plan.states_from_deg.")
      .def(
          "states_to_deg",
          [](const Held& held, const py::object& rows) {
            return degrees_from_states(held.certificate.frame.value_or(Frame{}), rows);
          },
          py::arg("states"), "As Plan.states_to_deg.");
}

/// What to steer by the commands of its plan.
template <typename Held>
void add_command(py::class_<Held, std::shared_ptr<Held>>& to) {
  to.def(
      "command",
      [](const Held& held, double x_m, double y_m, double heading_rad) {
        const auto& c = held.certificate;
        return tuple_of(bang_bang(c.grid, c.vehicle, c.heading_rad.data(), x_m, y_m, heading_rad));
      },
      py::arg("x_m"), py::arg("y_m"), py::arg("heading_rad"), command_words);
}

}  // namespace fairway::python
