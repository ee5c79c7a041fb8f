// Which mode to fly where none is proved: the one that a simulation likes best. Evidence, no more:
// flights in steps, without bounds of their errors.
//
// No heap, no exceptions. Cost: up to 2048 steps a mode, and a query of every mode in each cell on
// the way: on Berlin_1_256 with eleven modes 0.1 ms on average, 2.4 ms at most (300 states).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "fairway/base/grid.hpp"
#include "fairway/vehicle/bang_bang.hpp"
#include "fairway/verify/ask_modes.hpp"
#include "fairway/verify/flow.hpp"
#include "fairway/verify/proof_view.hpp"
#include "fairway/verify/verdict.hpp"

namespace fairway {

struct ModeTrial {
  bool arrives = false;   ///< at the goal, or where some mode is proved to reach
  double length_m = 0.0;  ///< to there; else until it met an end, or was given up
};

/// The flight of one mode from a state, metres, radians. It is given up after `most_m`, and after
/// some forty circles.
inline ModeTrial try_mode(const ProofView& proof, int mode, double x_m, double y_m,
                          double heading_rad,
                          double most_m = std::numeric_limits<double>::infinity()) {
  constexpr int most_steps = 2048;
  const Flow flow = proof.flow_of(mode);
  const double radius_m = flow.vehicle.turn_radius_m;
  const double step_m = std::min(flow.grid.cell_m / 4.0, radius_m / 8.0);
  ModeTrial trial;
  Cell in{-1, -1};
  for (int k = 0; k < most_steps && trial.length_m <= most_m; ++k, trial.length_m += step_m) {
    const Cell cell = flow.grid.cell_of({x_m, y_m});
    if (!flow.grid.contains(cell)) return trial;
    const CellKind kind = flow.kind[flow.grid.index(cell)];
    if (kind != CellKind::ordinary) {
      trial.arrives = kind == CellKind::target;
      return trial;
    }
    const bool is_new = cell.ix != in.ix || cell.iy != in.iy;
    in = cell;
    // From where it begins nothing is proved.
    if (is_new && k > 0 && ask_all_modes(proof, x_m, y_m, heading_rad).verdict == Verdict::reach) {
      trial.arrives = true;
      return trial;
    }
    const HeadingCommand command =
        bang_bang(flow.grid, flow.vehicle, flow.heading_rad, x_m, y_m, heading_rad);
    const double most_rad = step_m / radius_m;
    double turn_rad = 0.0;
    if (!std::isnan(command.heading_rad)) {
      const double off_rad = std::remainder(command.heading_rad - heading_rad, two_pi);
      turn_rad = std::clamp(off_rad, -most_rad, most_rad);
    }
    x_m += step_m * std::cos(heading_rad + 0.5 * turn_rad);
    y_m += step_m * std::sin(heading_rad + 0.5 * turn_rad);
    heading_rad = std::remainder(heading_rad + turn_rad, two_pi);
  }
  return trial;
}

/// The mode that arrives by the shortest way; where none does, the one that flies on for longest,
/// and of those `mode` rather than others.
inline int liked_mode(const ProofView& proof, int mode, double x_m, double y_m,
                      double heading_rad) {
  int best = mode;
  ModeTrial known = try_mode(proof, mode, x_m, y_m, heading_rad);
  for (int other = 0; other < proof.modes(); ++other) {
    if (other == mode) continue;
    const double most_m = known.arrives ? known.length_m : std::numeric_limits<double>::infinity();
    const ModeTrial trial = try_mode(proof, other, x_m, y_m, heading_rad, most_m);
    const bool is_shorter = trial.length_m < known.length_m;
    const bool is_longer = trial.length_m > known.length_m;
    const bool better = trial.arrives != known.arrives ? trial.arrives
                        : trial.arrives                ? is_shorter
                                                       : is_longer;
    if (!better) continue;
    best = other;
    known = trial;
  }
  return best;
}

}  // namespace fairway
