#include "fairway/simulate/modal_flight.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "fairway/base/error.hpp"
#include "fairway/base/random.hpp"

namespace fairway {
namespace {

State state(double x, double y, double heading_rad) {
  return {{x, y}, Heading::from_rad(heading_rad)};
}

/// One heading a mode, over all cells.
Plan plan_of(int nx, int ny, const std::vector<double>& heading_rad) {
  Plan plan;
  plan.grid = {nx, ny, 0.0, 0.0, 2.0};
  plan.vehicle = {10.0, 5.0};
  plan.region.assign(plan.grid.size(), Region::free);
  plan.cost_m.assign(plan.grid.size(), 1.0F);
  plan.heading_rad.assign(plan.grid.size(), Heading::stored(heading_rad[0]));
  for (std::size_t k = 1; k < heading_rad.size(); ++k) {
    plan.mode_heading_rad.insert(plan.mode_heading_rad.end(), plan.grid.size(),
                                 Heading::stored(heading_rad[k]));
  }
  return plan;
}

/// Begins in `first`; after so many borders, changes to `second`.
class ChangesAfter final : public ModeDecider {
 public:
  ChangesAfter(int first, int borders, int second = 0)
      : first_(first), borders_(borders), second_(second) {}
  int begin(const State&) override { return first_; }
  int at_border(const BorderCrossing& crossing, int mode) override {
    crossings.push_back(crossing);
    return static_cast<int>(crossings.size()) == borders_ ? second_ : mode;
  }
  double weaves_m(const BorderCrossing&, int) override { return most_weave_m; }

  std::vector<BorderCrossing> crossings;
  double most_weave_m = 0.0;

