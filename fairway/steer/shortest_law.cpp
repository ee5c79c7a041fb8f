#include "fairway/steer/shortest_law.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "fairway/base/error.hpp"

namespace fairway {
namespace {

/// The rest of a path after `length_m`, from a state near that point.
DubinsPath rest_of(const DubinsPath& path, double length_m, const State& from) {
  DubinsPath rest = path;
  rest.start = from;
  for (double& part_m : rest.part_m) {
    const double gone_m = std::min(part_m, length_m);
    part_m -= gone_m;
    length_m -= gone_m;
  }
  return rest;
}

/// The change of heading over the next `length_m`.
double turn_over(const DubinsPath& path, double length_m) {
  double turn_m = 0.0;
  for (const DubinsPart& part : parts_of(path)) {
    const double part_m = std::min(length_m, part.length_m);
    turn_m += part.turn * part_m;
    length_m -= part_m;
  }
  return turn_m / path.turn_radius_m;
}

/// How much longer a path to the goal may be than one that ends at `end` and still count as the
/// same path, corrected. The factor is a choice: on straight parts 1 would suffice.
double growth_for(const State& end, const State& goal, double turn_radius_m) {
  constexpr double factor = 4.0;
  return factor * (norm(end.position_m - goal.position_m) +
                   turn_radius_m * std::abs(end.heading.turn_to(goal.heading)));
}

/// Along the goal's heading from it, and to its left.
Vec2 in_frame_of(const State& goal, Vec2 position_m) {
  const Vec2 ahead = goal.heading.unit();
  const Vec2 d = position_m - goal.position_m;
  return {dot(ahead, d), cross(ahead, d)};
}

/// A turn to the goal's heading, then straight on until the goal is abeam, if that passes it within
/// the tolerance.
std::optional<DubinsPath> abreast(const State& state, const State& goal,
                                  const PoseTolerance& tolerance, double turn_radius_m) {
  constexpr double share = 0.9;  // of the tolerance: the rest is for disturbances
  const double turn_rad = state.heading.turn_to(goal.heading);
  DubinsPath path{state, turn_radius_m, turn_rad >= 0.0 ? DubinsWord::LSL : DubinsWord::RSR, {}};
  path.part_m[0] = std::abs(turn_rad) * turn_radius_m;
  const Vec2 at = in_frame_of(goal, end_of(path).position_m);
  if (std::abs(at.y) > share * tolerance.place_m || at.x > tolerance.place_m) return std::nullopt;
  path.part_m[1] = std::max(0.0, -at.x);
  return path;
}

/// While the goal is ahead: the shortest path to a pose straight ahead of the goal, the nearest
/// with a path shorter than `loop_m` by a radius or more.
std::optional<DubinsPath> beyond(const State& state, const State& goal,
                                 const PoseTolerance& tolerance, double turn_radius_m,
                                 double loop_m) {
  if (in_frame_of(goal, state.position_m).x >= 0.0) return std::nullopt;
  for (double ahead_m = tolerance.place_m; ahead_m <= turn_radius_m; ahead_m *= 1.5) {
    const State pose{goal.position_m + ahead_m * goal.heading.unit(), goal.heading};
    const DubinsPath path = shortest_path(state, pose, turn_radius_m);
    if (path.length_m() + turn_radius_m < loop_m) return path;
  }
  return std::nullopt;
}

}  // namespace

bool PoseTolerance::holds(const State& state, const State& goal) const {
  return norm2(state.position_m - goal.position_m) <= place_m * place_m &&
         std::abs(state.heading.turn_to(goal.heading)) <= heading_rad;
}

bool PoseTolerance::covers(double step_m, double turn_radius_m) const {
  // Half a step along the way past the goal, plus the error of two joins within a step.
  const double half = 0.5 * step_m / turn_radius_m;
  return place_m > step_m * (0.5 + half) && heading_rad > half;
}

void ShortestLaw::choose(const State& state, const State& goal, double turn_radius_m) {
  const DubinsPath shortest = shortest_path(state, goal, turn_radius_m);
  if (!path_ || path_->turn_radius_m != turn_radius_m) {
    path_ = shortest;
    return;
  }
  DubinsPath chosen = shortest;
  if (shortest.word != path_->word) {
    const auto same_word = path_of_word(path_->word, state, goal, turn_radius_m);
    if (same_word && same_word->length_m() <= shortest.length_m() + options_.tie_m) {
      chosen = *same_word;
    }
  }
  // Longer than the rest of the old path: by the distance at which that misses the goal, times a
  // factor, or by a jump. After a jump the old path is kept while it ends within the tolerance.
  const DubinsPath rest = rest_of(*path_, driven_m_, state);
  const double growth_m = chosen.length_m() - rest.length_m();
  path_ = chosen;
  if (growth_m <= 1e-9 * turn_radius_m) return;
  const State end = end_of(rest);
  if (growth_m <= growth_for(end, goal, turn_radius_m)) return;
  if (options_.tolerance.holds(end, goal)) {
    path_ = rest;
    return;
  }
  // A disturbance or the goal's motion has moved its end: pass the goal as near as possible. It may
  // come within the tolerance on the way, and the jump may disappear again.
  std::optional<DubinsPath> near = abreast(state, goal, options_.tolerance, turn_radius_m);
  if (!near) near = beyond(state, goal, options_.tolerance, turn_radius_m, chosen.length_m());
  if (near) path_ = near;
}

double ShortestLaw::curvature_per_m(const State& state, const State& goal, double turn_radius_m,
                                    double step_m) {
  require(step_m > 0.0 && options_.tolerance.covers(step_m, turn_radius_m),
          "the tolerance is more than step / 2 + step^2 / (2 r), and step / (2 r)");
  choose(state, goal, turn_radius_m);
  driven_m_ = step_m;
  return turn_over(*path_, step_m) / step_m;
}

}  // namespace fairway
