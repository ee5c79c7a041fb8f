#include "fairway/tune/search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <nlopt.hpp>

namespace fairway {
namespace {

struct Seeker {
  const Sought& sought;
  std::vector<double> best_place;
  double best = -std::numeric_limits<double>::infinity();
  bool over = false;

  double ask(const std::vector<double>& place) {
    const std::optional<double> value = sought(place);
    if (!value) {
      over = true;
      throw nlopt::forced_stop();
    }
    if (*value > best) {
      best = *value;
      best_place = place;
    }
    return *value;
  }
};

double ask(const std::vector<double>& place, std::vector<double>& /*slope*/, void* seeker) {
  return static_cast<Seeker*>(seeker)->ask(place);
}

void run(nlopt::algorithm algorithm, std::vector<double> from, int evaluations, Seeker& seeker) {
  if (evaluations <= 0 || seeker.over) return;
  nlopt::opt optimiser(algorithm, static_cast<unsigned>(from.size()));
  optimiser.set_max_objective(ask, &seeker);
  optimiser.set_lower_bounds(0.0);
  optimiser.set_upper_bounds(1.0);
  optimiser.set_maxeval(evaluations);
  if (algorithm == nlopt::LN_SBPLX) {
    constexpr double first_step = 0.08;
    optimiser.set_initial_step(first_step);
    optimiser.set_xtol_abs(1e-3);
  }
  double value = 0.0;
  try {
    optimiser.optimize(from, value);
  } catch (const nlopt::forced_stop&) {  // the best so far is kept beside it
  } catch (const nlopt::roundoff_limited&) {
  }
}

}  // namespace

void search_box(std::span<const double> start, int evaluations, const Sought& sought) {
  Seeker seeker{sought, {start.begin(), start.end()}};
  try {
    seeker.ask(seeker.best_place);
  } catch (const nlopt::forced_stop&) {
    return;
  }
  constexpr double share_all_over = 0.6;
  const int all_over = static_cast<int>(std::lround(share_all_over * (evaluations - 1)));
  run(nlopt::GN_DIRECT, seeker.best_place, all_over, seeker);
  run(nlopt::LN_SBPLX, seeker.best_place, evaluations - 1 - all_over, seeker);
}

}  // namespace fairway
