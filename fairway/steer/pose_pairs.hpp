// Pairs of poses as text: the CSV of `fairway steer --pairs`.
//
// Columns x0_m,y0_m,h0_rad,x1_m,y1_m,h1_rad. With a header, columns are found by name and others
// are passed over; without one, exactly these six. Blank lines and lines that start with # are
// skipped. A heading is in radians, or degrees with the suffix deg, and is wrapped into (-pi, pi].
// Line ends may be CRLF, and a byte order mark may come first.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "fairway/vehicle/vehicle.hpp"

namespace fairway {

struct PosePairs {
  std::vector<State> from;
  std::vector<State> to;  ///< as many
};

/// Throws InputError{where:LINE, ...} for what is not a pair of finite poses, or when two are too
/// far apart for `turn_radius_m` (dubins_words.hpp); InputError{where, ...} when there is no pair.
[[nodiscard]] PosePairs pose_pairs_of_csv(std::string_view text, const std::string& where,
                                          double turn_radius_m);

}  // namespace fairway
