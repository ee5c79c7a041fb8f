// What vehicles do that hold: flights and proofs of plans with holding places and of missions that
// stay at their goal.
#include <cmath>
#include <filesystem>
#include <limits>
#include <variant>

#include <gtest/gtest.h>

#include "fairway/base/error.hpp"
#include "fairway/base/heading.hpp"
#include "fairway/base/mapped_file.hpp"
#include "fairway/base/random.hpp"
#include "fairway/behaviour/behaviour_choices.hpp"
#include "fairway/behaviour/behaviour_pilot.hpp"
#include "fairway/certificate/certificate_file.hpp"
#include "fairway/certificate/contract_certificate_file.hpp"
#include "fairway/contract_runtime.hpp"
#include "fairway/field/compute_field.hpp"
#include "fairway/field/holding_circle.hpp"
#include "fairway/plan/plan_of_field.hpp"
#include "fairway/run/ask_certificate.hpp"
#include "fairway/run/ask_contract.hpp"
#include "fairway/run/contract_verification.hpp"
#include "fairway/run/flight_engine.hpp"
#include "fairway/run/verification.hpp"
#include "fairway/simulate/exact_flight.hpp"

namespace fairway {
namespace {

namespace fs = std::filesystem;

constexpr Vehicle vehicle{10.0, 20.0};

/// A walled-off room of side x side cells below one of 44 x 44 cells.
ObstacleMap two_rooms(int side, double cell_m) {
  ObstacleMap map;
  map.grid = {46, side + 47, -30.0, 17.0, cell_m};
  map.obstacle.assign(map.grid.size(), 1);
  const auto open = [&](int y0, int width, int height) {
    for (int iy = y0; iy < y0 + height; ++iy) {
      for (int ix = 1; ix <= width; ++ix) map.obstacle[map.grid.index({ix, iy})] = 0;
    }
  };
  open(1, side, side);
  open(side + 2, 44, 44);
  return map;
}

Plan plan_of(const ObstacleMap& map, const Mission& mission, FallbackRule rule) {
  FieldOptions options;
  options.fallback = rule;
  return plan_of_field(std::get<Field>(compute_field(map, vehicle, mission, options)), vehicle);
}

State random_state(Random& random, const Grid& grid, Cell low, Cell high) {
  const Vec2 a = grid.corner(low);
  const Vec2 b = grid.corner(high);
  return {{random.uniform(a.x, b.x), random.uniform(a.y, b.y)},
          Heading::from_rad(random.uniform(-pi, pi))};
}

/// The file tells what the certificate tells.
void expect_same_on_board(const Certificate& certificate, const std::vector<State>& states,
                          const std::vector<runtime::Answer>& told) {
  const fs::path file = fs::path(::testing::TempDir()) / "holding.cert.safetensors";
  write_certificate(certificate, file, Existing::replace);
  EXPECT_EQ(read_certificate(file).holding, certificate.holding);
  const MappedFile mapped(file);
  runtime::Certificate on_board;
  ASSERT_EQ(on_board.open(mapped.bytes().data(), mapped.bytes().size()), runtime::Status::ok);
  for (std::size_t k = 0; k < states.size(); ++k) {
    const State& s = states[k];
    ASSERT_EQ(on_board.query(s.position_m.x, s.position_m.y, s.heading.rad()).verdict,
              told[k].verdict);
  }
  Certificate altered = certificate;
  altered.holding[0] = 1;  // an obstacle cell
  write_certificate(altered, file, Existing::replace);
  EXPECT_THROW(static_cast<void>(read_certificate(file)), InputError);
}

TEST(Holding, ProvedStatesCircleForEverInTheHoldingPlaceAndOthersAreNotToldTo) {
  for (const double cell_m : {6.0, 8.0, 12.0}) {
    const int side = static_cast<int>(120.0 / cell_m);
    const ObstacleMap map = two_rooms(side, cell_m);
    const Mission mission = GoalMission{map.grid.center({22, side + 24}), {}};
    const Plan plan = plan_of(map, mission, FallbackRule::hold);
    ASSERT_EQ(plan.record.holding_places.size(), 1U);
    CertifyOptions options;
    options.samples = 20000;
    const Verification made = verify_plan(plan, "plan", {}, options);
    const auto& shares = made.outcome.volume;
    EXPECT_GT(shares.all[static_cast<std::size_t>(Verdict::hold)], 0.02);
    EXPECT_EQ(shares.all[static_cast<std::size_t>(Verdict::trapped)], 0.0);
    EXPECT_EQ(shares.usable[static_cast<std::size_t>(Verdict::hold)], 0.0);
    const ExactFlights flights(plan);
    Random random(3);
    std::vector<State> states;
    for (int k = 0; k < 2000; ++k) {
      states.push_back(random_state(random, plan.grid, {1, 1}, {side + 1, side + 1}));
    }
    const std::vector<runtime::Answer> told = ask(made.certificate, states);
    const HoldingPlace& place = plan.record.holding_places[0];
    std::size_t holding = 0;
    for (std::size_t k = 0; k < states.size(); ++k) {
      const Outcome outcome = flights.fly(states[k]).outcome;
      ASSERT_NE(told[k].verdict, Verdict::trapped);
      if (told[k].verdict != Verdict::hold) continue;
      ++holding;
      ASSERT_EQ(outcome, Outcome::trapped);
      ASSERT_EQ(told[k].time_bound_s, std::numeric_limits<double>::infinity());
      const Flight flight = flights.follow(states[k], 6000.0);
      for (const FlightSegment& piece : flight.segments) {
        if (piece.time_s < 300.0) continue;
        EXPECT_LT(norm(piece.start.position_m - place.center_m),
                  place.radius_m + 0.25 * vehicle.turn_radius_m);
      }
    }
    EXPECT_GT(holding, 1200U) << cell_m;
    expect_same_on_board(made.certificate, states, told);
    const Plan none = plan_of(map, mission, FallbackRule::none);
    const Verification without = verify_plan(none, "plan", {}, options);
    EXPECT_EQ(without.outcome.volume.all[static_cast<std::size_t>(Verdict::hold)], 0.0);
    EXPECT_TRUE(without.certificate.holding.empty());
  }
}

TEST(Holding, UnderAContractWhoIsTrappedWhereThePlanHoldsHolds) {
  constexpr double cell_m = 8.0;
  constexpr int side = 15;
  const ObstacleMap map = two_rooms(side, cell_m);
  const GoalMission mission{map.grid.center({22, side + 24}), {}};
  VehicleContract contract = VehicleContract::of(vehicle);
  contract.command_error_m = 1.0;
  contract.heading_error_rad = 0.01;
  contract.turn_radius_m = {19.5, 20.5};
  ContractVerifyOptions options;
  options.samples = 20000;
  options.find_witnesses = false;
  const auto verdict_share = [&](const Plan& plan, Verdict verdict) {
    const auto made = verify_contract(plan, "plan", {}, contract, options, [](const auto&) {});
    return made.survey.shares.all[static_cast<std::size_t>(verdict)];
  };
  const Plan plan = plan_of(map, mission, FallbackRule::hold);
  EXPECT_GT(verdict_share(plan, Verdict::hold), 0.02);
  EXPECT_EQ(verdict_share(plan, Verdict::trapped), 0.0);
  EXPECT_EQ(verdict_share(plan_of(map, mission, FallbackRule::none), Verdict::hold), 0.0);

  const ContractCertificate certificate =
      verify_contract(plan, "plan", {}, contract, options, [](const auto&) {}).certificate;
  const fs::path file = fs::path(::testing::TempDir()) / "holding.contract.safetensors";
  write_contract_certificate(certificate, file, Existing::replace);
  EXPECT_EQ(read_contract_certificate(file).holding, certificate.holding);
  const MappedFile mapped(file);
  runtime::ContractCertificate on_board;
  ASSERT_EQ(on_board.open(mapped.bytes().data(), mapped.bytes().size()), runtime::Status::ok);

  // No behaviour from a state that is told to hold ever meets an end.
  const ContractQueries queries(certificate);
  const BehaviourChoices choices(certificate.flow(), contract);
  const BehaviourPilot pilot(choices);
  Random random(7);
  int holding = 0;
  for (int k = 0; k < 200; ++k) {
    const State start = random_state(random, plan.grid, {1, 1}, {side + 1, side + 1});
    const Verdict told = queries.proved(start).verdict;
    ASSERT_NE(told, Verdict::trapped);
    const auto aboard =
        on_board.query(start.position_m.x, start.position_m.y, start.heading.rad()).verdict;
    ASSERT_TRUE(aboard == told || aboard == Verdict::undecided);
    if (told != Verdict::hold) continue;
    ++holding;
    for (const Adversary adversary : {Adversary::random, Adversary::greedy, Adversary::circling}) {
      ASSERT_EQ(pilot.fly(start, adversary, random.bits()).outcome, Outcome::trapped);
    }
  }
  EXPECT_GT(holding, 100);
}

TEST(Holding, WhoReachedAGoalToHoldAtStaysNearItForEver) {
  for (const double cell_m : {5.0, 8.0, 11.0}) {
    ObstacleMap map;
    map.grid = {70, 60, 0.0, 0.0, cell_m};
    map.obstacle.assign(map.grid.size(), 0);
    const Vec2 goal{map.grid.width_m() / 2.0 + 1.3, map.grid.height_m() / 2.0 + 2.1};
    for (int k = -6; k <= 6; ++k) {
      const Vec2 rock = goal + Vec2{k * cell_m, -95.0};  // as near as the buffer lets it
      map.obstacle[map.grid.index(map.grid.cell_of(rock))] = 1;
    }
    GoalMission mission{goal, {}};
    mission.hold = true;
    const Plan plan = plan_of(map, mission, FallbackRule::hold);
    const ExactFlights flights(plan);
    Random random(11);
    std::size_t reached = 0;
    double farthest_m = 0.0;
    double farthest_late_m = 0.0;
    for (int k = 0; k < 3000; ++k) {
      const Cell low = k % 3 == 0 ? Cell{30, 25} : Cell{0, 0};
      const Cell high = k % 3 == 0 ? Cell{40, 35} : Cell{70, 60};
      const State start = random_state(random, plan.grid, low, high);
      const Flight flight = flights.follow_on(start, {.length_m = 6000.0});
      if (flight.result.outcome != Outcome::reach) continue;
      ++reached;
      ASSERT_EQ(flight.onward.after, After::follow);
      for (const FlightSegment& piece : flight.segments) {
        if (piece.time_s < flight.result.time_s) continue;
        const double from_goal_m = norm(piece.start.position_m - goal);
        farthest_m = std::max(farthest_m, from_goal_m);
        if (piece.time_s > flight.result.time_s + 60.0)
          farthest_late_m = std::max(farthest_late_m, from_goal_m);
      }
    }
    EXPECT_GT(reached, 2000U);
    EXPECT_LT(farthest_m, 4.0 * vehicle.turn_radius_m);
    const HoldingPlace place = holding_place_at(plan.grid, goal, vehicle);
    EXPECT_LT(farthest_late_m, norm(place.center_m - goal) + holding_room_m(plan.grid, vehicle));
  }
}

TEST(Holding, FlightsTellWhoHolds) {
  const ObstacleMap map = two_rooms(15, 8.0);
  GoalMission mission{map.grid.center({22, 39}), {}};
  mission.hold = true;
  Plan plan = plan_of(map, mission, FallbackRule::hold);
  plan.record.mission = mission;
  const FlightEngine engine(plan);
  ASSERT_TRUE(engine.holds());
  Random random(5);
  std::size_t held = 0;
  std::size_t waiting = 0;
  for (int k = 0; k < 300; ++k) {
    const bool below = k % 3 == 0;  // in the room that is closed
    const State start = below ? random_state(random, plan.grid, {1, 1}, {16, 16})
                              : random_state(random, plan.grid, {1, 17}, {45, 61});
    const Flight flight = engine.record(start, 0, five_laps);
    EXPECT_EQ(flight.result.outcome, engine.fly(start, 0).outcome);
    ASSERT_NE(flight.result.outcome, Outcome::trapped);
    if (flight.result.outcome == Outcome::reach) {
      EXPECT_NE(flight.onward.after, After::follow);
      held += flight.onward.after == After::hold ? 1 : 0;
    } else {
      EXPECT_EQ(flight.onward.after, After::none);
    }
    EXPECT_TRUE(below || flight.result.outcome != Outcome::hold);
    waiting += flight.result.outcome == Outcome::hold ? 1 : 0;
  }
  EXPECT_GT(held, 100U);
  EXPECT_GT(waiting, 50U);
}

// Without it vehicles circle past the goal on a continuum of closed curves, which no proof by
// leaves takes apart; on the circle they all come to the same one.
TEST(Holding, OtherRegionsAreProvedWhereTheVehicleHoldsAtItsGoal) {
  ObstacleMap map;
  map.grid = {50, 50, 0.0, 0.0, 8.0};
  map.obstacle.assign(map.grid.size(), 0);
  for (const Cell at : {Cell{10, 12}, Cell{38, 10}, Cell{12, 38}}) {
    for (int iy = 0; iy < 5; ++iy) {
      for (int ix = 0; ix < 5; ++ix) map.obstacle[map.grid.index({at.ix + ix, at.iy + iy})] = 1;
    }
  }
  GoalMission mission{{203.0, 197.0}, {}};
  CertifyOptions options;
  options.samples = 20000;
  RegionOfInterest obstacles;
  obstacles.kind = RegionOfInterest::Kind::obstacle;
  RegionOfInterest corner;
  corner.kind = RegionOfInterest::Kind::rectangle;
  corner.rectangle_m = {280.0, 280.0, 400.0, 400.0};
  for (const RegionOfInterest& region : {obstacles, corner}) {
    for (const bool hold : {false, true}) {
      mission.hold = hold;
      const Plan plan = plan_of(map, mission, FallbackRule::hold);
      const Verification made = verify_plan(plan, "plan", region, options);
      const double undecided =
          made.outcome.volume.all[static_cast<std::size_t>(Verdict::undecided)];
      if (hold) {
        EXPECT_LT(undecided, 0.01);
      } else {
        EXPECT_GT(undecided, 0.5);  // if this fails, tell it: docs/verification.md
      }
    }
  }
}

TEST(Holding, AGoalWithoutRoomForTheCircleOrADiscTooSmallIsRefused) {
  ObstacleMap map;
  map.grid = {60, 60, 0.0, 0.0, 8.0};
  map.obstacle.assign(map.grid.size(), 0);
  GoalMission mission{{240.0, 240.0}, {}};
  mission.hold = true;
  FieldOptions options;
  const auto refused = [&] {
    const auto made = compute_field(map, vehicle, mission, options);
    const auto* refusal = std::get_if<MissionRefusal>(&made);
    return refusal != nullptr ? refusal->message : std::string();
  };
  EXPECT_EQ(refused(), "");
  options.beta = 1.0;
  EXPECT_NE(refused().find("no room for the circle"), std::string::npos) << refused();
  options.beta = 2.0;
  mission.hold_radius_m = 30.0;
  EXPECT_NE(refused().find("needs at least"), std::string::npos) << refused();
  mission.hold_radius_m = 80.0;
  EXPECT_EQ(refused(), "");
}

}  // namespace
}  // namespace fairway
