#include <filesystem>
#include <memory>
#include <optional>

#include <fmt/format.h>

#include "fairway/app/command.hpp"
#include "fairway/app/terminal_progress.hpp"
#include "fairway/run/run.hpp"

namespace fairway {
namespace {

struct PlanArguments {
  std::filesystem::path scenario;
  std::filesystem::path output;
};

int plan_command(const PlanArguments& arguments, const Session& session) {
  const Scenario scenario = read_scenario(arguments.scenario);
  std::optional<TerminalProgress> terminal(std::in_place, session.quiet);
  const RunResult result =
      run_plan_only(scenario, arguments.output, session.existing(), terminal->progress());
  terminal.reset();
  return session.tell(result);
}

}  // namespace

Action declare_plan(CLI::App& options) {
  auto arguments = std::make_shared<PlanArguments>();
  options.add_option("scenario", arguments->scenario, "the scenario, TOML")
      ->required()
      ->type_name("SCENARIO.toml");
  options.add_option("-o,--output", arguments->output, "the plan file to write")
      ->required()
      ->type_name("PLAN.safetensors");
  options.footer("Example: fairway plan demo/demo.toml -o demo.safetensors");
  return [arguments](const Session& session) { return plan_command(*arguments, session); };
}

}  // namespace fairway
