// ceiling, improve, compare, tune: what is possible, and how near a plan comes.
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <nlohmann/json.hpp>

#include "binding.hpp"
#include "fairway/base/error.hpp"
#include "fairway/ceiling/ceiling_file.hpp"
#include "fairway/ceiling/find_ceiling.hpp"
#include "fairway/compare/compare_request.hpp"
#include "fairway/compare/comparison_text.hpp"
#include "fairway/report/draw_ceiling.hpp"
#include "fairway/run/ceiling_summary.hpp"
#include "fairway/run/improvement.hpp"
#include "fairway/tune/tune.hpp"

namespace fairway::python {
namespace {

using namespace pybind11::literals;

void require_limit(const char* name, std::optional<double> limit) {
  if (limit && !(*limit > 0.0 && *limit < 1e12)) {
    throw py::value_error(std::string(name) + ": expected a number > 0, or None");
  }
}

/// A ceiling, with the plan whose mission it is about.
struct HeldCeiling {
  Ceiling ceiling;
  std::shared_ptr<HeldPlan> of;
};

std::shared_ptr<HeldCeiling> ceiling(const std::shared_ptr<HeldPlan>& plan, double gap_max,
                                     int levels_max, std::optional<double> time_limit_s,
                                     double memory_limit_mb, const py::object& progress) {
  if (!(gap_max > 0.0 && gap_max < 1.0))
    throw py::value_error("gap_max: expected more than 0 and less than 1");
  if (levels_max < 1 || levels_max > 5) throw py::value_error("levels_max: expected 1 to 5");
  require_limit("time_limit_s", time_limit_s);
  require_limit("memory_limit_mb", memory_limit_mb);
  CeilingOptions options{gap_max, levels_max, CeilingOptions{}.time_limit_s, memory_limit_mb};
  if (time_limit_s) options.time_limit_s = *time_limit_s;
  const Progress told = progress_of(progress);
  const py::gil_scoped_release unlocked;
  StageClock clock(told);
  clock.begin(ceiling_stage, unknown_time);
  const Plan& p = plan->plan;
  auto held = std::make_shared<HeldCeiling>();
  held->of = plan;
  held->ceiling = find_ceiling(p.grid, p.region, p.vehicle, options);
  return held;
}

py::array shares(const std::vector<float>& of, const Ceiling& c, const py::object& self) {
  constexpr py::ssize_t size = sizeof(float);
  const auto row = c.grid.nx * size;
  return view(of.data(), {c.headings, c.grid.ny, c.grid.nx}, {c.grid.ny * row, row, size}, self);
}

/// What improve() made.
struct HeldImprovement {
  Improvement made;
  std::shared_ptr<HeldPlan> before;
  std::shared_ptr<HeldPlan> after;
};

std::shared_ptr<HeldImprovement> improve(const std::shared_ptr<HeldPlan>& plan,
                                         double undecided_max, std::optional<double> time_limit_s,
                                         int sweeps, std::optional<double> most_bend_rad,
                                         const py::object& progress) {
  if (!(undecided_max >= 0.0 && undecided_max <= 1.0)) {
    throw py::value_error("undecided_max: expected a share, 0 to 1");
  }
  if (sweeps < 1 || sweeps > 100) throw py::value_error("sweeps: expected 1 to 100");
  require_limit("time_limit_s", time_limit_s);
  require_limit("most_bend_rad", most_bend_rad);
  const ImprovementOptions options{undecided_max, time_limit_s.value_or(0.0), sweeps,
                                   most_bend_rad};
  const Progress told = progress_of(progress);
  const py::gil_scoped_release unlocked;
  StageClock clock(told);
  auto held = std::make_shared<HeldImprovement>();
  held->before = plan;
  held->made = improved(plan->plan, "the plan", options, clock);
  held->after = held->made.changed.empty() ? plan : std::make_shared<HeldPlan>(held->made.plan);
  return held;
}

py::array changes(const HeldImprovement& held) {
  std::vector<double> rows;
  const Plan& before = held.before->plan;
  for (const std::size_t i : held.made.changed) {
    const Vec2 at = before.grid.center(before.grid.cell_at(i));
    rows.insert(rows.end(), {at.x, at.y, static_cast<double>(before.heading_rad[i]),
                             static_cast<double>(held.made.plan.heading_rad[i])});
  }
  return owning(std::move(rows)).attr("reshape")(-1, 4);
}

py::dict dict_of(const SharesKept& proved) {
  return py::dict("exact"_a = proved.exact, "under_contract"_a = proved.under_contract);
}

py::object compare(const std::vector<std::filesystem::path>& plans,
                   const std::optional<std::filesystem::path>& folder, bool force, bool quick,
                   std::size_t states, std::uint64_t seed, double time_limit_s,
                   const py::object& progress) {
  if (plans.size() < 2 || plans.size() > 16) throw py::value_error("plans: expected 2 to 16");
  if (states < 1000 || states > 10'000'000) throw py::value_error("states: expected 1000 to 1e7");
  require_limit("time_limit_s", time_limit_s);
  CompareRequest request;
  request.plans = plans;
  if (folder) request.folder = *folder;
  request.quick = quick;
  request.compare.states = states;
  request.compare.seed = seed;
  request.prove.time_limit_s = time_limit_s;
  const Progress told = progress_of(progress);
  nlohmann::json found;
  {
    const py::gil_scoped_release unlocked;
    const Compared made =
        fairway::compare(std::move(request), force ? Existing::replace : Existing::keep, told);
    found = comparison_json(made.plans, made.comparison);
  }
  return python_of(found);
}

RunResult tune(const std::filesystem::path& scenario, const std::filesystem::path& folder,
               const std::vector<std::string>& vary, const std::string& objective, int evaluations,
               std::optional<double> time_limit_s, int finalists, bool resume, bool force,
               const py::object& progress) {
  if (evaluations < 1 || evaluations > 100000) {
    throw py::value_error("evaluations: expected 1 to 100000");
  }
  if (finalists < 1 || finalists > 100) throw py::value_error("finalists: expected 1 to 100");
  require_limit("time_limit_s", time_limit_s);
  TuneRequest request;
  request.scenario = scenario;
  for (const std::string& text : vary) request.parameters.push_back(parameter_of_text(text));
  request.objective = objective_of_text(objective);
  request.evaluations = evaluations;
  request.time_limit_s = time_limit_s.value_or(0.0);
  request.finalists = finalists;
  request.resume = resume;
  const Progress told = progress_of(progress);
  const py::gil_scoped_release unlocked;
  return fairway::tune(request, folder, force ? Existing::replace : Existing::keep, told);
}

py::tuple tuple_of(const CeilingShare& share) { return py::make_tuple(share.lower, share.upper); }

void bind_ceiling(py::module_& m) {
  py::class_<HeldCeiling, std::shared_ptr<HeldCeiling>>(
      m, "Ceiling",
      "What any control could do, as a bracket (docs/ceiling.md): shares (lower, upper) of the "
      "states from which some control brings the vehicle to the mission's cells.")
      .def_property_readonly(
          "all", [](const HeldCeiling& c) { return tuple_of(c.ceiling.all); },
          "(lower, upper), of all states of cells that are neither obstacle nor goal.")
      .def_property_readonly(
          "free", [](const HeldCeiling& c) { return tuple_of(c.ceiling.free); },
          "The same of safe starts.")
      .def_property_readonly(
          "buffer", [](const HeldCeiling& c) { return tuple_of(c.ceiling.buffer); },
          "The same of those nearer to obstacles.")
      .def_property_readonly(
          "levels", [](const HeldCeiling& c) { return c.ceiling.levels; },
          "How often it was refined; 0: a limit came first, and nothing is known.")
      .def_property_readonly(
          "complete", [](const HeldCeiling& c) { return c.ceiling.complete; },
          "False: a limit of time or memory came first.")
      .def_property_readonly(
          "inside",
          [](const py::object& self) {
            const Ceiling& c = self.cast<const HeldCeiling&>().ceiling;
            return shares(c.inside, c, self);
          },
          "float32 [headings, ny, nx], read-only: the share of a cell and a bin of headings from "
          "which some control is proved to do it. Bin k holds the headings from k to k + 1 times "
          "2 pi / headings.")
      .def_property_readonly(
          "lost",
          [](const py::object& self) {
            const Ceiling& c = self.cast<const HeldCeiling&>().ceiling;
            return shares(c.lost, c, self);
          },
          "The same: the share from which it is proved that no control does.")
      .def(
          "picture",
          [](const HeldCeiling& c, const std::string& title) {
            const py::gil_scoped_release unlocked;
            return draw_ceiling(c.ceiling, c.of->plan.region, {.title = title});
          },
          "title"_a = "", "Three panels: could, could not, and what lies between the bounds.")
      .def(
          "save",
          [](const HeldCeiling& c, const std::filesystem::path& path, bool force) {
            const py::gil_scoped_release unlocked;
            write_ceiling(c.ceiling, c.of->plan.region, path,
                          force ? Existing::replace : Existing::keep);
          },
          "path"_a, py::kw_only(), "force"_a = true, "As fairway ceiling -o writes it.")
      .def("__repr__", [](const HeldCeiling& c) {
        return fmt::format("<fairway.Ceiling: {:.4f} to {:.4f} of all states>", c.ceiling.all.lower,
                           c.ceiling.all.upper);
      });
  m.def("ceiling", &ceiling, "plan"_a, py::kw_only(), "gap_max"_a = CeilingOptions{}.gap_max,
        "levels_max"_a = CeilingOptions{}.levels_max, "time_limit_s"_a = py::none(),
        "memory_limit_mb"_a = CeilingOptions{}.memory_limit_mb, "progress"_a = py::none(),
        R"(Bounds what any control could do on the plan's map, a Ceiling.

The plan's commands do not matter, only its map, mission and turning radius. Levels are added until
the bounds of all states are within gap_max, up to levels_max (1 to 5), or until a limit of time
(seconds; None: 600) or memory (MB); what was found by then holds. progress: as in plan().)");
}

void bind_improve(py::module_& m) {
  py::class_<HeldImprovement, std::shared_ptr<HeldImprovement>>(m, "Improvement",
                                                                "What improve() made of a plan.")
      .def_property_readonly(
          "plan", [](const HeldImprovement& i) { return i.after; },
          "The improved plan; the one that was given when no better one was proved.")
      .def_property_readonly(
          "improved", [](const HeldImprovement& i) { return !i.made.changed.empty(); },
          "Whether a better one was proved.")
      .def_property_readonly("changes", &changes,
                             "float64 [n, 4]: x_m, y_m, heading before, heading after (rad), of "
                             "each cell that was changed, at its centre.")
      .def_property_readonly(
          "proved_before", [](const HeldImprovement& i) { return dict_of(i.made.before); },
          "Shares of all states that are proved: {\"exact\", \"under_contract\"}; None without "
          "a contract.")
      .def_property_readonly(
          "proved_after", [](const HeldImprovement& i) { return dict_of(i.made.after); },
          "The same of `plan`.")
      .def_property_readonly(
          "attempts", [](const HeldImprovement& i) { return i.made.attempts; },
          "How many improved plans were proved.")
      .def("__repr__", [](const HeldImprovement& i) {
        return fmt::format(
            "<fairway.Improvement: {} cells changed, {:.4f} to {:.4f} of all states>",
            i.made.changed.size(), i.made.before.exact, i.made.after.exact);
      });
  m.def("improve", &improve, "plan"_a, py::kw_only(), "undecided_max"_a = 0.01,
        "time_limit_s"_a = py::none(), "sweeps"_a = ImprovementOptions{}.sweeps,
        "most_bend_rad"_a = py::none(), "progress"_a = py::none(),
        R"(Changes commands of a plan where proofs confirm that it helps (docs/improve.md).

undecided_max  how far each proof goes, as in verify()
time_limit_s   of each search for better commands; None: none. Proofs come on top
sweeps         how often each cell is tried at most, 1 to 100
most_bend_rad  by which a changed command may differ from its neighbours' where it did not already;
               None: as proves best

Returns an Improvement: nothing less is proved than before, of the exact vehicle and under the
plan's contract. Raises InputError when the plan cannot be verified. progress: as in plan().)");
}

}  // namespace

void bind_best_plan(py::module_& m) {
  bind_ceiling(m);
  bind_improve(m);
  m.def("compare", &compare, "plans"_a, "dir"_a = py::none(), py::kw_only(), "force"_a = true,
        "quick"_a = false, "states"_a = CompareOptions{}.states, "seed"_a = CompareOptions{}.seed,
        "time_limit_s"_a = ProveComparedOptions{}.time_limit_s, "progress"_a = py::none(),
        R"(Compares plans over all states: what each proves, and what its flights cost.

plans         two to sixteen paths: folders of runs, plans, scenarios. The others are compared with
              the first; all are of one mission in one frame
dir           for the page, table, maps and states (docs/compare.md); None: nothing is written.
              It appears whole or not at all; with force=False an earlier one is kept
quick         prove nothing and read no certificate: fly the states
states, seed  of the sample: at least 1000
time_limit_s  of each proof that is not there yet

Returns what comparison.json holds, a dict. Raises InputError. progress: as in plan().)");
  m.def("tune", &tune, "scenario"_a, "dir"_a, py::kw_only(), "vary"_a = std::vector<std::string>{},
        "objective"_a = "reach", "evaluations"_a = TuneRequest{}.evaluations,
        "time_limit_s"_a = py::none(), "finalists"_a = TuneRequest{}.finalists, "resume"_a = false,
        "force"_a = true, "progress"_a = py::none(),
        R"(Finds the parameters with which most states are proved (docs/tuning.md).

scenario     the path of a TOML file
dir          for the tuned scenario, its plan, certificate, pictures and the evidence
vary         keys to vary, as "plan.alpha=0.3:2" or "map.cell_m=4,8"; none: the usual ones
objective    "reach", or weights such as "reach=1,time=0.05"
evaluations  how many parameters are tried, within time_limit_s seconds (None: no limit)
finalists    how many of the best are proved to the end, besides the scenario as given
resume       goes on with an interrupted search in dir

Returns a RunResult; raises as run() does. progress: as in plan().)");
}

}  // namespace fairway::python
