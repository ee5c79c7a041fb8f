// fairway improve: changes a plan's commands where proofs confirm that more states then arrive.
#include <filesystem>
#include <memory>
#include <optional>

#include <fmt/format.h>

#include "fairway/app/argument_checks.hpp"
#include "fairway/app/command.hpp"
#include "fairway/app/places.hpp"
#include "fairway/app/terminal_progress.hpp"
#include "fairway/plan/plan_file.hpp"
#include "fairway/run/improvement.hpp"
#include "fairway/run/product_picture.hpp"
#include "fairway/run/summary.hpp"

namespace fairway {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct ImproveArguments {
  fs::path plan;
  fs::path output;
  fs::path changes;
  fs::path picture;
  ImprovementOptions options;
};

json shares_json(const SharesKept& shares) {
  json value = {{"exact", shares.exact}};
  if (shares.under_contract) value["under_contract"] = *shares.under_contract;
  return value;
}

int improve_command(const ImproveArguments& a, const Session& session) {
  require_places({a.output, a.changes, a.picture}, files_of({a.plan}), session.existing());
  std::optional<TerminalProgress> terminal(std::in_place, session.quiet);
  const Progress progress = terminal->progress();
  StageClock clock(progress);
  clock.begin("reading the plan", unknown_time);
  const Plan plan = read_plan(a.plan);
  const Improvement made = improved(plan, a.plan.string(), a.options, clock);
  terminal.reset();

  const bool better = !made.changed.empty();
  json summary = {{"plan", a.plan.string()},
                  {"improved", better},
                  {"cells_changed", made.changed.size()},
                  {"attempts", made.attempts},
                  {"proved_before", shares_json(made.before)},
                  {"proved_after", shares_json(made.after)}};
  const std::vector<Finding> found = findings(plan, made);
  summary["findings"] = findings_json(found);
  add_cost(summary, clock);
  if (better) {
    write_plan(made.plan, a.output, session.existing());
    if (!a.changes.empty()) write_whole(a.changes, session.existing(), changes_csv(plan, made));
    if (!a.picture.empty()) {
      write_picture(picture_of_plan(made.plan, a.output.stem().string()), a.picture,
                    session.existing());
    }
    summary["products"] = {{"plan", a.output.string()}};
  }
  session.tell(summary,
               fmt::format("{}\n{}\n{}", findings_table(found), cost_words(summary),
                           better ? fmt::format("Plan: {}.", a.output.string())
                                  : fmt::format("{} was not written.", a.output.string())));
  return better ? exit_done : exit_no;
}

}  // namespace

Action declare_improve(CLI::App& options) {
  auto a = std::make_shared<ImproveArguments>();
  options.add_option("plan", a->plan, "the plan file")->required()->type_name("PLAN");
  options.add_option("-o,--output", a->output, "the improved plan to write")
      ->required()
      ->type_name("PLAN.safetensors");
  options
      .add_option("--changes", a->changes,
                  "also write what was changed: x_m,y_m,before_rad,after_rad, a line for each cell")
      ->type_name("FILE.csv");
  options.add_option("--picture", a->picture, "also draw the improved plan, as fairway draw does")
      ->check(picture_argument())
      ->type_name("FILE");
  options
      .add_option("--undecided-max", a->options.undecided_max,
                  "how far each proof goes, as in fairway verify (default: 0.01)")
      ->check(CLI::Range(0.0, 1.0))
      ->type_name("F");
  options
      .add_option("--time-limit", a->options.time_limit_s,
                  "seconds for each search for better commands (default: none); proofs come on top")
      ->check(CLI::NonNegativeNumber)
      ->type_name("S");
  options
      .add_option("--sweeps", a->options.sweeps,
                  "how often each cell is tried at most (default: 4); more gain a little more")
      ->check(CLI::Range(1, 100))
      ->type_name("N");
  options
      .add_option("--most-bend", a->options.most_bend_rad,
                  "radians by which a changed command may differ from its neighbours' where it did "
                  "not already (default: as proves best)")
      ->check(CLI::PositiveNumber)
      ->type_name("A");
  options.footer(
      "Commands are tried cell by cell on a model of the plan, and the plan is proved before and\n"
      "after: of the exact vehicle, and under its contract if it has one. It is written only if\n"
      "more is proved than what the first proof left open could make up for, and no less under\n"
      "the contract; else the exit code is 1.\n"
      "Example: fairway improve out/demo/plan.safetensors -o better.safetensors");
  return [a](const Session& session) { return improve_command(*a, session); };
}

}  // namespace fairway
