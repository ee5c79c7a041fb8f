// Paper 3's control law: steer to a pose by pulling the circles of least radius over the goal's.
//
// Conventions: the goal's own frame, turned so that the goal's heading is +y, and lengths in
// turning radii (the paper's r = 1): L' = (-1, 0), R' = (1, 0). theta' is +1 left, -1 right. The
// paper's equations, and how they are read (docs/papers.md, paper 3):
//   Eq. 2        as printed. With it L moves with (1 - r theta') times the velocity: Eq. 12 has the
//                wrong sign, Eq. 14 must turn left to hold D_LL', Eq. 16 right to hold D_RR'.
//   Eq. 11       reversed: alpha_L is the direction from L to L'.
//   Eqs. 14, 16  for pi/2 < |alpha - theta| <= pi.
//   Eqs. 8, 9    have the exponent -1/n, as in Eq. 18.
//   Eqs. 5 to 7  L repels R' when the two circles overlap, as in the text, and 0 <= y_R' - y_L <
//                2 r, which is all that Eq. 7 prints: L is behind R'. R and L' are the mirror
//                image. The wrong pair repels, so the law of that circle of the vehicle is
//                reversed: k_L goes with L and R', k_R with R and L'.
//   Eq. 20       the control repels as long as a repulsion exists ("V_R is selected if only it
//                exists"); the printed vote, which value() charts, attracts once V_A < V_R.
//   Section B3   the repulsion lasts, from the start, until it vanishes for the first time, and
//                then never returns: one bit of memory.
// What the law reaches and how often it is shortest is measured in docs/steering.md.
#pragma once

#include "fairway/vehicle/vehicle.hpp"

namespace fairway {

/// Centres of the circles of least radius to the left and right of a pose (Eq. 2), metres.
struct AccommodationCircles {
  Vec2 left_m;
  Vec2 right_m;
};
[[nodiscard]] AccommodationCircles accommodation_circles(const State& state, double turn_radius_m);

/// [(1/x)^n + (1/y)^n]^(-1/n) (Eq. 8): at most the smaller of two numbers >= 0, and nearly that.
[[nodiscard]] double vote(double x, double y, int n);

/// When two circles of opposite sense repel each other.
enum class Repulsion {
  none,
  overlap,         ///< whenever they overlap
  overlap_behind,  ///< and the vehicle's is behind the goal's: Eq. 7
};

struct ClfOptions {
  int n = 16;  ///< of the vote, >= 1
  Repulsion repulsion = Repulsion::overlap_behind;
};

/// Distances and the Lyapunov function at a state, in turning radii.
struct ClfValue {
  double d_ll = 0.0;          ///< Eq. 3
  double d_rr = 0.0;          ///< Eq. 4
  double d_rl = 0.0;          ///< Eq. 6, 0 when R and L' do not repel
  double d_lr = 0.0;          ///< Eq. 7, 0 when L and R' do not repel
  bool repels_left = false;   ///< k_L
  bool repels_right = false;  ///< k_R
  double v_attract = 0.0;     ///< Eq. 9
  double v_repel = 0.0;       ///< Eqs. 17 and 18; 0 when nothing repels
  double v = 0.0;             ///< Eq. 20
};

class ClfLaw {
 public:
  explicit ClfLaw(const ClfOptions& options = {}) : options_(options) {}

  /// The curvature (1/m, left positive, at most 1/turn_radius_m) to hold for the next `step_m`:
  /// Eqs. 13 to 16. Where a turn or a straight part ends within the step, the mean of its
  /// curvature and the next one's. No heap, about 60 ns.
  [[nodiscard]] double curvature_per_m(const State& state, const State& goal, double turn_radius_m,
                                       double step_m);

  /// The law's quantities at `state`; with the repulsion only while it lasts.
  [[nodiscard]] ClfValue value(const State& state, const State& goal, double turn_radius_m) const;

 private:
  ClfOptions options_;
  bool repulsion_over_ = false;
};

}  // namespace fairway
