#include "fairway/app/scenario_arguments.hpp"

#include "fairway/base/error.hpp"
#include "fairway/run/scenario_overrides.hpp"

namespace fairway {
namespace {

/// Checks the key and its value before the scenario is read.
CLI::Validator override_argument() {
  return {[](const std::string& text) -> std::string {
            try {
              Scenario any;
              take_override(override_of_text(text), any);
              return {};
            } catch (const InputError& error) {
              const std::string place = error.where().empty() ? "" : error.where() + ": ";
              return std::string(error.what()).substr(place.size());
            }
          },
          ""};
}

}  // namespace

Scenario ScenarioArguments::read(const std::vector<ScenarioOverride>& more) const {
  std::vector<ScenarioOverride> overrides;
  for (const std::string& text : set) overrides.push_back(override_of_text(text));
  overrides.insert(overrides.end(), more.begin(), more.end());
  return read_scenario(file, overrides);
}

void declare(CLI::App& options, ScenarioArguments& arguments) {
  options.add_option("scenario", arguments.file, "the scenario (docs/scenario.md)")
      ->required()
      ->type_name("SCENARIO.toml");
  options
      .add_option("--set", arguments.set,
                  "override a value of the scenario: map.cell_m=4, plan.metric=paper, "
                  "'mission.goal_m=[30, 40]'; may be repeated")
      ->type_name("KEY=VALUE")
      ->check(override_argument())
      ->allow_extra_args(false)
      ->delimiter('\0');
}

}  // namespace fairway
