// Both steering laws with moving goals and disturbances: how many flights arrive, how far they
// drive. Paper 3 claims that its law handles both, but measures neither.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace fairway::reproduce {

/// The law shortest, then the paper's.
inline constexpr std::array<const char*, 2> law_names{"shortest", "clf"};

/// Radius 1, steps of 0.01, starts and goals in a square of side 8, given up after 120.
struct RobustnessRow {
  double tolerance = 0.0;  ///< in place (radii) and in heading (radians)
  double noise = 0.0;      ///< standard deviation after every step: x, y (radii), heading (radians)
  double goal_speed = 0.0;  ///< of the vehicle's, along the goal's heading
  int starts = 0;
  std::array<int, 2> caught{};  ///< by law
  std::array<double, 2> median_driven{};
  std::array<double, 2> driven_by_95_percent{};  ///< or less
};

/// Tolerances 0.02 and 0.05, noise 0, 5e-4 and 2e-3, speeds 0, 1/4 and 1/2: 18 rows. Both laws have
/// the same starts, goals and noise.
[[nodiscard]] std::vector<RobustnessRow> steering_robustness(int starts);

/// In Markdown.
[[nodiscard]] std::string table_of(const std::vector<RobustnessRow>& rows);

}  // namespace fairway::reproduce
