#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "fairway/app/argument_checks.hpp"
#include "fairway/app/command.hpp"
#include "fairway/app/ending.hpp"
#include "fairway/app/scenario_arguments.hpp"
#include "fairway/app/terminal_progress.hpp"
#include "fairway/tune/tune.hpp"

namespace fairway {
namespace {

struct TuneArguments {
  ScenarioArguments scenario;
  std::filesystem::path folder;
  std::vector<std::string> vary;
  std::string objective = "reach";
  int evaluations = TuneRequest{}.evaluations;
  std::optional<double> time_limit_s;
  int finalists = TuneRequest{}.finalists;
  bool resume = false;
};

int tune_command(const TuneArguments& arguments, const Session& session) {
  say_when_interrupted("evaluations.csv is kept; fairway tune --resume continues from it");
  TuneRequest request;
  request.scenario = arguments.scenario.file;
  request.overrides = arguments.scenario.overrides();
  for (const std::string& text : arguments.vary) {
    request.parameters.push_back(parameter_of_text(text));
  }
  request.objective = objective_of_text(arguments.objective);
  request.evaluations = arguments.evaluations;
  request.time_limit_s = arguments.time_limit_s.value_or(0.0);
  request.finalists = arguments.finalists;
  request.resume = arguments.resume;
  std::optional<TerminalProgress> terminal(std::in_place, session.quiet);
  const RunResult result =
      tune(request, arguments.folder, session.existing(), terminal->progress());
  terminal.reset();
  return session.tell(result);
}

}  // namespace

Action declare_tune(CLI::App& options) {
  auto arguments = std::make_shared<TuneArguments>();
  TuneArguments& a = *arguments;
  declare(options, a.scenario);
  options.add_option("-o,--output", a.folder, "folder for the tuned scenario and the evidence")
      ->required()
      ->type_name("DIR");
  options
      .add_option("--vary", a.vary,
                  "a key to vary: KEY=LOW:HIGH, such as plan.alpha=0.3:2, or KEY=VALUE,VALUE, such "
                  "as map.cell_m=4,8; may be repeated (default: plan.alpha, plan.sigma_cells, "
                  "plan.sigma_border, plan.mu_border)")
      ->type_name("KEY=VALUES")
      ->check(readable([](const std::string& text) { (void)parameter_of_text(text); }))
      ->allow_extra_args(false)
      ->delimiter('\0');
  options
      .add_option("--objective", a.objective,
                  "reach: the share of all states that is proved, then time; or weights of reach, "
                  "safe (share of safe starts) and time, such as reach=1,time=0.05")
      ->type_name("WHAT")
      ->check(readable([](const std::string& text) { (void)objective_of_text(text); }))
      ->delimiter('\0')
      ->capture_default_str();
  options.add_option("--evaluations", a.evaluations, "how many parameters to try")
      ->check(CLI::Range(1, 100000))
      ->type_name("N")
      ->capture_default_str();
  options
      .add_option("--time-limit", a.time_limit_s,
                  "end the search after this many seconds; the proofs come in addition")
      ->check(finite_above(0.0))
      ->type_name("S");
  options
      .add_option("--finalists", a.finalists,
                  "how many of the best plans to prove, besides that of the scenario as given")
      ->check(CLI::Range(1, 100))
      ->type_name("K")
      ->capture_default_str();
  options.add_flag("--resume", a.resume, "continue a search in DIR that was interrupted");
  options.footer(
      "Writes scenario.toml with the best parameters, its plan and certificate, summary.json, and\n"
      "pictures; evaluations.csv has a line for everything that was tried.\n"
      "Example: fairway tune demo/demo.toml -o out/tuned --evaluations 100");
  return [arguments](const Session& session) { return tune_command(*arguments, session); };
}

}  // namespace fairway
