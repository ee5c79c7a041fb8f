#include "fairway/ceiling/standing_claims.hpp"

#include <algorithm>
#include <cmath>

namespace fairway {
namespace {

constexpr int places_per_step = 32;  // even: one is the node, one half a step on
// Distances are rounded to the nearest unit.
constexpr int rounding = 1;

FlownBy place_of(const BallLattice& l, const SignedDistance& d, int k, double t) {
  FlownBy f;
  f.time = t;
  const double heading = (k + 0.5) * l.bin_rad;
  // A heading in the bin differs from its middle by half a bin, and after t by as much as t more.
  const double astray = std::abs(t) * 0.5 * l.bin_rad + 0.5 * t * t;
  const double x = t * std::cos(heading) / d.spacing;
  const double y = t * std::sin(heading) / d.spacing;
  for (int corner = 0; corner < 4; ++corner) {
    f.columns[corner] = static_cast<int>(std::floor(x)) + corner % 2;
    f.rows[corner] = static_cast<int>(std::floor(y)) + corner / 2;
    const double missed = std::hypot(x - f.columns[corner], y - f.rows[corner]) * d.spacing;
    f.loses[corner] =
        static_cast<int>(std::ceil((missed + astray + 1e-9) * units_per_turn_radius)) + rounding;
  }
  return f;
}

/// How far all flights through a node are at least on one side of a set's border: `sign` 1 for
/// outside, -1 for inside. Negative: unknown.
int kept(const SignedDistance& d, const Radius* node, const FlownBy& f, int sign) {
  int most = -widest_claim;
  for (int corner = 0; corner < 4; ++corner) {
    const int there = node[f.rows[corner] * d.stride() + f.columns[corner]];
    most = std::max(most, sign * there - f.loses[corner]);
  }
  return most;
}

Radius claim(int radius) { return static_cast<Radius>(std::clamp(radius, 0, widest_claim)); }

}  // namespace

StandingClaims::StandingClaims(const BallLattice& lattice, const SignedDistance& obstacles,
                               const SignedDistance& goal)
    : l_(lattice), obstacles_(obstacles), goal_(goal) {
  const double piece = l_.step / places_per_step;
  between_ = static_cast<int>(std::ceil(0.5 * piece * units_per_turn_radius)) + rounding;
  flown_.resize(static_cast<std::size_t>(l_.headings));
  for (int k = 0; k < l_.headings; ++k) {
    for (int i = -places_per_step / 2; i <= places_per_step; ++i) {
      flown_[static_cast<std::size_t>(k)].push_back(place_of(l_, obstacles_, k, i * piece));
    }
  }
}

StandingClaims::Lost StandingClaims::lost(int k, int y, int x) const {
  Lost found;
  const int i = obstacles_.of_node(x);
  const int j = obstacles_.of_node(y);
  const Radius* obstacle = obstacles_.at(i, j);
  const Radius* goal = goal_.at(i, j);
  const auto& flown = flown_[static_cast<std::size_t>(k)];
  const int step = static_cast<int>(std::ceil(l_.step * units_per_turn_radius));
  int no_goal = *goal - step - rounding;
  if (no_goal < widest_claim && no_goal > -2 * step) {
    no_goal = widest_claim;
    for (const FlownBy& f : flown) {
      if (f.time >= 0.0) no_goal = std::min(no_goal, kept(goal_, goal, f, 1) - between_);
    }
  }
  found.no_goal = claim(no_goal);
  found.always = claim(-*obstacle - rounding);
  if (*obstacle < step / 2) {
    int ahead = 0;
    int behind = 0;
    for (const FlownBy& f : flown) {
      if (f.time > 0.5 * l_.step + 1e-9) break;
      int& best = f.time > 0.0 ? ahead : behind;
      best = std::max(best, kept(obstacles_, obstacle, f, -1));
    }
    found.ahead = claim(std::min<int>(found.no_goal, ahead));
    found.behind = claim(behind);
  }
  return found;
}

StandingClaims::Inside StandingClaims::inside(int k, int y, int x) const {
  Inside found;
  const int i = obstacles_.of_node(x);
  const int j = obstacles_.of_node(y);
  const Radius* obstacle = obstacles_.at(i, j);
  found.goal = claim(-*goal_.at(i, j) - rounding);
  if (*obstacle <= 0) return found;
  const int half_step = static_cast<int>(std::ceil(0.5 * l_.step * units_per_turn_radius));
  int ahead = *obstacle - half_step - rounding;
  int around = ahead;
  // Wide claims need not be sharp; sharp ones stay below them, so that more obstacles never mean
  // more.
  constexpr int wide = units_per_turn_radius * 3 / 4;
  if (ahead < wide) {
    ahead = around = wide;
    for (const FlownBy& f : flown_[static_cast<std::size_t>(k)]) {
      if (f.time > 0.5 * l_.step + 1e-9) break;
      const int here = kept(obstacles_, obstacle, f, 1) - between_;
      around = std::min(around, here);
      if (f.time >= 0.0) ahead = std::min(ahead, here);
    }
  }
  found.ahead = claim(ahead);
  found.around = claim(around);
  return found;
}

}  // namespace fairway
