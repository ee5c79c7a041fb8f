#include "fairway/steer/shortest_law.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace fairway {
namespace {

/// What is left of a path after `length_m`, from a state that is about there.
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
  for (int i = 0; i < 3; ++i) {
    const double part_m = std::min(length_m, path.part_m[static_cast<std::size_t>(i)]);
    turn_m += turn_of(path.word, i) * part_m;
    length_m -= part_m;
  }
  return turn_m / path.turn_radius_m;
}

}  // namespace

bool PoseTolerance::holds(const State& state, const State& goal) const {
  return norm2(state.position_m - goal.position_m) <= place_m * place_m &&
         std::abs(state.heading.turn_to(goal.heading)) <= heading_rad;
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
  // Longer by more than a tie: behind a jump. What is left of the old path may still do.
  const DubinsPath rest = rest_of(*path_, driven_m_, state);
  const bool jump = chosen.length_m() > rest.length_m() + options_.tie_m;
  path_ = jump && options_.tolerance.holds(end_of(rest), goal) ? rest : chosen;
}

double ShortestLaw::curvature_per_m(const State& state, const State& goal, double turn_radius_m,
                                    double step_m) {
  choose(state, goal, turn_radius_m);
  driven_m_ = step_m;
  return turn_over(*path_, step_m) / step_m;
}

}  // namespace fairway
