#include "fairway/run/fly_many.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include <tbb/global_control.h>

#include "fairway/base/error.hpp"
#include "fairway/base/random.hpp"
#include "fairway/run/following_summary.hpp"
#include "fairway/simulate/flight_statistics.hpp"

namespace fairway {
namespace {

State random_state(Random& random, const Grid& grid) {
  return {{grid.x0_m + random.unit() * grid.width_m(), grid.y0_m + random.unit() * grid.height_m()},
          Heading::from_rad(random.uniform(-pi, pi))};
}

/// Unsteadily towards a goal near the middle, past obstacles and a whirl that traps flights.
Plan random_plan(Random& random, bool with_heading) {
  Plan plan;
  plan.grid = {40, 32, -5.0, 3.0, 4.0};
  plan.vehicle = {8.0, 9.0};
  const Vec2 goal_m = {75.0 + random.uniform(-30.0, 30.0), 67.0 + random.uniform(-20.0, 20.0)};
  const Vec2 eye_m{22.0, 32.0};
  for (int iy = 0; iy < plan.grid.ny; ++iy) {
    for (int ix = 0; ix < plan.grid.nx; ++ix) {
      const Vec2 way = goal_m - plan.grid.corner({ix, iy});
      const Vec2 to_eye = eye_m - plan.grid.corner({ix, iy});
      const double rad = norm(to_eye) < 25.0 ? Heading::of(to_eye).rad() + 1.2
                                             : Heading::of(way).rad() + random.uniform(-0.5, 0.5);
      plan.heading_rad.push_back(static_cast<float>(Heading::from_rad(rad).rad()));
      const bool goal = norm(way) < 14.0;
      plan.region.push_back(goal                    ? Region::goal
                            : random.unit() < 0.015 ? Region::obstacle
                            : random.unit() < 0.1   ? Region::buffer
                                                    : Region::free);
      plan.cost_m.push_back(static_cast<float>(norm(way)));
    }
  }
  GoalMission mission{goal_m, {}};
  if (with_heading) mission.goal_heading_rad = random.uniform(-pi, pi);
  plan.record.mission = mission;
  return plan;
}

std::vector<State> random_starts(Random& random, const Plan& plan, std::size_t count) {
  std::vector<State> starts;
  for (std::size_t i = 0; i < count; ++i) starts.push_back(random_state(random, plan.grid));
  return starts;
}

bool same(const FlightResult& a, const FlightResult& b) {
  return a.outcome == b.outcome && a.time_s == b.time_s && a.length_m == b.length_m;
}

bool same(const std::vector<FlightSegment>& a, const std::vector<FlightSegment>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const FlightSegment& x, const FlightSegment& y) {
                      return x.start == y.start && x.time_s == y.time_s &&
                             x.length_m == y.length_m && x.curvature_per_m == y.curvature_per_m;
                    });
}

bool same(const FinalLeg& a, const FinalLeg& b) {
  return a.state == b.state && a.entry == b.entry && a.word == b.word && a.time_s == b.time_s &&
         a.length_m == b.length_m && same(a.segments, b.segments);
}

bool same(const Flight& a, const Flight& b) {
  return a.start == b.start && same(a.result, b.result) && same(a.segments, b.segments) &&
         same(a.final_leg, b.final_leg);
}

TEST(FlyMany, ResultsAreThoseOfOneFlightAtATimeWhateverIsKept) {
  Random random(3);
  OutcomeCounts seen;
  for (int k = 0; k < 12; ++k) {
    const Plan plan = random_plan(random, k % 2 == 0);
    const ExactFlights alone(plan);
    const FlightEngine engine(plan);
    // More than a batch, and just one.
    const auto starts = random_starts(random, plan, k == 0 ? 2345 : k == 1 ? 1000 : 150);
    for (const std::size_t tracks :
         {std::size_t{0}, std::size_t{40}, starts.size(), std::size_t{5000}}) {
      for (const bool count_legs : {false, true}) {
        FlyOptions options;
        options.tracks = tracks;
        options.count_legs = count_legs;
        const ManyFlights flown = fly_many(engine, starts, options);
        ASSERT_EQ(flown.results.size(), starts.size());
        ASSERT_EQ(flown.recorded.size(), std::min(tracks, starts.size()));
        EXPECT_EQ(flown.final_legs.has_value(), count_legs && k % 2 == 0);
        for (std::size_t i = 0; i < starts.size(); ++i) {
          ASSERT_TRUE(same(flown.results[i], alone.fly(starts[i]))) << k << " " << i;
        }
        for (std::size_t i = 0; i < flown.recorded.size(); ++i) {
          const Flight recorded = alone.record(starts[i]);
          ASSERT_TRUE(same(flown.recorded[i].result, recorded.result));
          ASSERT_TRUE(same(flown.recorded[i].segments, recorded.segments));
        }
        for (const FlightResult& r : flown.results) seen.add(r.outcome);
      }
    }
  }
  for (const Outcome o : {Outcome::reach, Outcome::collide, Outcome::leave, Outcome::trapped}) {
    EXPECT_GT(seen.of(o), 20U) << name_of(o);
  }
}

