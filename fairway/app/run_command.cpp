#include <filesystem>
#include <memory>
#include <optional>

#include <fmt/format.h>

#include "fairway/app/command.hpp"
#include "fairway/app/terminal_progress.hpp"
#include "fairway/run/run.hpp"

namespace fairway {
namespace {

namespace fs = std::filesystem;

struct RunArguments {
  fs::path scenario;
  fs::path folder;
};

int run_command(const RunArguments& arguments, const Session& session) {
  const Scenario scenario = read_scenario(arguments.scenario);
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
  options.add_option("scenario", arguments->scenario, "the scenario (docs/scenario.md)")
      ->required()
      ->type_name("SCENARIO.toml");
  options
      .add_option("-o,--output", arguments->folder,
                  "folder for every product (default: the scenario's name with -out, here)")
      ->type_name("DIR");
  options.footer(
      "Leaves in the folder, which appears whole or not at all: report.html, the page to look\n"
      "at (fairway view DIR serves it, and it then answers live); plan.safetensors;\n"
      "certificate.safetensors, what is proved of every state, with failures.csv;\n"
      "flights.csv, flights.geojson, outcomes.csv; pictures (SVG and PNG); summary.json.\n"
      "Example: fairway run demo/demo.toml -o out/demo");
  return [arguments](const Session& session) { return run_command(*arguments, session); };
}

}  // namespace fairway
