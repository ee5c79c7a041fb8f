// cellular: paper 2's sets of headings of one cell.
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "binding.hpp"
#include "fairway/cellular/border_backward_set.hpp"
#include "fairway/cellular/border_forward_set.hpp"
#include "fairway/cellular/cell_sets.hpp"

namespace fairway::python {
namespace {

using namespace pybind11::literals;

Side side_of(const char* option, const std::string& name) {
  return choice_of<Side>(
      option, name,
      {{"right", Side::right}, {"top", Side::top}, {"left", Side::left}, {"bottom", Side::bottom}});
}

/// Rows from, to in radians.
py::array ranges_of(const HeadingSet& set) {
  py::array_t<double> rows({static_cast<py::ssize_t>(set.count), py::ssize_t{2}});
  double* to = rows.mutable_data();
  for (const HeadingRange& range : set) {
    *to++ = range.from_rad;
    *to++ = range.to_rad();
  }
  return rows;
}

struct CellOfPlan {
  CellShape shape;
  Direction command;
};

CellOfPlan cell_of(const Plan& plan, int ix, int iy, double along_m) {
  if (!plan.grid.contains({ix, iy})) throw py::index_error("ix, iy: not a cell of the plan");
  if (!(along_m >= 0.0 && along_m <= plan.grid.cell_m)) {
    throw py::value_error("along_m: expected 0 to cell_m");
  }
  const double rad = plan.heading_rad[plan.grid.index({ix, iy})];
  return {{plan.grid.cell_m, plan.vehicle.turn_radius_m},
          std::isnan(rad) ? Direction::none() : Direction::of(Heading::from_rad(rad))};
}

py::array backward_set(const HeldPlan& held, int ix, int iy, const std::string& entry,
                       const std::string& exit, double along_m) {
  const CellOfPlan cell = cell_of(held.plan, ix, iy, along_m);
  return ranges_of(backward_headings_on_border(side_of("entry", entry), along_m, cell.command,
                                               cell.shape, side_of("exit", exit)));
}

py::array forward_set(const HeldPlan& held, int ix, int iy, const std::string& entry,
                      const std::string& exit, double along_m) {
  const CellOfPlan cell = cell_of(held.plan, ix, iy, along_m);
  return ranges_of(forward_headings(side_of("entry", entry), side_of("exit", exit), along_m,
                                    cell.command, cell.shape));
}

}  // namespace

void bind_cellular(py::module_& m) {
  auto plan = py::class_<HeldPlan, std::shared_ptr<HeldPlan>>(m.attr("Plan"));
  plan.def(
      "backward_set", &backward_set, "ix"_a, "iy"_a, "entry"_a, "exit"_a, "along_m"_a,
      R"(Paper 2's cellular backward set Theta of cell (ix, iy), at a place of its border `entry`.

entry, exit  "right", "top", "left" or "bottom"
along_m      the place, 0 to cell_m, upwards or to the right

Returns float64 [n, 2], ranges of headings from, to, radians, counter-clockwise from the first
to the second: those that enter the cell there and leave it by `exit`. None, one or two.)");
  plan.def("forward_set", &forward_set, "ix"_a, "iy"_a, "entry"_a, "exit"_a, "along_m"_a,
           R"(Paper 2's forward set Phi of cell (ix, iy), at a place of its border `exit`.

entry, exit  "right", "top", "left" or "bottom"
along_m      the place, 0 to cell_m, upwards or to the right

Returns float64 [n, 2], ranges of headings from, to, radians, counter-clockwise from the first
to the second: those with which a vehicle that entered anywhere on `entry` can leave there. Up
to three; a range may be a single heading, the command.)");
}

}  // namespace fairway::python
