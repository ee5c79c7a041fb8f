#include "fairway/run/replan.hpp"

#include <array>
#include <cstring>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "fairway/base/error.hpp"
#include "fairway/base/random.hpp"
#include "fairway/run/plan_map.hpp"

namespace fairway {
namespace {

/// Rectangles of obstacles here and there, a border of them often, and now and then nothing.
ObstacleMap map_of(Random& random) {
  ObstacleMap map;
  map.grid = {8 + static_cast<int>(random.below(40)), 8 + static_cast<int>(random.below(40)),
              random.uniform(-500.0, 500.0), random.uniform(-500.0, 500.0),
              random.uniform(0.3, 9.0)};
  map.obstacle.assign(map.grid.size(), 0);
  const bool border = random.below(2) == 0;
  std::vector<std::array<int, 4>> blocks;
  for (std::uint64_t k = random.below(4); k > 0; --k) {
    const int x = static_cast<int>(random.below(40));
    const int y = static_cast<int>(random.below(40));
    blocks.push_back({x, y, x + static_cast<int>(random.below(6)), y + 1});
  }
  for (std::size_t i = 0; i < map.obstacle.size(); ++i) {
    const Cell c = map.grid.cell_at(i);
    bool hit =
        border && (c.ix == 0 || c.iy == 0 || c.ix + 1 == map.grid.nx || c.iy + 1 == map.grid.ny);
    for (const auto& [x0, y0, x1, y1] : blocks) {
      hit = hit || (c.ix >= x0 && c.ix <= x1 && c.iy >= y0 && c.iy <= y1);
    }
    map.obstacle[i] = hit ? 1 : 0;
  }
  return map;
}

FieldOptions options_of(Random& random) {
  FieldOptions options;
  options.alpha = random.uniform(0.1, 2.0);
  options.beta = random.uniform(0.7, 2.5);
  options.metric = static_cast<Metric>(random.below(3));
  options.sigma_cells = random.below(3) == 0 ? 0.0 : random.uniform(0.0, 3.0);
  options.mu_border = random.uniform(0.05, 1.0);
  options.sigma_border = random.below(3) == 0 ? 0.0 : random.uniform(0.0, 2.0);
  options.filter = static_cast<Filter>(random.below(2));
  options.blend = static_cast<Blend>(random.below(2));
  options.axis_capture_rad = random.uniform(0.0, 0.1);
  return options;
}

Vec2 place_on(const Grid& grid, Random& random) {
  return {random.uniform(grid.x0_m, grid.x0_m + grid.width_m()),
          random.uniform(grid.y0_m, grid.y0_m + grid.height_m())};
}

Mission mission_on(const Grid& grid, Random& random) {
  if (random.below(4) == 0) {
    return PathMission{{place_on(grid, random), place_on(grid, random)}, false, 10.0, 0.5};
  }
  GoalMission goal{place_on(grid, random), {}};
  if (random.below(2) == 0) goal.goal_heading_rad = random.uniform(-3.0, 3.0);
  return goal;
}

template <typename Value>
bool same_bits(const std::vector<Value>& a, const std::vector<Value>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), sizeof(Value) * a.size()) == 0;
}

RC_GTEST_PROP(Replan, WithTheOwnMissionGivesThePlanBitForBit, ()) {
  Random random = Random::stream(*rc::gen::inRange(0, 1'000'000), 3);
  const ObstacleMap map = map_of(random);
  const Vehicle vehicle{10.0, map.grid.cell_m * random.uniform(1.05, 4.0)};
  const FieldOptions options = options_of(random);
  const auto made = plan_map(map, vehicle, mission_on(map.grid, random), options);
  RC_PRE(std::holds_alternative<Plan>(made));
  const Plan* plan = &std::get<Plan>(made);
  const FieldOptions read = field_options_of(plan->record, "plan");
  const auto again = replan(*plan, *plan->record.mission, read);
  RC_ASSERT(std::holds_alternative<Plan>(again));
  const Plan& second = std::get<Plan>(again);
  RC_ASSERT(same_bits(second.heading_rad, plan->heading_rad));
  RC_ASSERT(same_bits(second.cost_m, plan->cost_m));
  RC_ASSERT(same_bits(second.region, plan->region));
  RC_ASSERT(json_text(second.record) == json_text(plan->record));
}

RC_GTEST_PROP(Replan, WithAnotherGoalIsThePlanOfTheMapWithThatGoal, ()) {
  Random random = Random::stream(*rc::gen::inRange(0, 1'000'000), 4);
  const ObstacleMap map = map_of(random);
  const Vehicle vehicle{10.0, map.grid.cell_m * random.uniform(1.05, 2.0)};
  FieldOptions options = options_of(random);
  options.alpha = 0.3;
  const auto first = plan_map(map, vehicle, GoalMission{place_on(map.grid, random), {}}, options);
  RC_PRE(std::holds_alternative<Plan>(first));
  const Plan& plan = std::get<Plan>(first);
  const Mission moved = GoalMission{place_on(map.grid, random), {}};
  const auto expected = plan_map(map, vehicle, moved, options);
  const auto found = replan(plan, moved, field_options_of(plan.record, "plan"));
  RC_ASSERT(found.index() == expected.index());
  if (const auto* refusal = std::get_if<MissionRefusal>(&expected)) {
    RC_ASSERT(std::get<MissionRefusal>(found).message == refusal->message);
    return;
  }
  RC_ASSERT(same_bits(std::get<Plan>(found).heading_rad, std::get<Plan>(expected).heading_rad));
  RC_ASSERT(same_bits(std::get<Plan>(found).cost_m, std::get<Plan>(expected).cost_m));
  RC_ASSERT(std::get<Plan>(found).record.mission == moved);
}

std::string refusal(const std::string& options_json) {
  PlanRecord record;
  record.options_json = options_json;
  try {
    static_cast<void>(field_options_of(record, "old.safetensors"));
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Replan, ReadsOptionsStrictly) {
  EXPECT_EQ(refusal(R"({"plan": {"alpha": 1, "metric": "octile"}})"), "accepted");
  for (const char* without : {"", "{}", "[]", R"({"plan": 3})"}) {
    EXPECT_NE(refusal(without).find("names no options"), std::string::npos) << without;
  }
  EXPECT_NE(refusal(R"({"plan": {"gamma": 1}})").find("plan.gamma: is not known"),
            std::string::npos);
  for (const char* wrong : {R"({"plan": {"alpha": -1}})", R"({"plan": {"metric": "none"}})",
                            R"({"plan": {"alpha": {"a": 1}}})", R"({"plan": {"alpha": [null]}})"}) {
    EXPECT_NE(refusal(wrong).find("old.safetensors"), std::string::npos) << wrong;
  }
}

}  // namespace
}  // namespace fairway
