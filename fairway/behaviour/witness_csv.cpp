#include "fairway/behaviour/witness_csv.hpp"

#include <fmt/format.h>

#include "fairway/behaviour/explain_behaviour.hpp"

namespace fairway {

std::string witness_csv(const Flow& flow, std::span<const float> commands,
                        const VehicleContract& contract, const BehaviourFlight& flight) {
  const ExplainedBehaviour behaviour = explained(flow, commands, contract, flight);
  std::string text =
      "time_s,x_m,y_m,heading_rad,curvature_per_m,radius_m,command_rad,command_x_m,command_y_m\n";
  const auto add_state = [&](double time_s, const State& s) {
    text += fmt::format("{},{},{},{}", time_s, s.position_m.x, s.position_m.y, s.heading.rad());
  };
  for (const ExplainedStep& step : behaviour.steps) {
    add_state(step.time_s, step.start);
    text +=
        step.turn == 0 ? ",0," : fmt::format(",{},{}", step.turn / step.radius_m, step.radius_m);
    text += fmt::format(",{},{},{}\n", step.command_rad, step.command_m.x, step.command_m.y);
  }
  add_state(behaviour.time_s, behaviour.end);
  return text + ",,,,,\n";
}

}  // namespace fairway
