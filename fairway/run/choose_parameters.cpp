#include "fairway/run/choose_parameters.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "fairway/base/heading.hpp"
#include "fairway/base/random.hpp"
#include "fairway/field/connected_parts.hpp"
#include "fairway/run/fly_many.hpp"
#include "fairway/run/plan_map.hpp"
#include "fairway/simulate/exact_flight.hpp"

namespace fairway {
namespace {

constexpr std::size_t flights_to_a_goal = 10'000;
constexpr std::size_t flights_along_a_path = 2'000;  // each takes as long as a lap
constexpr std::uint64_t seed_of_a_choice = 1;

/// Cells that are neither obstacle nor goal, of the parts of open ground that the mission lies in:
/// the same for all parameters that leave the goal as it is.
std::vector<std::size_t> cells_around_mission(const Plan& plan) {
  std::vector<std::uint8_t> open(plan.grid.size());
  for (std::size_t i = 0; i < open.size(); ++i) open[i] = plan.region[i] != Region::obstacle;
  const ConnectedParts parts = connected_parts(open, plan.grid.nx, plan.grid.ny);
  std::vector<bool> has_goal(parts.cells.size());
  for (std::size_t i = 0; i < open.size(); ++i) {
    if (plan.region[i] == Region::goal) has_goal[parts.part[i]] = true;
  }
  std::vector<std::size_t> cells;
  for (std::size_t i = 0; i < open.size(); ++i) {
    if (open[i] != 0 && plan.region[i] != Region::goal && has_goal[parts.part[i]]) {
      cells.push_back(i);
    }
  }
  return cells;
}

std::vector<State> states_around_mission(const Plan& plan, std::size_t count, std::uint64_t seed) {
  const std::vector<std::size_t> cells = cells_around_mission(plan);
  std::vector<State> states;
  for (std::size_t i = 0; i < count && !cells.empty(); ++i) {
    Random random = Random::stream(seed, i);
    const Vec2 corner = plan.grid.corner(plan.grid.cell_at(cells[random.below(cells.size())]));
    const double x = corner.x + plan.grid.cell_m * random.unit();
    const double y = corner.y + plan.grid.cell_m * random.unit();
    states.push_back({{x, y}, Heading::from_rad(random.uniform(-pi, pi))});
  }
  return states;
}

/// What arrives does so within its cost and some turns; all else circles.
double longest_flight_m(const Plan& plan) {
  double farthest_m = 0.0;
  for (const float cost_m : plan.cost_m) {
    if (std::isfinite(cost_m)) farthest_m = std::max(farthest_m, static_cast<double>(cost_m));
  }
  constexpr double detour = 2.0;
  constexpr double turns = 6.0;
  return detour * farthest_m + turns * two_pi * plan.vehicle.turn_radius_m;
}

bool is_to_be_followed(const Plan& plan) {
  if (!plan.record.mission) return false;
  const auto* path = std::get_if<PathMission>(&*plan.record.mission);
  return path != nullptr && path->accept == PathAccept::follow;
}

void add(FlownShare& flown, const Plan& plan, const State& start, bool arrives, double time_s) {
  const std::size_t cell = plan.grid.index(plan.grid.cell_of(start.position_m));
  const bool is_safe = plan.region[cell] == Region::free && std::isfinite(plan.cost_m[cell]);
  flown.safe_starts += is_safe ? 1 : 0;
  if (!arrives) return;
  ++flown.arrive;
  flown.safe_arrive += is_safe ? 1 : 0;
  flown.mean_time_s += time_s;
}

}  // namespace

std::vector<FieldOptions> candidate_options(const FieldOptions& asked, OpenParameters open,
                                            const Vehicle& vehicle, double cell_m) {
  // Buffers of the cells beside obstacles, of those at their corners too, and of 1.5 r; centres of
  // cells are measured, hence a little more than the distance.
  constexpr double beside_cells = 1.01;
  constexpr double corner_cells = 1.42;
  constexpr double wide_radii = 1.5;
  constexpr double light_filter_cells = 0.5;
  const FieldOptions papers;
  const double cell_radii = cell_m / vehicle.turn_radius_m;
  std::vector<std::pair<double, double>> pairs{{papers.alpha, papers.sigma_cells}};
  for (const double alpha :
       {papers.alpha, wide_radii, corner_cells * cell_radii, beside_cells * cell_radii}) {
    pairs.emplace_back(alpha, light_filter_cells);
  }
  std::vector<FieldOptions> all;
  for (auto& [alpha, sigma_cells] : pairs) {
    FieldOptions one = asked;
    if (open.alpha) one.alpha = alpha;
    if (open.sigma_cells) one.sigma_cells = sigma_cells;
    const bool is_new = std::none_of(all.begin(), all.end(), [&](const FieldOptions& other) {
      return other.alpha == one.alpha && other.sigma_cells == one.sigma_cells;
    });
    if (is_new) all.push_back(one);
  }
  return all;
}

FlownShare fly_all_states(const Plan& plan, std::size_t count, std::uint64_t seed) {
  const std::vector<State> starts = states_around_mission(plan, count, seed);
  FlownShare flown;
  flown.states = starts.size();
  if (is_to_be_followed(plan)) {
    const FlightEngine engine(plan);
    FlyOptions options;
    options.follow = one_lap;
    options.measure = true;
    const ManyFlights many = fly_many(engine, starts, options);
    for (std::size_t i = 0; i < starts.size(); ++i) {
      add(flown, plan, starts[i], many.measures[i].onward.after == After::follow,
          many.results[i].time_s);
    }
  } else {
    const ExactFlights flights(plan);
    FlightLimits limits;
    limits.length_m = longest_flight_m(plan);
    const std::vector<FlightResult> results = flights.fly_all(starts, limits);
    for (std::size_t i = 0; i < starts.size(); ++i) {
      add(flown, plan, starts[i], results[i].outcome == Outcome::reach, results[i].time_s);
    }
  }
  if (flown.arrive > 0) flown.mean_time_s /= static_cast<double>(flown.arrive);
  return flown;
}

ChosenParameters choose_parameters(const ObstacleMap& map, const Vehicle& vehicle,
                                   const Mission& mission,
                                   const std::vector<FieldOptions>& candidates) {
  ChosenParameters chosen{candidates.front(), {}};
  if (candidates.size() == 1) return chosen;
  // Less may be chance, and commands of another plan may be harder to prove.
  constexpr double worth_it = 0.005;
  const bool is_goal = std::holds_alternative<GoalMission>(mission);
  std::optional<double> best;  // of what was chosen; to be better than the first takes more
  for (const FieldOptions& options : candidates) {
    chosen.tried.push_back({options, std::nullopt});
    const auto answer = plan_map(map, vehicle, mission, options);
    if (const auto* plan = std::get_if<Plan>(&answer)) {
      chosen.tried.back().flown = fly_all_states(
          *plan, is_goal ? flights_to_a_goal : flights_along_a_path, seed_of_a_choice);
      const double share = chosen.tried.back().flown->share();
      if (best && share <= *best) continue;
      const bool is_first = chosen.tried.size() == 1;
      best = share + (is_first ? worth_it : 0.0);
      chosen.options = options;
    } else if (!best && options.alpha < chosen.options.alpha) {
      chosen.options = options;
    }
  }
  return chosen;
}

nlohmann::json tried_json(const std::vector<TriedParameters>& tried) {
  nlohmann::json all = nlohmann::json::array();
  for (const TriedParameters& one : tried) {
    all.push_back(
        {{"alpha", one.options.alpha},
         {"sigma_cells", one.options.sigma_cells},
         {"flown_share", one.flown ? nlohmann::json(one.flown->share()) : nlohmann::json()}});
  }
  return all;
}

}  // namespace fairway
