#include "check/follow_claims.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "check/plan_arrays.hpp"

namespace fairway_check {
namespace {

constexpr double far_m = 1e15;

std::uint64_t rows_of(const TensorFile& file, const char* name, std::size_t dimensions) {
  const auto found = file.tensors.find(name);
  require(found != file.tensors.end() && found->second.shape.size() == dimensions,
          std::string(name) + ": is missing, or has another shape", unreadable);
  return found->second.shape[0];
}

void require_stages(const FollowClaims& f) {
  for (std::size_t k = 0; k < f.stages(); ++k) {
    const bool fits =
        std::abs(f.heading_rad[k]) <= 3.2F &&
        (f.bends(k) ||
         (f.off_rad[k] >= 0.0F && static_cast<double>(f.off_rad[k]) <= most_off_rad)) &&
        f.time_s[k] >= 0.0F && std::isfinite(f.time_s[k]) && std::isfinite(f.station_m[k]);
    require(fits, fmt::format("stage {}: has an invalid direction, time or place", k));
  }
  // With fewer, to and fro could not be told from round.
  require(f.closed && !f.holds ? f.stages() >= 3 : f.stages() == 1 && f.bends(0),
          "stages: expected at least three, without laps one without a direction");
  require(std::all_of(f.stage.begin(), f.stage.end(),
                      [&](std::uint16_t stage) { return stage <= f.stages(); }),
          "leaf_stage: names a stage that does not exist");
}

/// The path is nowhere farther from the goal than one of its vertices is.
void require_disc(const nlohmann::json& hold, const FollowClaims& f) {
  const auto goal = hold.at("goal_m").get<std::vector<double>>();
  require(goal.size() == 2, "hold: goal_m: expected [x, y]");
  double farthest = 0.0;
  for (const Point p : f.path) {
    farthest = std::max(farthest, std::hypot(p.x - goal[0], p.y - goal[1]));
  }
  const float widest = *std::max_element(f.tube_distance_m.begin(), f.tube_distance_m.end());
  require(f.closed && farthest + static_cast<double>(widest) <= hold.at("radius_m").get<double>(),
          "hold: radius_m: the tube is not in the disc");
}

}  // namespace

FollowClaims follow_claims_of(const TensorFile& file, std::uint64_t leaves) {
  const nlohmann::json& record = file.record.at("follow");
  FollowClaims f;
  f.closed = record.at("closed").get<bool>();
  const auto lap = record.at("lap_time_s").get<std::vector<double>>();
  require(lap.size() == 2 && lap[0] >= 0.0 && std::isfinite(lap[1]), "lap_time_s: expected bounds");
  f.lap_least_s = lap[0];
  f.lap_most_s = lap[1];
  const auto path =
      values<double>(file, "path_m", "F64", {rows_of(file, "path_m", 2), std::uint64_t{2}});
  for (std::size_t i = 0; i + 1 < path.size(); i += 2) {
    require(std::abs(path[i]) <= far_m && std::abs(path[i + 1]) <= far_m,
            "path_m: expected finite numbers");
    f.path.push_back({path[i], path[i + 1]});
  }
  require(f.path.size() >= 2, "path_m: expected at least two vertices");
  f.stage = values<std::uint16_t>(file, "leaf_stage", "U16", {leaves});
  const std::vector<std::uint64_t> stages{rows_of(file, "stage_heading_rad", 1)};
  f.heading_rad = values<float>(file, "stage_heading_rad", "F32", stages);
  f.off_rad = values<float>(file, "stage_off_rad", "F32", stages);
  f.time_s = values<float>(file, "stage_time_s", "F32", stages);
  f.station_m = values<float>(file, "stage_station_m", "F32", stages);
  const auto tube =
      values<float>(file, "tube", "F32", {rows_of(file, "tube", 2), std::uint64_t{2}});
  for (std::size_t i = 0; i + 1 < tube.size(); i += 2) {
    f.tube_distance_m.push_back(tube[i]);
    f.tube_off_rad.push_back(tube[i + 1]);
  }
  require(!tube.empty(), "tube: is empty");
  f.holds = record.contains("hold");
  if (f.holds) require_disc(record.at("hold"), f);
  require_stages(f);
  return f;
}

}  // namespace fairway_check
