// Statistics over many flights, and how closely one flight keeps to a path.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "fairway/simulate/flight.hpp"
#include "fairway/vehicle/mission.hpp"
#include "fairway/vehicle/path_geometry.hpp"

namespace fairway {

/// The number of flights by outcome.
struct OutcomeCounts {
  std::array<std::size_t, outcome_codes> by_outcome{};  ///< [Outcome]

  void add(Outcome outcome) { ++by_outcome[static_cast<std::size_t>(outcome)]; }
  std::size_t of(Outcome outcome) const { return by_outcome[static_cast<std::size_t>(outcome)]; }
  std::size_t total() const;
  /// 0 when there are no flights.
  double share(Outcome outcome) const;
};

[[nodiscard]] OutcomeCounts count_outcomes(std::span<const FlightResult> results);

struct PathSample {
  double time_s = 0.0;
  double length_m = 0.0;  ///< flown so far
  State state;
  PathPoint nearest;
  double heading_error_rad = 0.0;  ///< tangent minus heading, (-pi, pi]
  bool on_path = false;            ///< Eq. 5
};

/// Along a recorded flight, at least every `step_m`, and at both ends of every piece.
[[nodiscard]] std::vector<PathSample> sample_along_path(const Flight& flight,
                                                        const PathMission& path, double speed_mps,
                                                        double step_m);

}  // namespace fairway
