#include <filesystem>
#include <memory>
#include <optional>

#include <fmt/format.h>

#include "fairway/app/argument_checks.hpp"
#include "fairway/app/command.hpp"
#include "fairway/app/places.hpp"
#include "fairway/app/scenario_arguments.hpp"
#include "fairway/app/terminal_progress.hpp"
#include "fairway/run/run.hpp"

namespace fairway {
namespace {

struct PlanArguments {
  ScenarioArguments scenario;
  std::filesystem::path output;
  std::filesystem::path picture;
};

int plan_command(const PlanArguments& arguments, const Session& session) {
  const Scenario scenario = arguments.scenario.read();
  const Places inputs{scenario.file, scenario.map.file, scenario.mission.path_file.value_or("")};
  require_places({arguments.output, arguments.picture}, inputs, session.existing());
  std::optional<TerminalProgress> terminal(std::in_place, session.quiet);
  const RunResult result = run_plan_only(scenario, arguments.output, session.existing(),
                                         terminal->progress(), arguments.picture);
  terminal.reset();
  return session.tell(result);
}

}  // namespace

Action declare_plan(CLI::App& options) {
  auto arguments = std::make_shared<PlanArguments>();
  declare(options, arguments->scenario);
  options.add_option("-o,--output", arguments->output, "the plan file to write")
      ->required()
      ->type_name("PLAN.safetensors");
  options.add_option("--picture", arguments->picture, "also draw the plan, as fairway draw does")
      ->check(picture_argument())
      ->type_name("FILE");
  options.footer("Example: fairway plan demo/demo.toml -o demo.safetensors --picture demo.svg");
  return [arguments](const Session& session) { return plan_command(*arguments, session); };
}

}  // namespace fairway