 private:
  int first_;
  int borders_;
  int second_;
};

TEST(ModalFlight, ChangesAtTheBorderInClosedForm) {
  const ModalFlights flights(plan_of(30, 20, {pi / 2, 0.0}));
  ChangesAfter fifth(1, 5);
  const ModalRun flown = flights.run(state(1.0, 11.0, 0.0), fifth);
  EXPECT_EQ(flown.run.result.outcome, Outcome::leave);
  // 9 m to the fifth border, a quarter circle to the left, and from y = 16 m to the edge; the
  // command is a float and misses pi / 2 by 4e-8.
  EXPECT_NEAR(flown.run.result.length_m, 9.0 + 5.0 * pi / 2 + 24.0, 1e-6);
  EXPECT_EQ(flown.run.result.mode, 1);
  EXPECT_EQ(flown.changes, 1);
  EXPECT_EQ(flown.last_mode, 0);
  ASSERT_EQ(fifth.crossings.size(), 5U);
  for (int i = 0; i < 5; ++i) {
    const BorderCrossing& crossing = fifth.crossings[static_cast<std::size_t>(i)];
    EXPECT_EQ(crossing.state.position_m, (Vec2{2.0 * (i + 1), 11.0}));
    EXPECT_EQ(crossing.left, (Cell{i, 5}));
    EXPECT_EQ(crossing.side, Side::right);
    EXPECT_EQ(crossing.along_m, 1.0);
    EXPECT_TRUE(crossing.aligned);
  }
}

TEST(ModalFlight, RecordsPiecesOfOneModeEachJoinedEndToEnd) {
  const ModalFlights flights(plan_of(30, 20, {pi / 2, 0.0, 0.0}));
  ChangesAfter third(2, 3);
  const State start = state(1.0, 11.0, 0.0);
  const Flight flight = flights.record(start, third);
  ASSERT_EQ(flight.segments.size(), 3U);
  EXPECT_EQ(flight.segments[0].mode, 2);
  EXPECT_EQ(flight.segments[0].length_m, 5.0);
  EXPECT_EQ(flight.segments[1].mode, 0);
  EXPECT_EQ(flight.segments[2].mode, 0);
  for (std::size_t i = 1; i < flight.segments.size(); ++i) {
    const FlightSegment& before = flight.segments[i - 1];
    const State end = state_at(before, before.length_m);
    EXPECT_NEAR(norm(end.position_m - flight.segments[i].start.position_m), 0.0, 1e-12);
    EXPECT_NEAR(end.heading.rad(), flight.segments[i].start.heading.rad(), 1e-12);
  }
  // A straight line in two modes is two pieces, though its curvature is the same.
  ChangesAfter later(2, 2);
  const ModalFlights onwards(plan_of(30, 20, {0.0, pi / 2, 0.0}));
  const Flight straight = onwards.record(start, later);
  ASSERT_EQ(straight.segments.size(), 2U);
  EXPECT_EQ(straight.segments[0].mode, 2);
  EXPECT_EQ(straight.segments[1].mode, 0);
  ChangesAfter again(2, 2);
  const Flight measured = onwards.measure(start, again);
  EXPECT_EQ(measured.turning, straight.turning);
  EXPECT_TRUE(measured.segments.empty());
}

/// Random commands in every mode, walls, a goal; degenerate commands on purpose.
Plan random_modal_plan(std::uint64_t seed) {
  static constexpr std::array<double, 8> odd{0.0, pi / 2, -pi / 2, pi, pi / 4, 1e-8, -1e-4, 3.1};
  Random random = Random::stream(0x30de, seed);
  Plan plan =
      plan_of(6 + static_cast<int>(random.below(12)), 6 + static_cast<int>(random.below(12)),
              std::vector<double>(2 + random.below(4), 0.0));
  plan.grid.x0_m = random.uniform(-100.0, 100.0);
  plan.vehicle.turn_radius_m = 2.0 / random.uniform(0.2, 0.99);
  const auto draw = [&](double smooth) {
    return random.below(4) == 0 ? odd[random.below(odd.size())]
                                : smooth + random.uniform(-0.6, 0.6);
  };
  const double way = random.uniform(-pi, pi);
  for (float& h : plan.heading_rad) h = Heading::stored(draw(way));
  for (std::size_t i = 0; i < plan.mode_heading_rad.size(); ++i) {
    const double turn = static_cast<double>(1 + i / plan.grid.size());
    plan.mode_heading_rad[i] = Heading::stored(draw(way + 1.7 * turn));
    if (random.below(40) == 0) plan.mode_heading_rad[i] = std::numeric_limits<float>::quiet_NaN();
  }
  for (Region& region : plan.region) {
    const std::uint64_t kind = random.below(16);
    if (kind == 0) region = Region::goal;
    if (kind == 1) region = Region::obstacle;
  }
  return plan;
}

State random_start(const Plan& plan, Random& random) {
  const auto place = [&](double x0, int n) {
    const double line =
        x0 + static_cast<double>(random.below(static_cast<std::uint64_t>(n) + 1)) * 2.0;
    return random.below(4) == 0 ? line : random.uniform(x0, x0 + n * 2.0);
  };
  const double heading = random.below(4) == 0 ? static_cast<double>(random.below(4)) * (pi / 2)
                                              : random.uniform(-pi, pi);
  const double x = place(plan.grid.x0_m, plan.grid.nx);
  return state(x, place(plan.grid.y0_m, plan.grid.ny), heading);
}

bool same(const FlightSegment& a, const FlightSegment& b) {
  return a.start.position_m == b.start.position_m && a.start.heading == b.start.heading &&
         a.time_s == b.time_s && a.length_m == b.length_m &&
         a.curvature_per_m == b.curvature_per_m && a.mode == b.mode;
}

TEST(ModalFlight, IsTheExactFlightToTheBitWhereItBeginsInModeZero) {
  Random random(11);
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const Plan plan = random_modal_plan(seed);
    const ModalFlights modal(plan);
    const ExactFlights exact(plan);
    for (int i = 0; i < 50; ++i) {
      const State start = random_start(plan, random);
      ChangesAfter never(0, -1);
      const FlightRun run = exact.run(start);
      const ModalRun flown = modal.run(start, never);
      ASSERT_EQ(flown.run.result.outcome, run.result.outcome);
      ASSERT_EQ(flown.run.result.length_m, run.result.length_m);
      ASSERT_EQ(flown.run.crossings, run.crossings);
      ASSERT_TRUE(never.crossings.empty());
      const Flight a = modal.record(start, never);
      const Flight b = exact.record(start);
      ASSERT_EQ(a.segments.size(), b.segments.size());
      ASSERT_TRUE(std::equal(a.segments.begin(), a.segments.end(), b.segments.begin(), same));
      ASSERT_EQ(a.turning, b.turning);
    }
  }
}

TEST(ModalFlight, FliesTheModesOwnCommandsUntilItChanges) {
  Random random(12);
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const Plan plan = random_modal_plan(seed);
    const ModalFlights modal(plan);
    for (int i = 0; i < 50; ++i) {
      const State start = random_start(plan, random);
      const int k = 1 + static_cast<int>(random.below(plan.further_modes()));
      ChangesAfter never(k, -1);
      const FlightRun flown = modal.run(start, never, {0.0, 400}).run;
      const FlightRun alone = ExactFlights(plan, k).run(start);
      // Alone it may have taken a weave in one leap, which is the same but for rounding.
      if (flown.ended_by == EndedBy::crossing_limit) continue;
      ASSERT_EQ(flown.result.outcome, alone.result.outcome);
      if (alone.result.outcome == Outcome::trapped) continue;
      ASSERT_NEAR(flown.result.length_m, alone.result.length_m, 1e-9 * alone.result.length_m);
    }
  }
}

