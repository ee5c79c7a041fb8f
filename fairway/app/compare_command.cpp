// fairway compare: plans side by side, over all states.
#include <memory>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "fairway/app/argument_checks.hpp"
#include "fairway/app/command.hpp"
#include "fairway/app/terminal_progress.hpp"
#include "fairway/base/share_text.hpp"
#include "fairway/compare/compare_request.hpp"
#include "fairway/compare/comparison_text.hpp"

namespace fairway {
namespace {

int compare_command(const CompareRequest& request, const Session& session) {
  std::optional<TerminalProgress> terminal(std::in_place, session.quiet);
  const auto [plans, comparison] = compare(request, session.existing(), terminal->progress());
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
  if (!request.folder.empty()) {
    text += fmt::format(" Look at {}.", (request.folder / "compare.html").string());
  }
  session.tell(comparison_json(plans, comparison), text);
  return exit_done;
}

}  // namespace

Action declare_compare(CLI::App& options) {
  auto request = std::make_shared<CompareRequest>();
  CompareRequest& a = *request;
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
  return [request](const Session& session) { return compare_command(*request, session); };
}

}  // namespace fairway
