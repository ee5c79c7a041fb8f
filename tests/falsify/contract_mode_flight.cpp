#include "tests/falsify/contract_mode_flight.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "tests/falsify/step_crossings.hpp"

namespace fairway {
namespace {

struct Estimate {
  Vec2 place_m;
  double heading_rad;
};

/// As wrong as allowed, half of the time.
Estimate estimate_of(const BehaviourState& s, const EstimateError& error, Random& random) {
  const double towards = random.uniform(-pi, pi);
  const double far = random.below(2) == 0 ? 1.0 : std::sqrt(random.unit());
  const double off =
      random.below(2) == 0 ? random.uniform(-1.0, 1.0) : (random.below(2) == 0 ? 1.0 : -1.0);
  return {s.place + nearly * far * error.place_m * Vec2{std::cos(towards), std::sin(towards)},
          s.heading_rad + nearly * off * error.heading_rad};
}

/// One flight by leaves.
class LeafFlight {
 public:
  LeafFlight(const AttackedModes& modes, const ModeFlightManner& manner, Random& random)
      : modes_(modes), manner_(manner), random_(random) {}

  ContractModeRun fly(const State& start, int mode, double bound_s) {
    begin(BehaviourState::of(start), mode, bound_s);
    while (change_where_it_is()) {
    }
    while (fly_stretch()) {
      while (change_where_it_is()) {
      }
    }
    return std::move(run_);
  }

 private:
  const AttackedMode& mode() const { return modes_.mode(run_.stretches.back().mode); }

  void begin(const BehaviourState& at, int mode, double bound_s) {
    at_ = at;
    at_.held = 0;
    run_.stretches.push_back(
        {mode, {State{at.place, Heading::from_rad(at.heading_rad)}, {}}, bound_s});
  }

  /// What the vehicle does that is on a leaf that is handed over.
  ContractHandOver as_it_must(const BehaviourState& s, double rest_s) const {
    const ContractHandOver exact = mode().hand_over(s.place, s.heading_rad, {0.0, 0.0}, rest_s);
    if (exact.mode == no_mode) return exact;
    const Estimate e = estimate_of(s, modes_.error, random_);
    const ContractHandOver told = mode().hand_over(e.place_m, e.heading_rad, modes_.error, rest_s);
    return told.mode == no_mode ? exact : told;
  }

  ContractHandOver as_it_may(const BehaviourState& s, double rest_s) const {
    ContractHandOver found;
    for (int k = 0; k < 2 && found.mode == no_mode; ++k) {
      const Estimate e = estimate_of(s, modes_.error, random_);
      found = mode().hand_over(e.place_m, e.heading_rad, modes_.error, rest_s);
    }
    return found;
  }

  bool change_where_it_is() {
    if (run_.stretches.back().mode == 0) return false;
    const CellKind kind = mode().flow.kind_at(mode().flow.grid.cell_of(at_.place));
    if (kind != CellKind::ordinary) return false;
    const ContractHandOver to = as_it_must(at_, run_.stretches.back().bound_s);
    if (to.mode == no_mode) return false;
    begin(at_, to.mode, to.time_s);
    return true;
  }

  /// Whether the mode changes at its end.
  bool fly_stretch() {
    static constexpr std::array turns{Adversary::greedy, Adversary::random,   Adversary::guided,
                                      Adversary::greedy, Adversary::circling, Adversary::random};
    ModeStretch& stretch = run_.stretches.back();
    const double bound_m = stretch.bound_s * modes_.least_mps;
    const double limit_m = std::min(bound_m * (1.0 + 1e-8), modes_.usual_most_m);
    const double radius_m = modes_.contract.turn_radius_m.most;
    asks_m_ = radius_m * (0.5 - 3.0 * std::log(1.0 - random_.unit()));
    change_ = {};
    run_.handed_on = false;
    const AttackRun flown = mode().pilot.fly(
        at_, turns[random_.below(turns.size())], random_, limit_m, stretch.flight.steps,
        [&](const BehaviourState& from, const BehaviourChoice& step, double flown_m) {
          return ends_after(from, step, flown_m);
        });
    if (flown.stopped && !run_.handed_on) {
      begin(at_, change_.mode, change_.time_s);
      return true;
    }
    run_.outcome = flown.outcome;
    run_.late = !run_.handed_on && flown.length_m > bound_m * (1.0 + 1e-9);
    return false;
  }

  bool ends_after(const BehaviourState& from, const BehaviourChoice& choice, double flown_m) {
    const ModeStretch& stretch = run_.stretches.back();
    if (stretch.mode > 0) {
      const double begun_m = flown_m - length_of(choice.step, from.heading_rad);
      if (changes_within(from, choice.step, begun_m)) return true;
      const double rest_s = stretch.bound_s - flown_m / modes_.least_mps;
      if (changes_early(from, choice.end, rest_s)) return true;
    }
    if (manner_.whole || (manner_.aims_at_change && run_.changes() == 0)) return false;
    if (flown_m < asks_m_ || choice.end.held != 0) return false;
    asks_m_ = flown_m + 2.0 * modes_.contract.turn_radius_m.most;
    const State now{choice.end.place, Heading::from_rad(choice.end.heading_rad)};
    run_.handed_on = mode().claim(now).verdict == Verdict::reach;
    return run_.handed_on;
  }

