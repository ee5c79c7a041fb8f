// Flights of the vehicle's own loop.
#include <algorithm>
#include <cmath>
#include <utility>

#include "tests/falsify/contract_mode_flight.hpp"
#include "tests/falsify/step_crossings.hpp"

namespace fairway {
namespace {

/// One flight of a ContractPilot.
class LoopFlight {
 public:
  LoopFlight(const AttackedModes& modes, const State& start, Random& random)
      : modes_(modes),
        contract_(modes.contract),
        random_(random),
        pilot_(*modes.pilot),
        at_(BehaviourState::of(start)) {
    step_m_ = std::min({0.2 * modes.error.place_m,
                        0.2 * modes.error.heading_rad * contract_.turn_radius_m.least,
                        0.1 * modes.mode(0).parts.part_m()});
  }

  ContractModeRun fly() {
    if (!(step_m_ > 0.0) || contract_.look_ahead_m > 0.0) return {};
    for (int k = 0; !run_.late; ++k) {
      if (k % 40 == 0) renew();
      const Vec2 told = at_.place + error_;
      const double told_rad = Heading::from_rad(at_.heading_rad + error_rad_).rad();
      const double clock_s = flown_m_ / modes_.least_mps;
      const auto now = pilot_.steer(clock_s, told.x, told.y, told_rad);
      if (k == 0 && now.answer.verdict != Verdict::reach) return {};
      if (k == 0 || now.answer.mode != run_.stretches.back().mode) {
        begun_m_ = flown_m_;
        run_.stretches.push_back({now.answer.mode,
                                  {State{at_.place, Heading::from_rad(at_.heading_rad)}, {}},
                                  now.answer.time_bound_s});
      }
      if (obeys(std::remainder(now.course_rad - told_rad, two_pi), told)) return std::move(run_);
      const double bound_m = run_.stretches.back().bound_s * modes_.least_mps;
      run_.late = flown_m_ - begun_m_ > bound_m * (1.0 + 1e-9);
    }
    return std::move(run_);
  }

 private:
  void renew() {
    const double towards = random_.uniform(-pi, pi);
    const double far = random_.below(3) == 0 ? random_.unit() : 1.0;
    error_ =
        far * (modes_.error.place_m - 1.1 * step_m_) * Vec2{std::cos(towards), std::sin(towards)};
    const double off =
        random_.below(2) == 0 ? random_.uniform(-1.0, 1.0) : (random_.below(2) == 0 ? 1.0 : -1.0);
    error_rad_ = off * (modes_.error.heading_rad - 1.1 * step_m_ / contract_.turn_radius_m.least);
    radius_m_ = random_.below(2) == 0
                    ? contract_.turn_radius_m.least
                    : random_.uniform(contract_.turn_radius_m.least, contract_.turn_radius_m.most);
  }

  /// Turns to the course, then flies straight on; whether the flight ends meanwhile.
  bool obeys(double turn_rad, Vec2 told) {
    const Grid& g = modes_.mode(0).flow.grid;
    const Cell in = g.cell_of(told);
    const std::size_t cell =
        g.index({std::clamp(in.ix, 0, g.nx - 1), std::clamp(in.iy, 0, g.ny - 1)});
    const double angle = std::min(std::abs(turn_rad) - 1e-9, step_m_ / radius_m_);
    double straight_m = step_m_;
    if (angle > 1e-9) {
      const int side = turn_rad > 0.0 ? 1 : -1;
      BehaviourStep step{side, radius_m_, 0.0, 0.0, cell, -error_rad_};
      step.heading_rad = Heading::from_rad(at_.heading_rad + side * angle).rad();
      if (add(step, angle)) return true;
      straight_m -= radius_m_ * angle;
    }
    if (straight_m < 1e-9) return false;
    return add({0, 0.0, straight_m, at_.heading_rad, cell, 0.0}, straight_m);
  }

  bool add(const BehaviourStep& step, double along) {
    const BehaviourState from = at_;
    at_ = within_step(from, step, along);
    flown_m_ += length_of(step, from.heading_rad);
    run_.stretches.back().flight.steps.push_back(step);
    const CellKind met = modes_.mode(0).choices.met(from.place, at_.place);
    if (met == CellKind::ordinary) return false;
    run_.outcome = outcome_of(met);
    return true;
  }

  const AttackedModes& modes_;
  const VehicleContract& contract_;
  Random& random_;
  runtime::ContractPilot pilot_;
  BehaviourState at_;
  ContractModeRun run_;
  double step_m_ = 0.0;
  double flown_m_ = 0.0;
  double begun_m_ = 0.0;
  Vec2 error_;
  double error_rad_ = 0.0;
  double radius_m_ = 0.0;
};

}  // namespace

ContractModeRun fly_by_loop(const AttackedModes& modes, const State& start, Random& random) {
  return LoopFlight(modes, start, random).fly();
}

}  // namespace fairway
