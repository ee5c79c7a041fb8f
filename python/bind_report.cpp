// report: pictures, and how notebooks show them.
#include <filesystem>
#include <string>

#include <pybind11/stl/filesystem.h>

#include "binding.hpp"
#include "fairway/base/atomic_file.hpp"
#include "fairway/report/draw_plan.hpp"
#include "fairway/run/plan_map.hpp"

namespace fairway::python {
namespace {

using namespace pybind11::literals;

Picture picture(const HeldPlan& held, const std::string& title, bool cost, bool streamlines,
                bool arrows) {
  const py::gil_scoped_release unlocked;
  PlanPictureOptions options;
  options.title = title;
  options.mission = held.plan.record.mission;
  options.cost = cost;
  options.streamlines = streamlines;
  options.arrows = arrows;
  return draw_plan(held.plan, options);
}

void save(const Picture& drawn, const std::filesystem::path& path, bool force) {
  const std::string kind = path.extension().string();
  if (kind != ".svg" && kind != ".png") {
    throw py::value_error("path: expected a name that ends in .svg or .png");
  }
  const py::gil_scoped_release unlocked;
  write_whole(path, force ? Existing::replace : Existing::keep,
              kind == ".svg" ? drawn.svg : drawn.png);
}

}  // namespace

void bind_picture(py::module_& m) {
  py::class_<Picture>(m, "Picture", "A finished picture, as SVG and as PNG; notebooks display it.")
      .def_property_readonly(
          "svg", [](const Picture& drawn) { return py::str(drawn.svg); }, "The SVG's text.")
      .def_property_readonly(
          "png", [](const Picture& drawn) { return py::bytes(drawn.png); }, "The PNG's bytes.")
      .def("save", &save, "path"_a, py::kw_only(), "force"_a = true,
           "Writes a .svg or .png file; replaces an existing one unless force=False.")
      .def("_repr_png_", [](const Picture& drawn) { return py::bytes(drawn.png); })
      .def("__repr__", [](const Picture&) { return "<fairway.Picture>"; });
}

void bind_report(py::module_& m) {
  const PlanPictureOptions d;
  auto plan = py::class_<HeldPlan, std::shared_ptr<HeldPlan>>(m.attr("Plan"));
  plan.def("picture", &picture, py::kw_only(), "title"_a = "", "cost"_a = d.cost,
           "streamlines"_a = d.streamlines, "arrows"_a = d.arrows,
           "Draws regions, cost to go and the field as streamlines or arrows; returns a Picture.");
  plan.def("_repr_png_", [d](const HeldPlan& held) {
    return py::bytes(picture(held, "", d.cost, d.streamlines, d.arrows).png);
  });
}

}  // namespace fairway::python
