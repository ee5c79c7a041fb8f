#include "fairway/run/plan_scenario.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>

#include "fairway/field/compute_field.hpp"
#include "fairway/map/read_map.hpp"
#include "fairway/plan/plan_of_field.hpp"
#include "fairway/run/cell_size_warning.hpp"
#include "fairway/run/choose_modes.hpp"
#include "fairway/run/design_warnings.hpp"
#include "fairway/run/improvement.hpp"
#include "fairway/run/mission_on_map.hpp"
#include "fairway/run/only_connected.hpp"
#include "fairway/run/plan_record.hpp"
#include "fairway/run/run_estimate.hpp"

namespace fairway {
namespace {

/// The further modes that the scenario asks for; those that it leaves open, if they are worth it.
void add_modes(Plan& plan, const Scenario& scenario, StageClock& clock) {
  if (scenario.modes == 0 && !scenario.open.modes) return;
  // Choosing takes a proof: some 30 s on a map of 30,000 open cells, where planning takes 0.1 s.
  constexpr std::ptrdiff_t most_open_cells = 100'000;
  const auto open_cells = std::count_if(plan.region.begin(), plan.region.end(),
                                        [](Region r) { return r != Region::obstacle; });
  if (scenario.open.modes && open_cells > most_open_cells) return;
  // That a path is followed, or a goal held at, is proved of the plan's own field alone.
  if (scenario.open.modes &&
      (scenario.mission.kind != MissionKind::goal || scenario.mission.hold)) {
    return;
  }
  clock.begin("choosing modes", unknown_time);
  ModeOptions options;
  if (!scenario.open.modes) options.most = scenario.modes;
  const ChosenModes chosen = choose_modes(plan, scenario.file.string(), options);
  if (scenario.open.modes && !are_worth_it(chosen)) return;
  plan.mode_heading_rad = chosen.heading_rad;
  plan.record.modes = chosen.records;
}

}  // namespace

std::variant<Planned, MissionRefusal> plan_scenario(const Scenario& asked, StageClock& clock) {
  Scenario scenario = asked;
  clock.begin("reading the map", unknown_time);
  ObstacleMap map = read_map(map_request(scenario));
  Mission mission = mission_on_map(scenario, map);
  for (std::string& warning : design_warnings(scenario, mission)) {
    map.warnings.push_back(std::move(warning));
  }
  if (auto warning = cell_size_warning(scenario, map, mission)) map.warnings.push_back(*warning);
  if (scenario.only_connected) keep_only_connected(map, mission, scenario.map.file.string());

  ChosenParameters chosen{scenario.plan, {}};
  const bool modes_are_open = scenario.open.modes;
  if (scenario.open.alpha || scenario.open.sigma_cells) {
    clock.begin("choosing parameters", estimate(scenario, map.grid).from_field());
    chosen = choose_parameters(
        map, scenario.vehicle, mission,
        candidate_options(scenario.plan, scenario.open, scenario.vehicle, map.grid.cell_m));
    scenario.plan = chosen.options;
    scenario.open = {};
    scenario.open.modes = modes_are_open;
  }
  clock.begin("computing the field", estimate(scenario, map.grid).from_field());
  FieldOrRefusal answer = compute_field(map, scenario.vehicle, mission, scenario.plan);
  if (auto* refusal = std::get_if<MissionRefusal>(&answer)) {
    if (refusal->reason != MissionRefusal::Reason::unreachable) {
      throw_refusal(scenario, map.frame, *refusal);
    }
    return std::move(*refusal);
  }
  Plan plan = plan_of_field(std::move(std::get<Field>(answer)), scenario.vehicle,
                            plan_record(scenario, map, mission));
  if (scenario.improve) plan = improved(plan, scenario.file.string(), {}, clock).plan;
  add_modes(plan, scenario, clock);
  return Planned{std::move(map), std::move(mission), std::move(plan), std::move(scenario),
                 std::move(chosen.tried)};
}

}  // namespace fairway
