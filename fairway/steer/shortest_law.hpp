// A feedback law that takes the shortest path to a pose: at every state the first control of the
// shortest path from there, with a latch where the choice would otherwise flip.
//
// The length of a shortest path V(state) falls by exactly the distance driven along it. Three
// things prevent that under plain feedback, and each has its remedy here:
//   Ties. Where two words are equally long (a goal straight behind) noise would flip the choice
//     back and forth. The chosen word is kept while its path from the current state is at most
//     `tie` longer than the shortest.
//   Jumps. V jumps by a whole loop where a last turn would have to be tighter than the least
//     radius: every state on a last arc is such a place, and the smallest error puts the vehicle on
//     the wrong side. A path longer than the rest of the one followed, by more than the distance at
//     which that one misses the goal can explain, is not taken while that one ends within the
//     tolerance. When it no longer does (noise, a moving goal), the vehicle still does not turn
//     away for a loop while the goal is ahead: it turns to the goal's heading where that passes the
//     goal within the tolerance, and else drives to a pose straight ahead of the goal, up to a
//     radius, that can be reached without a loop. As soon as there is a path to the goal itself
//     without the jump, it is taken again.
//   Sampling. A control holds for a step. Where a part ends within the step the mean curvature is
//     held, so that the heading after the step is the path's; the position errs by at most
//     step^2 / (4 r) for each join, and the goal is passed at most half a step away: by contract
//     the tolerance must be more than step / 2 + step^2 / (2 r) in position and step / (2 r) in
//     heading.
// Properties that always hold, with W the length of the rest of the path followed:
//   1. While that path ends within the tolerance of the goal, W falls by the step in every step,
//      less at most four times the distance at which it misses the goal (position, and heading
//      times r). Undisturbed that is at most 2 step^2 / r, since a path has two joins.
//   2. The path followed ends within `tolerance` of the goal, or is a path to the goal itself; or,
//      after a disturbance that made the length jump, passes the goal, which is ahead.
// docs/steering.md argues the descent, with noise and with a moving goal.
#pragma once

#include <limits>
#include <optional>

#include "fairway/steer/dubins_words.hpp"

namespace fairway {

struct PoseTolerance {
  double place_m = 0.0;
  double heading_rad = 0.0;
  [[nodiscard]] bool holds(const State& state, const State& goal) const;
  /// Whether it is wide enough for a control held over `step_m` not to miss it.
  [[nodiscard]] bool covers(double step_m, double turn_radius_m) const;
};

struct ShortestLawOptions {
  PoseTolerance tolerance;
  double tie_m = 0.0;  ///< >= 0
};

class ShortestLaw {
 public:
  explicit ShortestLaw(const ShortestLawOptions& options) : options_(options) {}

  /// The curvature (1/m, left positive, at most 1/turn_radius_m) to hold for the next `step_m`. The
  /// goal may change every time. No heap. Throws PreconditionViolation unless the step is
  /// positive, the tolerance covers it, and can_steer().
  [[nodiscard]] double curvature_per_m(const State& state, const State& goal, double turn_radius_m,
                                       double step_m);

  /// The path followed, as of the last call; its start is the state then.
  const std::optional<DubinsPath>& path() const { return path_; }

 private:
  void choose(const State& state, const State& goal, double turn_radius_m);

  ShortestLawOptions options_;
  std::optional<DubinsPath> path_;
  double driven_m_ = 0.0;  ///< along path_ by the step last commanded
};

}  // namespace fairway