  bool changes_within(const BehaviourState& from, const BehaviourStep& step, double begun_m) {
    const AttackedMode& m = mode();
    const Grid& g = m.flow.grid;
    const auto matters = [&](double line, bool is_x, double low, double high) {
      const int to = static_cast<int>(std::floor(high));
      for (int along = static_cast<int>(std::floor(low)); along <= to; ++along) {
        const int at = static_cast<int>(line);
        const PartPlace below = is_x ? PartPlace{at - 1, along} : PartPlace{along, at - 1};
        const PartPlace above = is_x ? PartPlace{at, along} : PartPlace{along, at};
        if (is_flagged(below, is_x ? PartSide::east : PartSide::north)) return true;
        if (is_flagged(above, is_x ? PartSide::west : PartSide::south)) return true;
      }
      return false;
    };
    const auto changes_at = [&](double along) {
      const BehaviourState at = within_step(from, step, along);
      if (m.choices.met(from.place, at.place) != CellKind::ordinary) return true;  // ended before
      const double flown_m = begun_m + (step.turn == 0 ? along : step.radius_m * along);
      change_ = as_it_must(at, run_.stretches.back().bound_s - flown_m / modes_.least_mps);
      if (change_.mode == no_mode) return false;
      end_step_at(step, along, at);
      return true;
    };
    change_ = {};
    return for_crossings(from, step, {g.x0_m, g.y0_m}, m.parts.part_m(), matters, changes_at) &&
           change_.mode != no_mode;
  }

  bool is_flagged(PartPlace part, PartSide side) const {
    const AttackedMode& m = mode();
    return m.parts.kind(part) == PartKind::ordinary &&
           m.hands_over[4 * m.parts.index(part) + static_cast<std::size_t>(side)];
  }

  bool changes_early(const BehaviourState& from, const BehaviourState& end, double rest_s) {
    if (!manner_.eager) return false;
    const AttackedMode& m = mode();
    const Vec2 p = m.in_parts(end.place);
    const PartPlace part{static_cast<int>(std::floor(p.x)), static_cast<int>(std::floor(p.y))};
    if (m.parts.kind(part) != PartKind::ordinary || !m.may_change[m.parts.index(part)])
      return false;
    if (m.choices.met(from.place, end.place) != CellKind::ordinary) return false;
    change_ = as_it_may(end, rest_s);
    if (change_.mode == no_mode) return false;
    at_ = end;
    return true;
  }

  /// The last step of the stretch, which ends within it.
  void end_step_at(const BehaviourStep& step, double along, const BehaviourState& at) {
    std::vector<BehaviourStep>& steps = run_.stretches.back().flight.steps;
    steps.back() = shortened(step, along, at);
    if (along < 1e-12) steps.pop_back();
    at_ = at;
  }

  const AttackedModes& modes_;
  const ModeFlightManner& manner_;
  Random& random_;
  ContractModeRun run_;
  BehaviourState at_;
  ContractHandOver change_;
  double asks_m_ =
      0.0;  ///< of the stretch: until where it is not asked whether the same is claimed
};

}  // namespace

ContractModeRun fly_by_leaves(const AttackedModes& modes, const State& start, int mode,
                              double bound_s, const ModeFlightManner& manner, Random& random) {
  return LeafFlight(modes, manner, random).fly(start, mode, bound_s);
}

bool passes_hand_over(const AttackedModes& modes, const ModeStretch& stretch) {
  if (stretch.mode == 0) return false;
  const AttackedMode& mode = modes.mode(stretch.mode);
  const double near_m = 0.02 * mode.parts.part_m();
  double flown_m = 0.0;
  BehaviourState at = BehaviourState::of(stretch.flight.start);
  for (const BehaviourStep& step : stretch.flight.steps) {
    const double length_m = length_of(step, at.heading_rad);
    const double all = whole_step(at, step);
    const int pieces = 1 + static_cast<int>(length_m / near_m);
    const EstimateError near{near_m, step.turn == 0 ? 0.0 : near_m / step.radius_m};
    for (int k = 0; k <= pieces; ++k) {
      const double share = static_cast<double>(k) / pieces;
      const BehaviourState s = within_step(at, step, share * all);
      const double rest_s = stretch.bound_s - (flown_m + share * length_m) / modes.least_mps;
      if (mode.hand_over(s.place, s.heading_rad, near, rest_s).mode != no_mode) return true;
    }
    at = within_step(at, step, all);
    flown_m += length_m;
  }
  return false;
}

}  // namespace fairway
