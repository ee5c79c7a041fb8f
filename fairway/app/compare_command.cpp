// fairway compare: plans side by side, over all states.
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "fairway/app/argument_checks.hpp"
#include "fairway/app/command.hpp"
#include "fairway/app/places.hpp"
#include "fairway/app/terminal_progress.hpp"
#include "fairway/base/error.hpp"
#include "fairway/base/share_text.hpp"
#include "fairway/compare/compare_plans.hpp"
#include "fairway/compare/comparison_text.hpp"
#include "fairway/compare/read_compared_plan.hpp"
#include "fairway/compare/require_alike.hpp"
#include "fairway/compare/write_comparison.hpp"

namespace fairway {
namespace {

namespace fs = std::filesystem;

struct CompareArguments {
  std::vector<fs::path> plans;
  fs::path folder;
  ProveComparedOptions prove;
  CompareOptions compare;
  bool quick = false;

  /// The command that would do the same.
  std::string command() const {
    std::string words = "fairway compare";
    for (const fs::path& plan : plans) words += " " + plan.string();
    if (quick) words += " --quick";
    const CompareOptions usual;
    if (compare.states != usual.states) words += fmt::format(" --states {}", compare.states);
    if (compare.seed != usual.seed) words += fmt::format(" --seed {}", compare.seed);
    if (!quick) words += fmt::format(" --time-limit {:g}", prove.time_limit_s);
    return words + " -o " + folder.string();
  }
};

/// A run's folder holds what is read; nothing may be written into it.
void require_own_folder(const CompareArguments& a) {
  for (const std::string& name : comparison_files(a.plans.size())) {
    require_no_input(a.folder / name, a.plans);
  }
  for (const fs::path& plan : a.plans) {
    std::error_code error;
    if (fs::equivalent(a.folder, plan, error)) {
      throw InputError(a.folder.string(), "is one of the runs to compare, expected another folder");
    }
  }
}

int compare_command(CompareArguments a, const Session& session) {
  std::optional<AtomicFolder> folder;
  if (!a.folder.empty()) {
    require_own_folder(a);
    folder.emplace(a.folder, session.existing(), comparison_file, comparison_files(a.plans.size()));
  }
  a.prove.seed = a.compare.seed;
  if (a.quick) {
    a.compare.map_across = 64;
    a.compare.map_headings = 12;
  }
  std::optional<TerminalProgress> terminal(std::in_place, session.quiet);
  const Progress progress = terminal->progress();
  StageClock clock(progress);
  std::vector<ComparedPlan> plans;
  for (const fs::path& from : a.plans) plans.push_back(read_compared_plan(from, clock));
  name_apart(plans);
  (void)require_alike(plans);  // told before anything is proved
  for (ComparedPlan& plan : plans) {
    if (!a.quick) prove_compared_plan(a.prove, clock, plan);
  }
  const Comparison comparison = compare_plans(plans, a.compare, clock);
  if (folder) {
    clock.begin("writing", unknown_time);
    write_comparison(plans, comparison, a.command(), folder->temporary_path());
    folder->commit();
  }
  clock.end();
  terminal.reset();
  for (const std::string& warning : comparison.warnings) session.warn(warning);
  std::string text;
  for (const std::string& line : difference_lines(comparison)) text += line + "\n";
  text += "\n" + comparison_text(comparison);
  text += fmt::format(
      "\nIn brackets: the difference from {}, with its 95 % error. States are sampled in all cells "
      "that are\nneither obstacle nor goal in any plan, {}; shares of all are known to within "
      "{}.\nCosts are of exact flights: evidence, not a proof.",
      comparison.names.front(),
      comparison.is_proved ? "and answered by certificates" : "and flown, which proves nothing",
      percent_text(error_of_shares(comparison), 2));
  if (folder) text += fmt::format(" Look at {}.", (a.folder / "compare.html").string());
  session.tell(comparison_json(plans, comparison), text);
  return exit_done;
}

}  // namespace

Action declare_compare(CLI::App& options) {
  auto arguments = std::make_shared<CompareArguments>();
  CompareArguments& a = *arguments;
  options
      .add_option("plans", a.plans,
                  "two or more: folders of runs, plans, or scenarios, for which plans are made")
      ->required()
      ->expected(2, 16)
      ->type_name("DIR|PLAN|SCENARIO.toml");
  options
      .add_option("-o,--output", a.folder,
                  "folder for table, maps, states and the page (default: none is written)")
      ->type_name("DIR");
  options
      .add_option("--time-limit", a.prove.time_limit_s,
                  "for each proof that is not there yet, seconds")
      ->check(finite_above(0.0))
      ->type_name("S")
      ->capture_default_str();
  options.add_flag("--quick", a.quick,
                   "prove nothing and read no certificate: fly the states, and say what was seen");
  options.add_option("--states", a.compare.states, "number of states to sample")
      ->check(CLI::Range(std::size_t{1000}, std::size_t{10'000'000}))
      ->type_name("N")
      ->capture_default_str();
  options.add_option("--seed", a.compare.seed, "random seed of the states")
      ->type_name("S")
      ->capture_default_str();
  options.footer(
      "The first is what the others are compared with. All must be of one mission in one frame;\n"
      "vehicles, options and cells may differ. With -o: compare.html, the page to open;\n"
      "comparison.json and comparison.csv, every number with its error; states.csv, the states\n"
      "that one plan proves and another does not; difference.svg and .png, the maps.\n"
      "Example: fairway compare out/base out/wide -o out/compared");
  return [arguments](const Session& session) { return compare_command(*arguments, session); };
}

}  // namespace fairway
