// Flies random states of path missions' plans for some laps, and counts what becomes of them
// (docs/following.md): one line of CSV for each plan.
//
// With --proof also what is proved of them under a contract: a command error of 0.1 r, a heading
// error of one degree, radii of r +-5 %.
//
// Usage: fairway-following PLAN... [--states N] [--laps N] [--seed S] [--proof]
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
#include "fairway/run/contract_verification.hpp"
#include "tools/following/follow_flights.hpp"
#include "tools/following/viable_states.hpp"

namespace fairway::following {
namespace {

struct Arguments {
  std::vector<std::string> plans;
  std::size_t states = 2000;
  double laps = 3.0;
  std::uint64_t seed = 1;
  bool proof = false;
};

Arguments arguments_of(const std::vector<std::string>& words) {
  Arguments out;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] == "--proof") {
      out.proof = true;
    } else if (words[i].starts_with("--") && i + 1 < words.size()) {
      const std::string& value = words[i + 1];
      if (words[i] == "--states") out.states = std::stoul(value);
      if (words[i] == "--laps") out.laps = std::stod(value);
      if (words[i] == "--seed") out.seed = std::stoul(value);
      ++i;
    } else {
      out.plans.push_back(words[i]);
    }
  }
  return out;
}

struct Starts {
  std::vector<State> viable;
  double least_share = 0.0;  // of all states of cells with a command, viable at least
  double most_share = 0.0;
};

/// Uniform over the cells with a command.
Starts draw_starts(const Plan& plan, const Arguments& asked) {
  constexpr double cut_radii = 0.05;
  std::vector<std::size_t> cells;
  for (std::size_t i = 0; i < plan.region.size(); ++i) {
    if (plan.region[i] == Region::obstacle || !std::isfinite(plan.heading_rad[i])) continue;
    cells.push_back(i);
  }
  Random random(asked.seed);
  std::vector<State> drawn(cells.empty() ? 0 : asked.states);
  for (State& state : drawn) {
    const Vec2 corner = plan.grid.corner(plan.grid.cell_at(cells[random.below(cells.size())]));
    const double x = corner.x + plan.grid.cell_m * random.unit();
    const double y = corner.y + plan.grid.cell_m * random.unit();
    state = {{x, y}, Heading::from_rad(random.uniform(-pi, pi))};
  }
  const ViableStates viable(plan);
  std::vector<char> sure(drawn.size());
  std::vector<char> perhaps(drawn.size());
  for_ranges(drawn.size(), 4, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      sure[i] = viable.contains(drawn[i], 0.0) ? 1 : 0;
      perhaps[i] =
          sure[i] != 0 || viable.contains(drawn[i], cut_radii * plan.vehicle.turn_radius_m) ? 1 : 0;
    }
  });
  Starts out;
  const auto n = static_cast<double>(std::max<std::size_t>(1, drawn.size()));
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    if (sure[i] != 0) out.viable.push_back(drawn[i]);
    out.most_share += perhaps[i] / n;
  }
  out.least_share = static_cast<double>(out.viable.size()) / n;
  return out;
}

void report_proof(const Plan& plan, const FollowFlights& engine) {
  const double r = plan.vehicle.turn_radius_m;
  VehicleContract contract = VehicleContract::of(plan.vehicle);
  contract.command_error_m = 0.1 * r;
  contract.heading_error_rad = pi / 180.0;
  contract.turn_radius_m = {0.95 * r, 1.05 * r};
  ContractVerifyOptions options;
  options.find_witnesses = false;
  options.or_touch = false;
  const ContractVerification proved =
      verify_contract(plan, "plan", {}, contract, options, [](const std::string&) {});
  if (!proved.following) {
    fmt::print(",0,,,,");
    return;
  }
  const Following& found = *proved.following;
  double gentle_m = 0.0;
  const auto stretches = static_cast<double>(found.tube.size());
  for (std::size_t k = 0; k < found.tube.size(); ++k) {
    const double from = static_cast<double>(k) / stretches;
    if (engine.is_gentle(from, from + 1.0 / stretches)) {
      gentle_m = std::max(gentle_m, static_cast<double>(found.tube[k].distance_m));
    }
  }
  fmt::print(",{:.4f},{:.3f},{:.3f},{:.1f},{:.1f}",
             proved.survey.shares.usable[static_cast<std::size_t>(Verdict::reach)], gentle_m / r,
             found.tube_m / r, found.lap_least_s, found.lap_most_s);
}

void report(const std::string& file, const Arguments& asked) {
  const Plan plan = read_plan(file);
  const Starts starts = draw_starts(plan, asked);
  constexpr double tube_radii = 0.5;
  const FollowFlights engine(plan, tube_radii);
  std::vector<FollowedFlight> flown(starts.viable.size());
  for_ranges(flown.size(), 4, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) flown[i] = engine.fly(starts.viable[i], asked.laps);
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
  fmt::print("{},{},{:.4f},{:.4f}", file, asked.states, starts.least_share, starts.most_share);
  for (const std::size_t n : count) fmt::print(",{:.4f}", share(n, flown.size()));
  fmt::print(",{:.4f},{:.3f},{:.2f},{:.1f}", share(forward_follow, forward), tube_m / r,
             share(1, count[0]) * join_m / r, engine.length_m() / plan.vehicle.speed_mps);
  if (asked.proof) report_proof(plan, engine);
  fmt::print("\n");
  std::fflush(stdout);
}

}  // namespace
}  // namespace fairway::following

int main(int count, char** words) {
  using namespace fairway::following;
  try {
    const Arguments asked = arguments_of({words + 1, words + count});
    fmt::print("plan,states,viable_least,viable_most");
    for (const char* name : fate_names) fmt::print(",{}", name);
    fmt::print(",follow_facing_forward,tube_radii,join_radii,length_s");
    if (asked.proof) fmt::print(",proved,proved_gentle_radii,proved_radii,lap_least_s,lap_most_s");
    fmt::print("\n");
    for (const std::string& plan : asked.plans) report(plan, asked);
  } catch (const std::exception& error) {
    fmt::print(stderr, "fairway-following: {}\n", error.what());
    return 65;
  }
  return 0;
}