TEST(ModalFlight, WeavesInOneLeapAsFarAsItMayUnasked) {
  Plan plan = plan_of(12, 4, {0.0, 0.0});
  for (int ix = 0; ix < 12; ++ix) {
    for (int iy = 0; iy < 4; ++iy) {
      plan.mode_heading_rad[plan.grid.index({ix, iy})] = iy < 2 ? 0.01F : -0.01F;
    }
  }
  const ModalFlights modal(plan);
  const State start = state(1.0, 4.0, 0.004);
  const FlightRun alone = ExactFlights(plan, 1).run(start);
  // A wave of two hops is 4 r sin(0.004) = 0.08 m long, and 22 m are to be flown.
  ChangesAfter everywhere(1, -1);
  const ModalRun asked = modal.run(start, everywhere);
  EXPECT_EQ(asked.run.result.outcome, Outcome::leave);
  EXPECT_NEAR(asked.run.result.length_m, alone.result.length_m, 1e-9);
  EXPECT_GT(everywhere.crossings.size(), 400U);
  ChangesAfter freely(1, -1);
  freely.most_weave_m = std::numeric_limits<double>::infinity();
  const ModalRun unasked = modal.run(start, freely);
  EXPECT_EQ(unasked.run.result.length_m, alone.result.length_m);
  EXPECT_EQ(unasked.run.crossings, alone.crossings);
  EXPECT_LT(unasked.run.crossings, 200U);
  // Half a metre at most between two questions.
  ChangesAfter half(1, -1);
  half.most_weave_m = 0.5;
  EXPECT_NEAR(modal.run(start, half).run.result.length_m, alone.result.length_m, 1e-9);
  for (std::size_t i = 1; i < half.crossings.size(); ++i) {
    const double moved_m =
        half.crossings[i].state.position_m.x - half.crossings[i - 1].state.position_m.x;
    ASSERT_LT(moved_m, 0.5 + 0.08);
  }
  EXPECT_GT(half.crossings.size(), 44U);
  EXPECT_LT(half.crossings.size(), everywhere.crossings.size());
}

std::string text_of(const ModeSequence& modes) {
  std::string text = std::to_string(modes.begin);
  for (const ModeChange& change : modes.changes) {
    text += " after " + std::to_string(change.borders) + " " + std::to_string(change.mode);
  }
  return text;
}

/// The first mode, and its first border, from where an earlier one reaches; by flying all of them.
ModeSequence by_flying_all(const ModalFlights& flights, const State& start) {
  ChangesAfter own(0, -1);
  if (flights.run(start, own).run.ended_by == EndedBy::goal) return {};
  for (int k = 1; k < flights.modes(); ++k) {
    ChangesAfter never(k, -1);
    never.most_weave_m = std::numeric_limits<double>::infinity();
    const bool reaches = flights.run(start, never).run.ended_by == EndedBy::goal;
    const std::size_t borders = std::min<std::size_t>(never.crossings.size(), 2000);
    for (std::size_t n = 1; n <= borders; ++n) {
      for (int second = 0; second < k; ++second) {
        ChangesAfter nth(k, static_cast<int>(n), second);
        nth.most_weave_m = never.most_weave_m;
        const ModalRun flown = flights.run(start, nth);
        if (flown.last_mode == second && flown.run.ended_by == EndedBy::goal) {
          return {k, {{static_cast<std::uint64_t>(n), second}}};
        }
      }
    }
    if (reaches) return {k, {}};
  }
  return {-1, {}};
}

