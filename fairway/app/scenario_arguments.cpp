#include "fairway/app/scenario_arguments.hpp"

#include "fairway/app/argument_checks.hpp"
#include "fairway/run/scenario_overrides.hpp"

namespace fairway {
std::vector<ScenarioOverride> ScenarioArguments::overrides() const {
  std::vector<ScenarioOverride> all;
  for (const std::string& text : set) all.push_back(override_of_text(text));
  return all;
}

Scenario ScenarioArguments::read(const std::vector<ScenarioOverride>& more) const {
  std::vector<ScenarioOverride> all = overrides();
  all.insert(all.end(), more.begin(), more.end());
  return read_scenario(file, all);
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
      ->check(readable([](const std::string& text) {  // before the scenario is read
        Scenario any;
        take_override(override_of_text(text), any);
      }))
      ->allow_extra_args(false)
      ->delimiter('\0');
}

}  // namespace fairway
