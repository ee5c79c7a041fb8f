#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "fairway/app/argument_checks.hpp"
#include "fairway/app/command.hpp"
#include "fairway/app/ending.hpp"
#include "fairway/app/scenario_arguments.hpp"
#include "fairway/app/terminal_progress.hpp"
#include "fairway/run/run.hpp"

namespace fairway {
namespace {

namespace fs = std::filesystem;

struct RunArguments {
  ScenarioArguments scenario;
  fs::path folder;
  std::optional<double> time_limit_s;
  std::optional<double> undecided_max;
  bool no_verify = false;

  /// Options that are short for a --set.
  std::vector<ScenarioOverride> overrides() const {
    std::vector<ScenarioOverride> all;
    const auto add = [&](const char* key, const std::optional<double>& value, const char* option) {
      if (value) all.push_back({key, fmt::format("{}", *value), option});
    };
    add("verify.time_limit_s", time_limit_s, "--time-limit");
    add("verify.undecided_max", undecided_max, "--undecided-max");
    if (no_verify) all.push_back({"verify.method", "none", "--no-verify"});
    return all;
  }
};

int run_command(const RunArguments& arguments, const Session& session) {
  say_when_interrupted(
      "nothing of this run was kept; with --time-limit S a run keeps what is proved by then, and "
      "fairway verify --resume continues from its certificate");
  const Scenario scenario = arguments.scenario.read(arguments.overrides());
  const fs::path folder = arguments.folder.empty()
                              ? fs::path(scenario.file.stem().string() + "-out")
                              : arguments.folder;
  std::optional<TerminalProgress> terminal(std::in_place, session.quiet);
  const RunResult result = run(scenario, folder, session.existing(), terminal->progress());
  terminal.reset();
  return session.tell(result);
}

}  // namespace

Action declare_run(CLI::App& options) {
  auto arguments = std::make_shared<RunArguments>();
  RunArguments& a = *arguments;
  declare(options, a.scenario);
  options
      .add_option(
          "-o,--output", a.folder,
          "folder for all products (default: the scenario's name with -out, in the current folder)")
      ->type_name("DIR");
  options
      .add_option("--time-limit", a.time_limit_s,
                  "stop the proof after this many seconds (verify.time_limit_s)")
      ->check(finite_above(0.0))
      ->type_name("S");
  options
      .add_option("--undecided-max", a.undecided_max,
                  "stop the proof once at most this share of the volume is undecided; 1 gives a "
                  "quick first look (verify.undecided_max)")
      ->check(CLI::Range(0.0, 1.0))
      ->type_name("F");
  options.add_flag("--no-verify", a.no_verify, "plan and fly only, without a proof");
  options.final_callback([&a] {
    if (a.no_verify && (a.time_limit_s || a.undecided_max)) {
      throw CLI::ValidationError("--no-verify",
                                 "cannot be combined with --time-limit or --undecided-max");
    }
  });
  options.footer(
      "Writes to the folder, which appears complete or not at all: report.html, the page to open\n"
      "(fairway view DIR serves it with live queries); plan.safetensors;\n"
      "certificate.safetensors, what is proved of every state, and failures.csv;\n"
      "flights.csv, flights.geojson, outcomes.csv; pictures (SVG and PNG); summary.json.\n"
      "Example: fairway run demo/demo.toml -o out/demo");
  return [arguments](const Session& session) { return run_command(*arguments, session); };
}

}  // namespace fairway
