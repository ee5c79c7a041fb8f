#include "fairway/steer/clf_law.hpp"

#include <algorithm>
#include <cmath>

#include "fairway/base/error.hpp"
#include "fairway/steer/fast_angle.hpp"

namespace fairway {
namespace {

/// A state in the goal's frame.
struct Relative {
  Vec2 left;   ///< L
  Vec2 right;  ///< R
  Vec2 unit;   ///< (cos theta, sin theta)
};

Relative relative(const State& state, const State& goal, double turn_radius_m) {
  const Vec2 ahead = fast_unit(goal.heading.rad());  // is +y here
  const Vec2 u = fast_unit(state.heading.rad());
  const Vec2 p = (1.0 / turn_radius_m) * (state.position_m - goal.position_m);
  const auto turned = [&](Vec2 v) { return Vec2{cross(v, ahead), dot(v, ahead)}; };
  const Vec2 at = turned(p);
  const Vec2 unit = turned(u);
  return {at + left_of(unit), at - left_of(unit), unit};
}

constexpr Vec2 goal_left{-1.0, 0.0};
constexpr Vec2 goal_right{1.0, 0.0};

/// Whether the vehicle's circle about `own` and the goal's of the other sense about `other` repel.
/// Touching circles, as both pairs are at the goal, must not overlap because of rounding.
bool repels(Vec2 own, Vec2 other, Repulsion repulsion) {
  constexpr double touch = 1e-9;
  if (repulsion == Repulsion::none) return false;
  if (norm2(own - other) >= (2.0 - touch) * (2.0 - touch)) return false;
  return repulsion == Repulsion::overlap || own.y <= 0.0;
}

/// Eqs. 13 and 14 for `side` +1, 15 and 16 for -1: theta' over a step, -1 .. 1.
double attracted(const Relative& s, int side, double step) {
  const Vec2 to = side > 0 ? goal_left - s.left : goal_right - s.right;
  const double distance = norm(to);
  if (distance <= 0.5 * step) {  // on the goal's circle: along it, to the goal's heading
    const double rest = left_turn_to({s.unit.y, side * s.unit.x});
    return side * std::min(1.0, rest / step);
  }
  const double off = signed_angle({dot(s.unit, to), cross(s.unit, to)});  // alpha - theta
  if (std::abs(off) > pi / 2) return side;
  const double turn = std::abs(off);
  if (turn >= step) return off > 0.0 ? 1.0 : -1.0;
  // The turn ends within the step; so may the straight part: then along the goal's circle.
  const double beyond = std::max(0.0, step - turn - distance);
  return std::clamp((off + side * beyond) / step, -1.0, 1.0);
}

struct Repelling {
  bool left;
  bool right;
};

Repelling repelling(const Relative& s, Repulsion repulsion) {
  return {repels(s.left, goal_right, repulsion), repels(s.right, goal_left, repulsion)};
}

}  // namespace

AccommodationCircles accommodation_circles(const State& state, double turn_radius_m) {
  const Vec2 to_left = turn_radius_m * left_of(fast_unit(state.heading.rad()));
  return {state.position_m + to_left, state.position_m - to_left};
}

double vote(double x, double y, int n) {
  require(x >= 0.0 && y >= 0.0 && n >= 1, "the vote is between numbers >= 0, n is at least 1");
  const double low = std::min(x, y);
  const double high = std::max(x, y);
  if (low == 0.0) return 0.0;
  return low * std::pow(1.0 + std::pow(low / high, n), -1.0 / n);
}

double ClfLaw::curvature_per_m(const State& state, const State& goal, double turn_radius_m,
                               double step_m) {
  const Relative s = relative(state, goal, turn_radius_m);
  const double step = step_m / turn_radius_m;
  const bool left_nearer = norm2(goal_left - s.left) <= norm2(goal_right - s.right);
  if (!repulsion_over_) {
    const Repelling now = repelling(s, options_.repulsion);
    if (now.left || now.right) {
      // The nearer of those that repel (Eqs. 18 and 20), with the turn reversed.
      const int side = now.left && (left_nearer || !now.right) ? 1 : -1;
      return (attracted(s, side, step) > 0.0 ? -1.0 : 1.0) / turn_radius_m;
    }
    repulsion_over_ = true;
  }
  return attracted(s, left_nearer ? 1 : -1, step) / turn_radius_m;
}

ClfValue ClfLaw::value(const State& state, const State& goal, double turn_radius_m) const {
  const Relative s = relative(state, goal, turn_radius_m);
  ClfValue of;
  of.d_ll = norm(goal_left - s.left);
  of.d_rr = norm(goal_right - s.right);
  of.v_attract = vote(of.d_ll, of.d_rr, options_.n);
  of.v = of.v_attract;
  if (repulsion_over_) return of;
  const Repelling now = repelling(s, options_.repulsion);
  of.repels_left = now.left;
  of.repels_right = now.right;
  if (now.right) of.d_rl = 2.0 - std::abs(s.right.y);
  if (now.left) of.d_lr = 2.0 - std::abs(s.left.y);
  if (!now.left && !now.right) return of;
  const double nearest = now.left && now.right ? of.v_attract : now.left ? of.d_ll : of.d_rr;
  of.v_repel = std::exp(-nearest);
  of.v = vote(of.v_attract, of.v_repel, options_.n);
  return of;
}

}  // namespace fairway
