// Flies random states of path missions' plans for some laps, and counts what becomes of them
// (docs/following.md): one line of CSV for each plan.
//
// Usage: fairway-following PLAN... [--flights N] [--laps N] [--seed S]
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "fairway/base/parallel.hpp"
#include "fairway/base/random.hpp"
#include "fairway/plan/plan_file.hpp"
#include "tools/following/follow_flights.hpp"
#include "tools/following/viable_states.hpp"

namespace fairway::following {
namespace {

struct Arguments {
  std::vector<std::string> plans;
  std::size_t flights = 2000;
  double laps = 3.0;
  std::uint64_t seed = 1;
};

Arguments arguments_of(const std::vector<std::string>& words) {
  Arguments out;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i].starts_with("--") && i + 1 < words.size()) {
      const std::string& value = words[i + 1];
      if (words[i] == "--flights") out.flights = std::stoul(value);
      if (words[i] == "--laps") out.laps = std::stod(value);
      if (words[i] == "--seed") out.seed = std::stoul(value);
      ++i;
    } else {
      out.plans.push_back(words[i]);
    }
  }
  return out;
}

/// Uniform over the cells with a command, and viable.
std::vector<State> viable_starts(const Plan& plan, const Arguments& asked, double& viable_share) {
  constexpr int places_per_turn = 5;
  const int fineness = std::max(1, static_cast<int>(std::lround(places_per_turn * plan.grid.cell_m /
                                                                plan.vehicle.turn_radius_m)));
  const ViableStates viable(plan, fineness);
  std::vector<std::size_t> cells;
  for (std::size_t i = 0; i < plan.region.size(); ++i) {
    if (plan.region[i] != Region::obstacle && std::isfinite(plan.heading_rad[i]))
      cells.push_back(i);
  }
  std::vector<State> starts;
  Random random(asked.seed);
  const std::size_t most = 100 * asked.flights;
  std::size_t drawn = 0;
  for (; starts.size() < asked.flights && drawn < most && !cells.empty(); ++drawn) {
    const Vec2 corner = plan.grid.corner(plan.grid.cell_at(cells[random.below(cells.size())]));
    const double x = corner.x + plan.grid.cell_m * random.unit();
    const double y = corner.y + plan.grid.cell_m * random.unit();
    const State state{{x, y}, Heading::from_rad(random.uniform(-pi, pi))};
    if (viable.contains(state)) starts.push_back(state);
  }
  viable_share = drawn == 0 ? 0.0 : static_cast<double>(starts.size()) / static_cast<double>(drawn);
  return starts;
}

void report(const std::string& file, const Arguments& asked) {
  const Plan plan = read_plan(file);
  double viable_share = 0.0;
  const std::vector<State> starts = viable_starts(plan, asked, viable_share);
  constexpr double tube_radii = 0.5;
  const FollowFlights engine(plan, tube_radii);
  std::vector<FollowedFlight> flown(starts.size());
  for_ranges(starts.size(), 4, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) flown[i] = engine.fly(starts[i], asked.laps);
  });
  std::array<std::size_t, fate_names.size()> count{};
  std::size_t forward = 0;
  std::size_t forward_follow = 0;
  double tube_m = 0.0;
  double join_m = 0.0;
  for (const FollowedFlight& flight : flown) {
    ++count[static_cast<std::size_t>(flight.fate)];
    const bool follows = flight.fate == Fate::follow;
    forward += flight.begins_forward ? 1 : 0;
    forward_follow += flight.begins_forward && follows ? 1 : 0;
    if (!follows) continue;
    tube_m = std::max(tube_m, flight.tube_m);
    join_m += flight.join_m;
  }
  const auto share = [](std::size_t part, std::size_t of) {
    return of == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(of);
  };
  const double r = plan.vehicle.turn_radius_m;
  fmt::print("{},{},{:.3f}", file, starts.size(), viable_share);
  for (const std::size_t n : count) fmt::print(",{:.4f}", share(n, starts.size()));
  fmt::print(",{:.4f},{:.3f},{:.2f}\n", share(forward_follow, forward), tube_m / r,
             share(1, count[0]) * join_m / r);
  std::fflush(stdout);
}

}  // namespace
}  // namespace fairway::following

int main(int count, char** words) {
  using namespace fairway::following;
  try {
    const Arguments asked = arguments_of({words + 1, words + count});
    fmt::print("plan,flights,viable_share");
    for (const char* name : fate_names) fmt::print(",{}", name);
    fmt::print(",follow_facing_forward,tube_radii,join_radii\n");
    for (const std::string& plan : asked.plans) report(plan, asked);
  } catch (const std::exception& error) {
    fmt::print(stderr, "fairway-following: {}\n", error.what());
    return 65;
  }
  return 0;
}
