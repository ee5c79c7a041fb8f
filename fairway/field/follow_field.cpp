#include "fairway/field/follow_field.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include "fairway/base/heading.hpp"
#include "fairway/base/parallel.hpp"
#include "fairway/field/distance_transform.hpp"
#include "fairway/field/flyable_path.hpp"
#include "fairway/vehicle/path_locator.hpp"

namespace fairway {
namespace {

// In turning radii.
constexpr double circle_radii = 3.0;
constexpr double wall_radii = 1.1;    // nearer to a wall the command points away from it
constexpr double beyond_radii = 0.4;  // the line is overshot by as much as leaves this to a wall
constexpr double least_overshoot_radii = 0.5;
constexpr double most_overshoot_radii = 0.9;
constexpr double least_band_radii = 0.15;
constexpr double shadow_radii = 1.0;
constexpr double sight_radii = 1.0;

constexpr double steepest_rad = 88.0 * pi / 180.0;
constexpr double infinity = std::numeric_limits<double>::infinity();

class Follower {
 public:
  Follower(const Grid& grid, const CompleteMap& complete, const PathMission& path,
           const std::vector<float>& cost_cells, double turn_radius_m)
      : grid_(grid),
        complete_(complete),
        cost_cells_(cost_cells),
        r_(turn_radius_m),
        line_(flyable_path(path, turn_radius_m)),
        nearest_obstacle_(grid.size()) {
    std::vector<std::uint8_t> obstacle(grid.size());
    for (std::size_t i = 0; i < obstacle.size(); ++i) {
      obstacle[i] = complete.region[i] == Region::obstacle ? 1 : 0;
    }
    distance_transform(obstacle, grid.nx, grid.ny, {{}, nearest_obstacle_});
  }

  /// The command at cell i in place of `before`; none where that stays.
  std::optional<Heading> command(std::size_t i, Heading before) const {
    const double circle_m = circle_radii * r_;
    const double cost_m = static_cast<double>(cost_cells_[i]) * grid_.cell_m;
    // Nothing near the line is so far by way of free cells, unless in an obstacle's shadow.
    if (!(cost_m < 2.0 * circle_m)) return {};
    const Vec2 p = grid_.center(grid_.cell_at(i));
    const PathFrame frame = line_.frame(p);
    const double distance_m = std::abs(frame.offset_m);
    if (!(distance_m < circle_m)) return {};
    const double detour_m = cost_m - distance_m - grid_.cell_m;
    const double share = std::clamp(1.0 - detour_m / (shadow_radii * r_), 0.0, 1.0);
    if (share == 0.0) return {};
    const Heading follow = frame.beyond_m > 0.0 ? Heading::of(line_.place(frame.station_m) - p)
                                                : beside_line(i, p, frame);
    return clear_command(p, follow, before, share);
  }

 private:
  /// The rule, of a place that is not beyond an end.
  Heading beside_line(std::size_t i, Vec2 p, const PathFrame& frame) const {
    const double distance_m = std::abs(frame.offset_m);
    const Heading along = direction_ahead(frame.station_m);
    const double flat_m =
        0.5 * grid_.cell_m * (std::abs(frame.tangent.x) + std::abs(frame.tangent.y));
    const double wall_m = wall_beside_m(i, p, frame);
    const double band_m = std::max({flat_m, least_band_radii * r_, wall_m - wall_radii * r_});
    const double overshoot_m = std::clamp(wall_m - beyond_radii * r_, least_overshoot_radii * r_,
                                          most_overshoot_radii * r_);
    const Approach approach{circle_radii * r_, flat_m, band_m, r_, overshoot_m};
    const double angle = approach_angle_rad(distance_m, approach);
    return Heading::from_rad(along.rad() + (frame.offset_m > 0.0 ? -angle : angle));
  }

  /// Mean direction of the line over the next cell's length.
  Heading direction_ahead(double station_m) const {
    const Vec2 chord = line_.place(station_m + grid_.cell_m) - line_.place(station_m);
    return norm2(chord) > 0.0 ? Heading::of(chord)
                              : Heading::of(line_.frame(line_.place(station_m)).tangent);
  }

  /// How far from the line a wall on the same side is; +inf: none.
  double wall_beside_m(std::size_t i, Vec2 p, const PathFrame& frame) const {
    if (nearest_obstacle_[i] == no_feature) return infinity;
    const Vec2 way = grid_.center(grid_.cell_at(nearest_obstacle_[i])) - p;
    const double outward = (frame.offset_m > 0.0 ? 1.0 : -1.0) * cross(frame.tangent, way);
    if (outward <= 0.0) return infinity;
    return std::abs(frame.offset_m) + norm(way) - 0.5 * grid_.cell_m;
  }

  /// As far as the sight reaches, or to the first obstacle.
  double clear_m(Vec2 p, Heading heading) const {
    const Vec2 u = heading.unit();
    const double step_m = 0.25 * grid_.cell_m;
    const double far_m = sight_radii * r_;
    for (double along_m = step_m; along_m < far_m; along_m += step_m) {
      const Cell cell = grid_.cell_of(p + along_m * u);
      if (!grid_.contains(cell)) return far_m;
      if (complete_.region[grid_.index(cell)] == Region::obstacle) return along_m;
    }
    return far_m;
  }

  /// `follow`, turned to `before` by as much as the share asks and obstacles demand.
  Heading clear_command(Vec2 p, Heading follow, Heading before, double share) const {
    const double turn = follow.turn_to(before);
    const double old_clear_m = clear_m(p, before);
    for (; share > 0.0; share -= 0.125) {
      const Heading mixed = Heading::from_rad(follow.rad() + (1.0 - share) * turn);
      if (clear_m(p, mixed) >= old_clear_m) return mixed;
    }
    return before;
  }

  const Grid& grid_;
  const CompleteMap& complete_;
  const std::vector<float>& cost_cells_;
  double r_;
  PathLocator line_;
  std::vector<std::uint32_t> nearest_obstacle_;
};

}  // namespace

double approach_angle_rad(double distance_m, const Approach& approach) {
  const double on_circle = std::max(0.0, distance_m - approach.flat_m) / approach.circle_m;
  const double angle = std::acos(1.0 - std::min(1.0, on_circle));
  if (distance_m <= approach.band_m) return angle;
  const double r = approach.turn_radius_m;
  const double beside_wall =
      std::acos(std::max(0.0, 1.0 - (distance_m + approach.overshoot_m) / r));
  return std::max(angle, std::min(steepest_rad, beside_wall));
}

void follow_field(const Grid& grid, const CompleteMap& complete, const PathMission& path,
                  const std::vector<float>& cost_cells, const Vehicle& vehicle,
                  VectorField& field) {
  const Follower follower(grid, complete, path, cost_cells, vehicle.turn_radius_m);
  for_ranges(grid.size(), 1 << 10, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const Vec2 before{field.x[i], field.y[i]};
      if (complete.region[i] == Region::obstacle || before == Vec2{}) continue;
      const std::optional<Heading> command = follower.command(i, Heading::of(before));
      if (!command) continue;
      field.x[i] = static_cast<float>(command->unit().x);
      field.y[i] = static_cast<float>(command->unit().y);
    }
  });
}

}  // namespace fairway
