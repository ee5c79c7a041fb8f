#include "fairway/behaviour/behaviour_flight.hpp"

namespace fairway {

std::vector<FlightSegment> segments_of(const BehaviourFlight& flight, double speed_mps) {
  std::vector<FlightSegment> pieces;
  State state = flight.start;
  double time_s = 0.0;
  for (const BehaviourStep& step : flight.steps) {
    const double from_rad = state.heading.rad();
    const double length_m = length_of(step, from_rad);
    const double curvature = step.turn == 0 ? 0.0 : step.turn / step.radius_m;
    if (pieces.empty() || pieces.back().curvature_per_m != curvature) {
      pieces.push_back({state, time_s, 0.0, curvature});
    }
    pieces.back().length_m += length_m;
    state = {state.position_m + move_of(step, from_rad), Heading::from_rad(step.heading_rad)};
    time_s += length_m / speed_mps;
  }
  return pieces;
}

}  // namespace fairway