TEST(FlyMany, LegsAreThoseOfOneFlightAtATimeAndAllAreCounted) {
  Random random(4);
  FinalLegTally all;
  for (int k = 0; k < 10; ++k) {
    const Plan plan = random_plan(random, true);
    const State goal = *goal_pose_of(plan);
    const FinalLegs legs(plan, goal);
    const auto starts = random_starts(random, plan, k == 0 ? 1100 : 120);
    FinalLegTally tally;
    std::vector<Flight> alone;
    for (const State& start : starts) {
      alone.push_back(ExactFlights(plan).record(start));
      alone.back().final_leg = legs.leg_of(alone.back());
      tally.add(alone.back(), goal);
      all.add(alone.back(), goal);
    }
    for (const std::size_t tracks : {std::size_t{0}, std::size_t{50}, starts.size()}) {
      FlyOptions options;
      options.tracks = tracks;
      options.count_legs = true;
      const ManyFlights flown = fly_many(FlightEngine(plan), starts, options);
      EXPECT_EQ(final_legs_json(flown.final_legs), final_legs_json(tally));
      for (std::size_t i = 0; i < tracks; ++i) {
        ASSERT_TRUE(same(flown.recorded[i], alone[i])) << k << " " << i;
      }
    }
  }
  EXPECT_GT(all.shortest, 50U);
  EXPECT_GT(all.other, 50U);
}

TEST(FlyMany, SampledFlightsAreDrawnByTheirIndex) {
  Random random(5);
  for (int k = 0; k < 4; ++k) {
    const Plan plan = random_plan(random, true);
    SampledOptions options;
    options.position_noise_m = 1.0;
    options.gust_mps = 1.5;
    options.seed = 7;
    options.time_limit_s = 60.0;
    const auto law = options_of_law(k % 2 == 0 ? "bang-bang" : "proportional", 1.5, options);
    const FlightEngine engine(plan, law);
    const SampledFlights alone(plan, *law);
    const auto starts = random_starts(random, plan, k == 0 ? 1200 : 60);
    FlyOptions asked;
    asked.tracks = 20;
    asked.count_legs = true;
    const ManyFlights flown = fly_many(engine, starts, asked);
    EXPECT_FALSE(flown.final_legs.has_value());
    for (std::size_t i = 0; i < starts.size(); ++i) {
      ASSERT_TRUE(same(flown.results[i], alone.fly(starts[i], i))) << i;
    }
    // The same flights in two parts, the second recorded again from where it begins.
    asked.first_index = 15;
    const ManyFlights rest = fly_many(engine, std::span(starts).subspan(15), asked);
    for (std::size_t i = 15; i < 20; ++i) {
      EXPECT_TRUE(same(flown.recorded[i], alone.record(starts[i], i).flight)) << i;
      EXPECT_TRUE(same(flown.recorded[i], rest.recorded[i - 15])) << i;
      EXPECT_EQ(flown.recorded[i].final_leg.state, FinalLegState::not_asked);
    }
  }
}

