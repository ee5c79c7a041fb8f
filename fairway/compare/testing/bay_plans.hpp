// Plans of a small bay with a hook in it, for tests of comparisons.
#pragma once

#include <string>
#include <utility>
#include <variant>

#include "fairway/base/error.hpp"
#include "fairway/compare/compared_plan.hpp"
#include "fairway/run/plan_map.hpp"
#include "fairway/run/verification.hpp"

namespace fairway::testing {

/// 480 by 320 m, walled in, in cells of `cell_m`: 8, or half or twice that.
inline ObstacleMap bay_map(double cell_m = 8.0) {
  ObstacleMap map;
  const int nx = static_cast<int>(480.0 / cell_m);
  const int ny = static_cast<int>(320.0 / cell_m);
  map.grid = {nx, ny, 0.0, 0.0, cell_m};
  map.obstacle.assign(map.grid.size(), 0);
  const auto block = [&](double x0, double y0, double x1, double y1) {
    for (std::size_t i = 0; i < map.grid.size(); ++i) {
      const Vec2 p = map.grid.center(map.grid.cell_at(i));
      if (p.x > x0 && p.x < x1 && p.y > y0 && p.y < y1) map.obstacle[i] = 1;
    }
  };
  block(0.0, 0.0, 480.0, 16.0);
  block(0.0, 304.0, 480.0, 320.0);
  block(0.0, 0.0, 16.0, 320.0);
  block(464.0, 0.0, 480.0, 320.0);
  block(240.0, 136.0, 277.0, 304.0);
  block(160.0, 136.0, 277.0, 168.0);
  map.inputs = std::vector<InputFile>{{"bay.pgm", "abc"}};
  return map;
}

inline ComparedPlan bay_plan(const std::string& name, double alpha, double cell_m = 8.0,
                             Mission mission = GoalMission{{380.0, 220.0}, {}}) {
  FieldOptions options;
  options.alpha = alpha;
  auto made = plan_map(bay_map(cell_m), {10.0, 20.0}, mission, options);
  if (const auto* refusal = std::get_if<MissionRefusal>(&made)) {
    throw PreconditionViolation(refusal->message);
  }
  ComparedPlan plan;
  plan.name = name;
  plan.from = name + ".safetensors";
  plan.plan = std::move(std::get<Plan>(made));
  return plan;
}

/// The same, proved.
inline ComparedPlan proved_bay_plan(const std::string& name, double alpha, double cell_m = 8.0) {
  ComparedPlan plan = bay_plan(name, alpha, cell_m);
  CertifyOptions options;
  options.undecided_max = 0.01;
  plan.certificate = verify_plan(plan.plan, name, {}, options).certificate;
  return plan;
}

}  // namespace fairway::testing
