// run: scenarios, and the main flow.
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <tbb/global_control.h>
#include <nlohmann/json.hpp>

#include "binding.hpp"
#include "fairway/base/error.hpp"
#include "fairway/map/read_map.hpp"
#include "fairway/run/mission_on_map.hpp"
#include "fairway/run/run.hpp"
#include "fairway/run/scenario.hpp"
#include "fairway/run/scenario_keys.hpp"
#include "fairway/run/stage_clock.hpp"

namespace fairway::python {
namespace {

using namespace pybind11::literals;

std::shared_ptr<HeldPlan> plan(const Scenario& scenario, const py::object& progress) {
  const Progress told = progress_of(progress);
  const py::gil_scoped_release unlocked;
  StageClock clock(told);
  auto answer = plan_scenario(scenario, clock);
  if (auto* refusal = std::get_if<MissionRefusal>(&answer)) {
    const char* key = place_key(scenario);
    std::string message = fmt::format("{}: {}: {}", scenario.place_of(key), key, refusal->message);
    throw Refused{std::move(*refusal), std::move(message)};
  }
  return std::make_shared<HeldPlan>(std::move(std::get<Planned>(answer).plan));
}

RunResult run_whole(const Scenario& scenario, const std::filesystem::path& folder, bool force,
                    const py::object& progress) {
  const Progress told = progress_of(progress);
  const py::gil_scoped_release unlocked;
  RunResult result =
      fairway::run(scenario, folder, force ? Existing::replace : Existing::keep, told);
  if (result.unreachable) {
    throw Refused{
        {MissionRefusal::Reason::unreachable, result.summary["message"], 0.0, result.warnings},
        result.paragraph};
  }
  return result;
}

py::dict options_of(const Scenario& scenario) {
  py::dict tables;
  for (const char* table : {"map", "vehicle", "mission", "plan", "simulate", "verify"}) {
    tables[table] = python_of(effective_values(scenario, table));
  }
  return tables;
}

void limit_threads(std::optional<std::size_t> n) {
  // Kept until another call; under the interpreter's lock.
  static std::unique_ptr<tbb::global_control> bound;
  if (n && (*n < 1 || *n > 4096)) throw py::value_error("n: expected 1 to 4096, or None");
  bound.reset();
  if (n) {
    bound = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism, *n);
  }
}

}  // namespace

void bind_run(py::module_& m) {
  py::class_<Scenario, std::shared_ptr<Scenario>>(
      m, "Scenario", "Everything one run needs, from a TOML file (docs/scenario.md).")
      .def(py::init([](const std::filesystem::path& path) {
             return std::make_shared<Scenario>(read_scenario(path));
           }),
           "path"_a, "Raises InputError (a ValueError) naming file, line and key.")
      .def_static(
          "from_text",
          [](const std::string& text, const std::filesystem::path& file) {
            return std::make_shared<Scenario>(scenario_of_text(text, file));
          },
          "text"_a, "file"_a = "scenario.toml",
          "The same from TOML in memory; `file` names it in messages and roots its paths.")
      .def_property_readonly("path", [](const Scenario& s) { return s.file; })
      .def_property_readonly("options", &options_of,
                             "Every effective value, by table: {\"map\": {...}, ...}.")
      .def(
          "read_map",
          [](const Scenario& s) {
            const py::gil_scoped_release unlocked;
            return read_map(map_request(s));
          },
          "The map it plans on, an ObstacleMap.")
      .def("__repr__", [](const Scenario& s) {
        return fmt::format("<fairway.Scenario: {}>", s.file.string());
      });

  py::class_<RunResult>(m, "RunResult", "The result of a run; all products are in its folder.")
      .def_property_readonly(
          "summary", [](const RunResult& r) { return python_of(r.summary); },
          "What summary.json holds, a dict (docs/formats.md).")
      .def_property_readonly(
          "paragraph", [](const RunResult& r) { return r.paragraph; }, "The result in words.")
      .def_property_readonly(
          "warnings", [](const RunResult& r) { return r.warnings; },
          "Warnings about the map, free cells that are cut off, flights that fail, and a proof "
          "stopped by a limit.")
      .def("__repr__", [](const RunResult& r) { return r.paragraph; });

  m.def("plan", &plan, "scenario"_a, "progress"_a = py::none(),
        R"(map -> field -> plan, in memory.

progress  called as progress(stage, left_s) in the calling thread; left_s: seconds, None when
          unknown. An exception it raises, or Ctrl-C, stops the work at the next call.

Raises InputError (a ValueError) for bad input, MissionRefused when the goal cannot be reached.)");
  m.def("run", &run_whole, "scenario"_a, "dir"_a, py::kw_only(), "force"_a = true,
        "progress"_a = py::none(),
        R"(The main job: plans, flies, proves, checks and draws a scenario, into the folder `dir`.

The folder appears whole or not at all. Only the products of an earlier run in it are replaced;
with force=False a folder with files in it is kept and InputError is raised.
progress: as in plan(). Returns a RunResult; raises as plan() does.)");
  m.def(
      "limit_threads", &limit_threads, "n"_a,
      "Limits the number of threads of later calls; None: all cores. Results never depend on it.");
}

}  // namespace fairway::python
