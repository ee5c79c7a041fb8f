// Reads poses to steer between: the CSV files of `fairway steer --pairs` and `--waypoints`
// (base/number_csv.hpp says what the reader accepts).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fairway/vehicle/vehicle.hpp"

namespace fairway {

struct PosePairs {
  std::vector<State> from;
  std::vector<State> to;  ///< as many
};

/// Columns x0_m,y0_m,h0_rad,x1_m,y1_m,h1_rad, of a file or, for "-", the standard input. Throws
/// InputError{FILE:LINE, ...} for anything but a pair of finite poses, or when two are too far
/// apart, `most_radii` (is_within_radii()); InputError{FILE, ...} when there is none.
[[nodiscard]] PosePairs read_pose_pairs(const std::string& file, double turn_radius_m,
                                        double most_radii);

/// Columns x_m,y_m,heading_rad: poses to reach one by one. From `start` if given, else from the
/// first of them. At least one pair in any case; throws as above.
[[nodiscard]] PosePairs read_waypoints(const std::string& file, const std::optional<State>& start,
                                       double turn_radius_m, double most_radii);

}  // namespace fairway
