#include "reproduce/steering_robustness.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "fairway/base/parallel.hpp"
#include "fairway/base/random.hpp"
#include "fairway/steer/steering_flight.hpp"

namespace fairway::reproduce {
namespace {

constexpr std::uint64_t seed = 7;

State random_pose(Random& random) {
  const double x = random.uniform(-4.0, 4.0);
  const double y = random.uniform(-4.0, 4.0);
  return {{x, y}, Heading::from_rad(random.uniform(-pi, pi))};
}

template <typename Law>
SteeringFlight flight_of(Law law, const RobustnessRow& row, std::size_t start) {
  Random random = Random::stream(seed, start);
  const State from = random_pose(random);
  const State goal = random_pose(random);
  const SteeringWorld world = world_of({row.goal_speed, row.noise, random}, goal, 1.0);
  const SteeringOptions options{0.01, {row.tolerance, row.tolerance}, 120.0};
  return fly(law, from, goal, 1.0, options, Track::none, world);
}

void measure(RobustnessRow& row) {
  const auto starts = static_cast<std::size_t>(row.starts);
  for (std::size_t law = 0; law < law_names.size(); ++law) {
    std::vector<double> lengths(starts);
    std::vector<int> caught(starts);
    for_ranges(starts, 16, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const PoseTolerance tolerance{row.tolerance, row.tolerance};
        const SteeringFlight flight = law == 0 ? flight_of(ShortestLaw({tolerance, 0.02}), row, i)
                                               : flight_of(ClfLaw(), row, i);
        lengths[i] = flight.length_m;
        caught[i] = flight.converged ? 1 : 0;
      }
    });
    row.caught[law] = static_cast<int>(std::count(caught.begin(), caught.end(), 1));
    std::sort(lengths.begin(), lengths.end());
    row.median_driven[law] = lengths[starts / 2];
    row.driven_by_95_percent[law] = lengths[starts * 95 / 100];
  }
}

}  // namespace

std::vector<RobustnessRow> steering_robustness(int starts) {
  std::vector<RobustnessRow> rows;
  for (const double tolerance : {0.02, 0.05}) {
    for (const double noise : {0.0, 5e-4, 2e-3}) {
      for (const double speed : {0.0, 0.25, 0.5}) {
        rows.push_back({tolerance, noise, speed, starts, {}, {}, {}});
        measure(rows.back());
      }
    }
  }
  return rows;
}

std::string table_of(const std::vector<RobustnessRow>& rows) {
  std::string text =
      "| tolerance | noise | goal's speed | shortest: caught | median, 95 % driven (r) | clf: "
      "caught | median, 95 % driven (r) |\n|---|---|---|---|---|---|---|\n";
  for (const RobustnessRow& r : rows) {
    text += fmt::format(
        "| {:g} | {:g} | {:g} | {} of {} | {:.1f}, {:.1f} | {} of {} | {:.1f}, "
        "{:.1f} |\n",
        r.tolerance, r.noise, r.goal_speed, r.caught[0], r.starts, r.median_driven[0],
        r.driven_by_95_percent[0], r.caught[1], r.starts, r.median_driven[1],
        r.driven_by_95_percent[1]);
  }
  return text;
}

}  // namespace fairway::reproduce
