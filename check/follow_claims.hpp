// What a certificate claims in addition when it says that a path is followed (docs/trust.md, "The
// third theorem").
#pragma once

#include <cstdint>
#include <vector>

#include "check/shape.hpp"
#include "check/tensors.hpp"

namespace fairway_check {

/// Less than a right angle: so far off its direction one still moves on in a stage.
inline constexpr double most_off_rad = 1.5;

struct FollowClaims {
  bool closed = true;
  std::vector<Point> path;             ///< metres
  std::vector<std::uint16_t> stage;    ///< [leaves], from 1; 0: not of the core
  std::vector<float> heading_rad;      ///< [stages]: the direction of a stage
  std::vector<float> off_rad;          ///< [stages]: from it, at most; NaN: there is none
  std::vector<float> time_s;           ///< [stages]: in a stage without a direction, at most
  std::vector<float> station_m;        ///< [stages], where it begins
  std::vector<float> tube_distance_m;  ///< [stretches] of the path, equally long
  std::vector<float> tube_off_rad;     ///< [stretches]
  bool holds = false;                  ///< at a goal: all that follow stay in a disc about it
  double lap_least_s = 0.0;
  double lap_most_s = 0.0;  ///< of an open path: to its end

  std::size_t stages() const { return heading_rad.size(); }
  bool bends(std::size_t k) const { return off_rad[k] != off_rad[k]; }
};

/// Throws Defect 65 or 1, or nlohmann::json::exception.
FollowClaims follow_claims_of(const TensorFile& file, std::uint64_t leaves);

}  // namespace fairway_check
