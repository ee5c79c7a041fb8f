#include "tests/falsify/attack_pilot.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "fairway/vehicle/nearest_command.hpp"

namespace fairway {
namespace {

using StepOrder = std::array<StepKind, step_kinds>;

/// First of all this turn (+1 left, -1 right), sharp or wide; then what is most like it.
StepOrder turning_first(int side, bool sharp) {
  using enum StepKind;
  if (side > 0) {
    return sharp ? StepOrder{left_sharp, left_wide, straight, right_wide, right_sharp}
                 : StepOrder{left_wide, left_sharp, straight, right_wide, right_sharp};
  }
  return sharp ? StepOrder{right_sharp, right_wide, straight, left_wide, left_sharp}
               : StepOrder{right_wide, right_sharp, straight, left_wide, left_sharp};
}

StepOrder straight_first(int then, bool sharp) {
  StepOrder order = turning_first(then, sharp);
  for (std::size_t k = 2; k > 0; --k) order[k] = order[k - 1];
  order[0] = StepKind::straight;
  return order;
}

StepOrder any_order(Random& random) {
  StepOrder order = turning_first(1, true);
  for (std::size_t k = step_kinds - 1; k > 0; --k) std::swap(order[k], order[random.below(k + 1)]);
  return order;
}

}  // namespace

NearestObstacle::NearestObstacle(const Flow& flow) : flow_(flow), row_(flow.grid.size()) {
  // Obstacles as the cells that have something.
  std::vector<float> marks(flow.grid.size(), std::numeric_limits<float>::quiet_NaN());
  for (std::size_t i = 0; i < marks.size(); ++i) {
    if (flow.kind[i] == CellKind::obstacle) marks[i] = 1.0F;
  }
  find_nearest_rows(flow.grid, marks.data(), row_.data());
}

Vec2 NearestObstacle::near(Vec2 from) const {
  const Grid& g = flow_.grid;
  const Cell at = g.cell_of(from);
  if (!g.contains(at)) return from;
  const std::size_t obstacle = cell_in_command(g, row_.data(), at);
  return obstacle == g.size() ? from : g.center(g.cell_at(obstacle));
}

/// What an adversary is after for a while.
struct AttackPilot::Mood {
  Adversary adversary = Adversary::random;
  int side = 0;           ///< the turn it likes best; 0: straight
  bool sharp = true;      ///< the least radius
  bool careless = false;  ///< takes any step, each as likely
  bool aims = false;      ///< at `aim`
  Vec2 aim;
};

void AttackPilot::renew(Mood& mood, const BehaviourState& state, Random& random) const {
  mood.sharp = random.below(4) != 0;
  if (mood.adversary == Adversary::circling) return;
  mood.side = static_cast<int>(random.below(3)) - 1;
  mood.careless = random.below(4) == 0;
  mood.aims = false;
  if (mood.adversary != Adversary::greedy) return;
  // The obstacle nearest to the vehicle, or to some place about it.
  Vec2 about = state.place;
  if (random.below(2) == 0) {
    const double far_m = 3.0 * random.unit() * choices_.contract().turn_radius_m.most;
    const double towards = state.heading_rad + random.uniform(-0.5 * pi, 0.5 * pi);
    about = about + far_m * Vec2{std::cos(towards), std::sin(towards)};
  }
  mood.aim = obstacles_.near(about);
  mood.aims = mood.aim.x != about.x || mood.aim.y != about.y;
}

BehaviourChoice AttackPilot::choose(const Mood& mood, const BehaviourState& state,
                                    Random& random) const {
  BehaviourChoiceList list;
  if (mood.adversary == Adversary::guided) {
    choices_.list(state, list);
    int best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < list.size(); ++i) {
      const BehaviourState& end = list[i].end;
      const double cost = guide_.level(end.place, end.heading_rad) + random.unit();
      if (cost >= least) continue;
      least = cost;
      best = i;
    }
    return list[best];
  }
  if (mood.careless) {
    choices_.list_first(state, any_order(random), list);
  } else if (mood.aims) {
    const Vec2 to = mood.aim - state.place;
    const double left = state.unit.x * to.y - state.unit.y * to.x;
    const double ahead = state.unit.x * to.x + state.unit.y * to.y;
    const int side = left > 0.0 ? 1 : -1;
    const bool is_ahead = std::abs(left) < 0.1 * ahead;
    choices_.list_first(state, is_ahead ? straight_first(side, false) : turning_first(side, true),
                        list);
  } else if (mood.side == 0) {
    choices_.list_first(state, straight_first(random.below(2) == 0 ? 1 : -1, mood.sharp), list);
  } else {
    choices_.list_first(state, turning_first(mood.side, mood.sharp), list);
  }
  return list.size() == 1 || random.below(2) == 0 ? list[0] : list[1];
}

/// A few steps more, from where a goal cell may have been touched to where it surely is entered: so
/// that the flight proves that it was. Returns their length.
double AttackPilot::enter_goal(BehaviourState state, std::vector<BehaviourStep>& steps) const {
  BehaviourChoiceList list;
  double length_m = 0.0;
  for (int more = 0; more < 4; ++more) {
    if (choices_.surely_in(state.place) == CellKind::target) break;
    choices_.list(state, list);
    int best = 0;
    for (int i = 1; i < list.size(); ++i) {
      if (choices_.surely_in(list[i].end.place) == CellKind::target) best = i;
    }
    steps.push_back(list[best].step);
    length_m += length_of(list[best].step, state.heading_rad);
    state = list[best].end;
  }
  return length_m;
}

AttackRun AttackPilot::fly(const BehaviourState& start, Adversary adversary, Random& random,
                           double limit_m, std::vector<BehaviourStep>& steps,
                           const Watch& watch) const {
  const Flow& flow = choices_.flow();
  Mood mood;
  mood.adversary = adversary;
  mood.side = random.below(2) == 0 ? 1 : -1;
  AttackRun run;
  run.end = start;
  const CellKind begun = flow.kind_at(flow.grid.cell_of(start.place));
  if (begun != CellKind::ordinary) {
    run.outcome = outcome_of(begun);
    return run;
  }
  const double mood_m = choices_.contract().turn_radius_m.least;
  double renew_m = 0.0;
  while (run.length_m < limit_m) {
    if (run.length_m >= renew_m) {
      renew(mood, run.end, random);
      renew_m = run.length_m + mood_m * 4.0 * random.unit() * random.unit();
    }
    const BehaviourChoice choice = choose(mood, run.end, random);
    run.length_m += length_of(choice.step, run.end.heading_rad);
    steps.push_back(choice.step);
    const BehaviourState from = run.end;
    run.end = choice.end;
    if (watch && watch(from, choice, run.length_m)) {
      run.stopped = true;
      return run;
    }
    const CellKind met = choices_.met(from.place, run.end.place);
    if (met != CellKind::ordinary) {
      run.outcome = outcome_of(met);
      if (run.outcome == Outcome::reach) run.length_m += enter_goal(run.end, steps);
      return run;
    }
  }
  return run;
}

}  // namespace fairway
