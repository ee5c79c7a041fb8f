#include "reproduce/world.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include "fairway/base/heading.hpp"
#include "fairway/field/buffer_border.hpp"
#include "fairway/field/complete_map.hpp"
#include "fairway/field/compute_field.hpp"
#include "fairway/field/cost_to_go.hpp"
#include "fairway/field/raw_field.hpp"
#include "fairway/field/transition.hpp"
#include "fairway/map/read_map.hpp"
#include "fairway/plan/plan_of_field.hpp"
#include "fairway/run/mission_on_map.hpp"
#include "fairway/run/scenario.hpp"

namespace fairway::reproduce {
namespace {

Plan plan_of_vectors(const World& world, const CompleteMap& complete,
                     const std::vector<float>& cost_cells, const VectorField& field) {
  Plan plan;
  plan.grid = world.map.grid;
  plan.vehicle = world.vehicle;
  plan.region = complete.region;
  for (std::size_t i = 0; i < plan.grid.size(); ++i) {
    const bool none = field.x[i] == 0.0F && field.y[i] == 0.0F;
    plan.heading_rad.push_back(none ? std::numeric_limits<float>::quiet_NaN()
                                    : Heading::stored(std::atan2(field.y[i], field.x[i])));
    plan.cost_m.push_back(cost_cells[i] * static_cast<float>(plan.grid.cell_m));
  }
  return plan;
}

}  // namespace

World world_of(const std::filesystem::path& scenario_file, double cell_m) {
  Scenario scenario = read_scenario(scenario_file);
  scenario.map.cell_m = cell_m;
  World world{read_map(map_request(scenario)), scenario.vehicle, {}, {}};
  world.mission = mission_on_map(scenario, world.map);
  if (scenario.simulate.states.empty())
    throw std::runtime_error(scenario_file.string() + " has no simulate.states");
  world.start = scenario.simulate.states.front();
  return world;
}

Plan plan_in(const World& world, const FieldOptions& options) {
  FieldOrRefusal result = compute_field(world.map, world.vehicle, world.mission, options);
  if (const auto* refusal = std::get_if<MissionRefusal>(&result))
    throw std::runtime_error(refusal->message);
  return plan_of_field(std::move(std::get<Field>(result)), world.vehicle);
}

FieldSteps steps_in(const World& world, const FieldOptions& options) {
  const Grid& grid = world.map.grid;
  auto placed = complete_map(world.map, world.vehicle, world.mission, options);
  if (const auto* refusal = std::get_if<MissionRefusal>(&placed))
    throw std::runtime_error(refusal->message);
  const CompleteMap& complete = std::get<CompleteMap>(placed);
  std::vector<float> cost = cost_to_go(grid, complete, world.mission, options.metric);
  BufferBorder border = buffer_border(grid, complete.region, cost);
  const VectorField raw = raw_field(grid, complete, world.mission, options.metric, cost, border);
  const VectorField turned = transition_field(grid, complete, border, raw, world.vehicle, options);
  return {plan_of_vectors(world, complete, cost, VectorField(grid.size())),
          plan_of_vectors(world, complete, cost, raw),
          plan_of_vectors(world, complete, cost, turned), plan_in(world, options)};
}

}  // namespace fairway::reproduce
