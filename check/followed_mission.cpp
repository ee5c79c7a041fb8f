#include "check/followed_mission.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "check/path_places.hpp"
#include "check/tensors.hpp"

namespace fairway_check {
namespace {

using nlohmann::json;

/// Of a line that cuts no corner by more than 1.5 turning radii.
constexpr double most_cut_radii = 1.5 * (1.0 + 1e-6);
/// So far apart places of the line are looked at, in turning radii.
constexpr double step_radii = 0.25;
const std::string other = "is not the certificate of the mission of the plan ";

std::vector<Point> points_of(const json& pairs) {
  std::vector<Point> points;
  for (const json& pair : pairs)
    points.push_back({pair.at(0).get<double>(), pair.at(1).get<double>()});
  return points;
}

/// Calls body(place) along the line, from its first vertex to its last.
template <typename Body>
void for_places(const std::vector<Point>& vertices, bool closed, double step, const Body& body) {
  body(vertices.front());
  const std::size_t pieces = closed ? vertices.size() : vertices.size() - 1;
  for (std::size_t i = 0; i < pieces; ++i) {
    const Point from = vertices[i];
    const Point by = vertices[(i + 1) % vertices.size()] - from;
    const double count = std::max(1.0, std::ceil(std::hypot(by.x, by.y) / step));
    for (double k = 1.0; k <= count; ++k) body(from + (k / count) * by);
  }
}

bool lies_along(const std::vector<Point>& line, const PathPlaces& path, bool closed,
                double radius) {
  bool near = true;
  for_places(line, closed, step_radii * radius, [&](Point at) {
    near = near && path.nearest(at).distance <= most_cut_radii * radius;
  });
  return near;
}

/// By how much of the path's length one comes forward along the line.
double rounds_along(const std::vector<Point>& line, const PathPlaces& path, bool closed,
                    double radius) {
  double sum = 0.0;
  double before = path.nearest(line.front()).station;
  for_places(line, closed, step_radii * radius, [&](Point at) {
    const double station = path.nearest(at).station;
    const double by = station - before;
    sum += closed ? std::remainder(by, path.length()) : by;
    before = station;
  });
  return sum / path.length();
}

}  // namespace

void require_mission(const FollowClaims& claims, const json& follow, const std::string& plan_path) {
  const json record = read_tensors(plan_path).record;
  const json& mission = record.at("mission");
  require(mission.is_object(), other + plan_path + ": it has no mission");
  const double radius = record.at("vehicle").at("turn_radius_m");
  if (claims.holds) {
    const json& hold = follow.at("hold");
    const bool same = mission.at("kind") == "goal" && mission.value("hold", false) &&
                      mission.at("goal_m") == hold.at("goal_m");
    require(same, other + plan_path + ": holds at another place");
    require(
        !mission.contains("hold_radius_m") || hold.at("radius_m") <= mission.at("hold_radius_m"),
        other + plan_path + ": its disc is wider than asked for");
    return;
  }
  require(mission.at("kind") == "path" && mission.at("closed") == claims.closed,
          other + plan_path + ": follows another kind of path");
  const std::vector<Point> vertices = points_of(mission.at("vertices_m"));
  require(vertices.size() >= 2, other + plan_path + ": it has no path");
  const PathPlaces path(vertices, claims.closed);
  const PathPlaces line(claims.path, claims.closed);
  require(lies_along(claims.path, path, claims.closed, radius) &&
              lies_along(vertices, line, claims.closed, radius),
          other + plan_path + ": path_m is not its path");
  const auto apart = [](Point a, Point b) { return std::hypot(a.x - b.x, a.y - b.y); };
  const double rounds = rounds_along(claims.path, path, claims.closed, radius);
  const bool onwards = claims.closed
                           ? std::abs(rounds - 1.0) < 0.25
                           : apart(claims.path.front(), vertices.front()) <= 1e-6 * radius &&
                                 apart(claims.path.back(), vertices.back()) <= 1e-6 * radius;
  require(onwards, other + plan_path + ": path_m leads along its path another way");
}

}  // namespace fairway_check
