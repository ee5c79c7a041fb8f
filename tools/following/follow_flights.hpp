// What exact flights along a path mission's path do: join it and stay, or not.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "fairway/plan/plan.hpp"
#include "fairway/simulate/exact_flight.hpp"
#include "fairway/vehicle/path_locator.hpp"

namespace fairway::following {

enum class Fate : std::uint8_t {
  follow,  ///< joins the tube, does not leave it again, and goes along the path
  loose,   ///< touches nothing, but leaves the tube again and again
  collide,
  leave,  ///< leaves the grid
  circle  ///< makes no way along the path
};
inline constexpr std::array<const char*, 5> fate_names{"follow", "loose", "collide", "leave",
                                                       "circle"};

struct FollowedFlight {
  Fate fate = Fate::circle;
  bool begins_forward = false;  ///< within a right angle of the path's direction
  double join_m = 0.0;          ///< flown before the tube is entered for good
  double tube_m = 0.0;          ///< most distance from the path on the last lap, where it is gentle
};

class FollowFlights {
 public:
  /// Of a plan with a path mission. The tube counts where the path is gentle: where it bends no
  /// more sharply than two turning radii from one radius before to three radii behind the place.
  FollowFlights(const Plan& plan, double tube_radii);

  /// Flies `laps` times the path's length; an open path to its end.
  [[nodiscard]] FollowedFlight fly(const State& start, double laps) const;

  double length_m() const { return locator_.length_m(); }  ///< of the path
  /// Whether the tube counts all along from one share of the path's length to another.
  [[nodiscard]] bool is_gentle(double from_share, double to_share) const;

 private:
  void find_gentle();
  std::vector<bool> bends() const;
  bool gentle_at(double station_m) const;

  ExactFlights flights_;
  PathLocator locator_;
  double turn_radius_m_;
  double tube_m_;
  double step_m_;
  std::vector<bool> gentle_;  // [station / step]
};

}  // namespace fairway::following
