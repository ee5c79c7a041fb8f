#include "fairway/field/follow_field.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "fairway/base/heading.hpp"
#include "fairway/base/parallel.hpp"
#include "fairway/field/flyable_path.hpp"
#include "fairway/vehicle/path_locator.hpp"

namespace fairway {
namespace {

// In turning radii.
constexpr double circle_radii = 2.5;
constexpr double radian_radii = 0.5;
constexpr double shadow_radii = 1.0;
constexpr double sight_radii = 1.0;

class Follower {
 public:
  Follower(const Grid& grid, const CompleteMap& complete, const PathMission& path,
           const std::vector<float>& cost_cells, double turn_radius_m)
      : grid_(grid),
        complete_(complete),
        cost_cells_(cost_cells),
        r_(turn_radius_m),
        line_(followed_line(path, turn_radius_m)) {}

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
    const Heading follow =
        frame.beyond_m > 0.0 ? Heading::of(line_.place(frame.station_m) - p) : beside_line(frame);
    return clear_command(p, follow, before, share);
  }

 private:
  /// The rule, of a place that is not beyond an end.
  Heading beside_line(const PathFrame& frame) const {
    const double angle =
        approach_angle_rad(std::abs(frame.offset_m), circle_radii * r_, radian_radii * r_);
    return Heading::from_rad(direction_ahead(frame.station_m).rad() +
                             (frame.offset_m > 0.0 ? -angle : angle));
  }

  /// Mean direction of the line over the next cell's length.
  Heading direction_ahead(double station_m) const {
    const Vec2 chord = line_.place(station_m + grid_.cell_m) - line_.place(station_m);
    return norm2(chord) > 0.0 ? Heading::of(chord)
                              : Heading::of(line_.frame(line_.place(station_m)).tangent);
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
};

}  // namespace

double approach_angle_rad(double distance_m, double circle_m, double radian_m) {
  return std::min(std::acos(1.0 - std::min(1.0, distance_m / circle_m)), distance_m / radian_m);
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