TEST(FlyMany, FollowsEveryFlightOfAPathAndLeavesItsResult) {
  Random random(6);
  Plan plan = random_plan(random, false);
  const PathMission path{{{20.0, 20.0}, {120.0, 20.0}, {120.0, 90.0}}, true, 9.0, 1.5};
  plan.record.mission = path;
  std::size_t goal_cells = 0;
  for (Region& region : plan.region) {  // obstacles among the goal cells
    if (region == Region::goal && ++goal_cells % 25 == 0) region = Region::obstacle;
  }
  const ExactFlights alone(plan);
  const FlightEngine engine(plan);
  const auto starts = random_starts(random, plan, 1200);
  FlyOptions options;
  options.tracks = 60;
  options.count_legs = true;
  options.measure = true;
  const ManyFlights plain = fly_many(engine, starts, options);
  EXPECT_FALSE(plain.followed.has_value());
  options.follow = one_lap;
  options.pool_from = 100;
  const ManyFlights flown = fly_many(engine, starts, options);
  ASSERT_TRUE(flown.followed.has_value());
  EXPECT_FALSE(flown.final_legs.has_value());
  const PathMeter meter(path, plan.vehicle.speed_mps, 0.5 * plan.grid.cell_m);
  PathSpreads spreads;
  std::size_t seen[3] = {0, 0, 0};
  for (std::size_t i = 0; i < starts.size(); ++i) {
    ASSERT_TRUE(same(flown.results[i], alone.fly(starts[i]))) << i;
    ASSERT_EQ(plain.measures[i].turning, alone.measure(starts[i]).turning);
    const Flight one = engine.record(starts[i], i, one_lap);
    ASSERT_EQ(flown.measures[i].onward, one.onward);
    ASSERT_EQ(flown.measures[i].turning, one.turning);
    if (i < 60) {
      ASSERT_TRUE(same(flown.recorded[i], one));
    }
    if (one.onward.after == After::none) {
      ASSERT_EQ(flown.measures[i].following, PathFollowing{});
      continue;
    }
    ++seen[static_cast<std::size_t>(one.onward.after) - 1];
    ASSERT_EQ(flown.measures[i].following, meter.measure(one, i < 100 ? nullptr : &spreads));
    if (one.onward.after != After::follow) continue;
    EXPECT_NEAR(one.onward.length_m - one.result.length_m, meter.locator().length_m(), 1e-6);
  }
  EXPECT_GT(seen[0], 5U);  // follow
  EXPECT_GT(seen[1], 5U);  // collide
  EXPECT_EQ(flown.followed->spreads.distance_m.spread().count, spreads.distance_m.spread().count);
  EXPECT_EQ(flown.followed->spreads.distance_m.spread().p95, spreads.distance_m.spread().p95);
  // To a goal there is nothing to follow.
  plan.record.mission = GoalMission{{75.0, 67.0}, {}};
  EXPECT_FALSE(fly_many(FlightEngine(plan), starts, options).followed.has_value());
}

TEST(FlyMany, MeasuresTheSameOnAnyNumberOfThreads) {
  Random random(12);
  Plan plan = random_plan(random, false);
  plan.record.mission = PathMission{{{20.0, 20.0}, {120.0, 20.0}, {120.0, 90.0}}, true, 9.0, 1.5};
  const FlightEngine engine(plan);
  const auto starts = random_starts(random, plan, 400);
  FlyOptions options;
  options.measure = true;
  options.follow = {.time_s = 25.0};
  const ManyFlights together = fly_many(engine, starts, options);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const ManyFlights alone = fly_many(engine, starts, options);
  EXPECT_EQ(together.measures, alone.measures);
  const auto json = [](const ManyFlights& flown) {
    return following_json(following_summary(flown, flown.results, flown.measures));
  };
  EXPECT_EQ(json(together), json(alone));
  EXPECT_EQ(json(alone)["time_s"], 25.0);
}

TEST(FlyMany, TellsHowManyAreFlownAndEndsWithWhatTheCallerThrows) {
  Random random(8);
  const Plan plan = random_plan(random, false);
  const FlightEngine engine(plan);
  const auto starts = random_starts(random, plan, 2500);
  std::vector<std::size_t> told;
  FlyOptions options;
  options.progress = [&](std::size_t flown) { told.push_back(flown); };
  (void)fly_many(engine, starts, options);
  EXPECT_EQ(told.back(), starts.size());
  EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
  EXPECT_GT(told.size(), 1U);
  told.clear();
  EXPECT_TRUE(fly_many(engine, {}, options).results.empty());
  EXPECT_TRUE(told.empty());
  options.progress = [](std::size_t) { throw std::runtime_error("enough"); };
  EXPECT_THROW((void)fly_many(engine, starts, options), std::runtime_error);
}

TEST(FlightLaws, AreFoundByTheirNames) {
  EXPECT_FALSE(options_of_law(exact_law, 1.0, {}).has_value());
  SampledOptions options;
  options.gust_mps = 2.0;
  const auto proportional = options_of_law("proportional", 1.5, options);
  EXPECT_EQ(proportional->gust_mps, 2.0);
  EXPECT_EQ(std::get<SaturatedProportional>(proportional->law).gain_per_s, 1.5);
  EXPECT_TRUE(std::holds_alternative<BangBang>(options_of_law("bang-bang", 1.5, {})->law));
  EXPECT_THROW((void)options_of_law("fuzzy", 1.0, {}), PreconditionViolation);
}

}  // namespace
}  // namespace fairway