TEST(ModalFlight, FindsTheFirstModeAndItsFirstBorderFromWhereItArrives) {
  Random random(13);
  std::array<int, 3> kinds{};  // mode 0, one change, none with one change
  int more = 0;
  for (std::uint64_t seed = 0; seed < 600; ++seed) {
    const Plan plan = random_modal_plan(seed);
    const ModalFlights flights(plan);
    for (int i = 0; i < 12; ++i) {
      const State start = random_start(plan, random);
      const ModeSequence expected = by_flying_all(flights, start);
      const ModeSequence found = flights.find_modes(start, 10000000);
      if (expected.begin >= 0) {
        ASSERT_EQ(found, expected)
            << seed << " " << i << ": " << text_of(found) << " instead of " << text_of(expected);
      } else {
        ASSERT_TRUE(found.changes.size() > 1 || found == ModeSequence{});
      }
      ++kinds[expected.begin < 0 ? 2U : expected.begin == 0 ? 0U : 1U];
      if (found == ModeSequence{}) continue;
      more += found.changes.size() > 1 ? 1 : 0;
      GivenModes given(found);
      const ModalRun flown = flights.run(start, given);
      ASSERT_EQ(flown.run.result.outcome, Outcome::reach);
      ASSERT_EQ(flown.run.result.mode, found.begin);
      ASSERT_EQ(static_cast<std::size_t>(flown.changes), found.changes.size());
      // The same decider again, and with pieces: their length is that of the flight.
      const Flight flight = flights.record(start, given);
      ASSERT_EQ(flight.result.length_m, flown.run.result.length_m);
      double length_m = 0.0;
      for (const FlightSegment& piece : flight.segments) length_m += piece.length_m;
      // A leap over a weave is kept as a straight piece.
      ASSERT_NEAR(length_m, flight.result.length_m, 1e-6 * (1.0 + length_m));
    }
  }
  EXPECT_GT(kinds[0], 50);
  EXPECT_GT(kinds[1], 50);
  EXPECT_GT(kinds[2], 20);
  EXPECT_GT(more, 5);
}

TEST(ModalFlight, FindsNothingWithoutTrialsAndNeverWhatDoesNotArrive) {
  Random random(14);
  int given_up = 0;
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    const Plan plan = random_modal_plan(seed);
    const ModalFlights flights(plan);
    for (int i = 0; i < 30; ++i) {
      const State start = random_start(plan, random);
      EXPECT_EQ(flights.find_modes(start, 0), ModeSequence{});
      const ModeSequence found = flights.find_modes(start, random.below(300));
      if (found == ModeSequence{}) {
        given_up += flights.find_modes(start) == ModeSequence{} ? 0 : 1;
        continue;
      }
      GivenModes given(found);
      ASSERT_EQ(flights.run(start, given).run.result.outcome, Outcome::reach);
    }
  }
  EXPECT_GT(given_up, 10);
}

TEST(ModalFlight, GoesOnInModeZeroBeyondTheFirstGoalCell) {
  Plan plan = plan_of(30, 20, {0.0, pi / 2});
  for (int ix = 0; ix < 30; ++ix) plan.region[plan.grid.index({ix, 5})] = Region::goal;
  const ModalFlights flights(plan);
  ChangesAfter never(1, -1);
  const Flight flight = flights.follow_on(state(11.0, 1.0, pi / 2), never, {.length_m = 12.0});
  EXPECT_EQ(flight.result.outcome, Outcome::reach);
  EXPECT_NEAR(flight.result.length_m, 9.0, 1e-12);
  EXPECT_EQ(flight.onward.after, After::follow);
  EXPECT_NEAR(flight.onward.length_m, 21.0, 1e-12);
  ASSERT_GE(flight.segments.size(), 3U);
  EXPECT_EQ(flight.segments.front().mode, 1);
  EXPECT_EQ(flight.segments.back().mode, 0);
  EXPECT_NEAR(end_of(flight).heading.rad(), 0.0, 1e-12);
}

TEST(ModalFlight, RefusesModesThatAreNotThereAndModesThatGoUp) {
  const Plan plan = plan_of(30, 20, {0.0, pi / 2, pi});
  const ModalFlights flights(plan);
  const State start = state(11.0, 1.0, pi / 2);
  for (const int first : {-1, 3}) {
    ChangesAfter wrong(first, -1);
    EXPECT_THROW(static_cast<void>(flights.run(start, wrong)), PreconditionViolation);
  }
  const ModeSequence upwards{1, {{2, 2}}};
  GivenModes given(upwards);
  EXPECT_THROW(static_cast<void>(flights.run(start, given)), PreconditionViolation);
  EXPECT_THROW(ExactFlights(plan, 3), PreconditionViolation);
  Plan torn = plan;
  torn.mode_heading_rad.pop_back();
  EXPECT_THROW(ModalFlights{torn}, PreconditionViolation);
}

}  // namespace
}  // namespace fairway
