#include "fairway/behaviour/behaviour_pilot.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fairway/vehicle/nearest_command.hpp"

namespace fairway {

/// What an adversary is after for a while.
struct BehaviourPilot::Mood {
  Adversary adversary = Adversary::random;
  int side = 0;           ///< the turn it likes best; 0: straight
  bool sharp = true;      ///< the smallest radius
  bool careless = false;  ///< takes any choice, each as likely
  bool aims = false;      ///< at `aim`
  Vec2 aim;
};

BehaviourPilot::BehaviourPilot(const BehaviourChoices& choices, const FailureGuide* guide)
    : choices_(choices), guide_(guide) {
  // Obstacles as the cells that have something.
  const Flow& flow = choices.flow();
  std::vector<float> marks(flow.grid.size(), std::numeric_limits<float>::quiet_NaN());
  for (std::size_t i = 0; i < marks.size(); ++i) {
    if (flow.kind[i] == CellKind::obstacle) marks[i] = 1.0F;
  }
  obstacle_row_.resize(marks.size());
  find_nearest_rows(flow.grid, marks.data(), obstacle_row_.data());
}

double BehaviourPilot::default_limit_m() const {
  const Grid& g = choices_.flow().grid;
  return 20.0 * (g.width_m() + g.height_m()) +
         20.0 * two_pi * choices_.contract().turn_radius_m.most;
}

void BehaviourPilot::renew(Mood& mood, const BehaviourState& state, Random& random) const {
  mood.sharp = random.below(4) != 0;
  if (mood.adversary == Adversary::circling) return;
  mood.side = static_cast<int>(random.below(3)) - 1;
  mood.careless = random.below(4) == 0;
  mood.aims = false;
  if (mood.adversary != Adversary::greedy) return;
  // The obstacle nearest to the vehicle, or to some place about it.
  const Grid& g = choices_.flow().grid;
  const double far_m =
      random.below(2) == 0 ? 0.0 : 3.0 * random.unit() * choices_.contract().turn_radius_m.most;
  const double towards = state.heading_rad + random.uniform(-0.5 * pi, 0.5 * pi);
  const Cell at = g.cell_of(state.place + far_m * Vec2{std::cos(towards), std::sin(towards)});
  if (!g.contains(at)) return;
  const std::size_t obstacle = cell_in_command(g, obstacle_row_.data(), at);
  if (obstacle == g.size()) return;
  mood.aims = true;
  mood.aim = g.center(g.cell_at(obstacle));
}

int BehaviourPilot::pick(const Mood& mood, const BehaviourChoiceList& list, Random& random) const {
  const auto any = [&] {
    return static_cast<int>(random.below(static_cast<std::uint64_t>(list.size())));
  };
  if (list.size() == 1) return 0;
  const bool guided = mood.adversary == Adversary::guided && guide_ != nullptr;
  if (!guided && mood.careless) return any();
  const double radius_m = choices_.contract().turn_radius_m.least;
  int best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < list.size(); ++i) {
    const BehaviourChoice& choice = list[i];
    double cost = 1e-3 * random.unit();
    if (guided) {
      cost = guide_->level(choice.end.place, choice.end.heading_rad) + random.unit();
    } else if (mood.aims) {
      cost = norm(choice.end.place + 0.5 * radius_m * choice.end.unit - mood.aim);
    } else {
      const bool sharp = choice.step.turn == 0 || choice.step.radius_m == radius_m;
      cost += 2.0 * std::abs(choice.step.turn - mood.side) + (sharp == mood.sharp ? 0.0 : 1.0) +
              random.unit();
    }
    if (cost < least) {
      least = cost;
      best = i;
    }
  }
  return best;
}

/// A few steps more, from where a goal cell may have been touched to where it surely is entered: so
/// that the flight proves that it was. Returns their length.
double BehaviourPilot::enter_goal(BehaviourState state, std::vector<BehaviourStep>& steps) const {
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

BehaviourRun BehaviourPilot::fly(const State& start, Adversary adversary, std::uint64_t seed,
                                 double limit_m, std::vector<BehaviourStep>* steps) const {
  const Flow& flow = choices_.flow();
  const double most_m = limit_m > 0.0 ? limit_m : default_limit_m();
  Random random(seed);
  Mood mood;
  mood.adversary = adversary;
  mood.side = random.below(2) == 0 ? 1 : -1;
  BehaviourState state = BehaviourState::of(start);
  BehaviourRun run;
  BehaviourChoiceList list;
  const auto ended = [&](CellKind kind) {
    if (kind == CellKind::ordinary) return false;
    run.outcome = kind == CellKind::target     ? Outcome::reach
                  : kind == CellKind::obstacle ? Outcome::collide
                                               : Outcome::leave;
    return true;
  };
  if (ended(flow.kind_at(flow.grid.cell_of(start.position_m)))) return run;
  const double mood_m = choices_.contract().turn_radius_m.least;
  double renew_m = 0.0;
  while (run.length_m < most_m) {
    if (run.length_m >= renew_m) {
      renew(mood, state, random);
      renew_m = run.length_m + mood_m * 4.0 * random.unit() * random.unit();
    }
    choices_.list(state, list);
    const BehaviourChoice& choice = list[pick(mood, list, random)];
    run.length_m += length_of(choice.step, state.heading_rad);
    run.proved = run.proved && choice.proved;
    if (steps != nullptr) steps->push_back(choice.step);
    const Vec2 from = state.place;
    state = choice.end;
    if (!ended(choices_.met(from, state.place))) continue;
    if (run.outcome == Outcome::reach && steps != nullptr) {
      run.length_m += enter_goal(state, *steps);
    }
    return run;
  }
  run.outcome = Outcome::trapped;
  return run;
}

}  // namespace fairway
