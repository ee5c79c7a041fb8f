#include "fairway/identify/kept_contract.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "fairway/identify/fitted_contract.hpp"
#include "fairway/identify/nearest_motion.hpp"
#include "fairway/identify/testing/made_log.hpp"

namespace fairway {
namespace {

/// That of the made vehicle, with the distance that the log may be away.
VehicleContract contract_of(const MadeVehicle& v, double tracking_m) {
  VehicleContract c;
  c.command_error_m = v.speed_mps * v.delay_s + tracking_m;
  c.heading_error_rad = v.heading_error_rad;
  c.turn_radius_m = {v.radius_least_m, v.radius_most_m};
  c.speed_mps = {0.95 * v.speed_mps, 1.05 * v.speed_mps};
  c.side_uncertain_rad = v.speed_mps * v.delay_s / v.radius_least_m;
  return c;
}

FlownTrack track_of(const FlightLog& log, const MadeVehicle& v) {
  return flown_track(log, v.radius_least_m / 8.0);
}

TEST(KeptContract, TheContractThatTheVehicleWasMadeByIsKept) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    MadeVehicle v;
    v.delay_s = 0.1 * static_cast<double>(seed % 5);
    v.radius_least_m = 60.0 - static_cast<double>(seed);
    v.heading_error_rad = 0.002 * static_cast<double>(seed % 4);
    const double tracking_m = 0.03 * v.radius_least_m;
    const FlightLog log = made_log(v, 200.0, seed);
    const KeptContract kept =
        kept_contract(track_of(log, v), contract_of(v, tracking_m), tracking_m);
    EXPECT_TRUE(kept.kept) << seed;
    EXPECT_LE(kept.needs_m, tracking_m) << seed;
    EXPECT_FALSE(kept.wrong_speed) << seed;
    EXPECT_EQ(kept.motion_m.size(), log.samples.size()) << seed;
  }
}

TEST(KeptContract, TheMotionShownStaysAsNearAsIsSaid) {
  const MadeVehicle v;
  const FlightLog log = made_log(v, 120.0, 5);
  const KeptContract kept = kept_contract(track_of(log, v), contract_of(v, 3.0), 3.0);
  ASSERT_TRUE(kept.kept);
  double farthest_m = 0.0;
  for (std::size_t i = 0; i < log.samples.size(); ++i) {
    farthest_m = std::max(farthest_m, norm(kept.motion_m[i] - log.samples[i].place_m));
  }
  EXPECT_NEAR(farthest_m, kept.needs_m, 1e-9);
}

TEST(KeptContract, TheMotionShownNeverTurnsFasterThanOnTheLeastCircle) {
  const MadeVehicle v;
  const FlightLog log = made_log(v, 120.0, 6);
  const VehicleContract contract = contract_of(v, 3.0);
  const KeptContract kept = kept_contract(track_of(log, v), contract, 3.0);
  for (std::size_t i = 2; i < kept.motion_m.size(); ++i) {
    const Vec2 before = kept.motion_m[i - 1] - kept.motion_m[i - 2];
    const Vec2 after = kept.motion_m[i] - kept.motion_m[i - 1];
    const double turn_rad = std::abs(Heading::of(before).turn_to(Heading::of(after)));
    // Between two chords: half of each step's turn.
    const double most_rad = 0.5 * (norm(before) + norm(after)) / contract.turn_radius_m.least;
    EXPECT_LE(turn_rad, 1.001 * most_rad + 1e-9) << i;
  }
}

TEST(KeptContract, ACommandThatIsIgnoredIsFoundWhenItWasGiven) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    MadeVehicle v;
    const FlightLog obeyed = made_log(v, 200.0, seed);
    // The first command after 100 s that asks for a real turn.
    std::size_t given = 1000;
    while (std::abs(obeyed.samples[given].command.turn_to(obeyed.samples[given - 1].command)) < 0.8)
      ++given;
    v.ignores_from_s = obeyed.samples[given].time_s - v.period_s - 0.01;
    v.ignores_to_s = v.ignores_from_s + 8.0;
    const FlightLog log = made_log(v, 200.0, seed);
    const KeptContract kept = kept_contract(track_of(log, v), contract_of(v, 3.0), 3.0);
    EXPECT_FALSE(kept.kept) << seed;
    EXPECT_GT(kept.needs_m, 6.0) << seed;
    const double until_s = log.samples[kept.kept_until].time_s;
    EXPECT_GT(until_s, v.ignores_from_s) << seed;
    EXPECT_LT(until_s, v.ignores_to_s) << seed;
  }
}

TEST(KeptContract, AContractTooTightInAnyOneNumberIsNotKept) {
  MadeVehicle v;
  v.delay_s = 1.0;
  v.heading_error_rad = 0.06;
  v.radius_least_m = 50.0;
  v.radius_most_m = 70.0;
  const double tracking_m = 1.5;
  const FlownTrack track = track_of(made_log(v, 300.0, 7), v);
  const VehicleContract whole = contract_of(v, tracking_m);
  ASSERT_TRUE(kept_contract(track, whole, tracking_m).kept);
  VehicleContract quick = whole;
  quick.command_error_m = 0.4 * whole.command_error_m;
  EXPECT_FALSE(kept_contract(track, quick, tracking_m).kept);
  VehicleContract narrow = whole;
  narrow.turn_radius_m = {59.0, 61.0};
  EXPECT_FALSE(kept_contract(track, narrow, tracking_m).kept);
  VehicleContract straight = whole;
  straight.heading_error_rad = 0.0;
  EXPECT_FALSE(kept_contract(track, straight, tracking_m).kept);
}

TEST(KeptContract, AWiderContractIsKeptWhereATighterOneIs) {
  for (std::uint64_t seed = 20; seed < 26; ++seed) {
    const MadeVehicle v;
    const FlownTrack track = track_of(made_log(v, 120.0, seed), v);
    const VehicleContract tight = contract_of(v, 2.0);
    VehicleContract wide = tight;
    wide.command_error_m *= 1.5;
    wide.heading_error_rad *= 2.0;
    wide.turn_radius_m = {0.9 * tight.turn_radius_m.least, 1.1 * tight.turn_radius_m.most};
    ASSERT_TRUE(kept_contract(track, tight, 2.0).kept) << seed;
    EXPECT_TRUE(kept_contract(track, wide, 2.0).kept) << seed;
  }
}

TEST(KeptContract, TheContractsRuleOfSidesAllowsNoMoreThanASideForEachCommand) {
  for (std::uint64_t seed = 40; seed < 46; ++seed) {
    MadeVehicle v;
    v.most_turn_rad = 3.1;
    v.longest_s = 6.0;
    const FlownTrack track = track_of(made_log(v, 100.0, seed), v);
    const VehicleContract contract = contract_of(v, 2.0);
    const bool held = kept_contract(track, contract, 2.0, SideRule::contract).kept;
    EXPECT_TRUE(held) << seed;
    EXPECT_GE(kept_contract(track, contract, 2.0, SideRule::each_command).kept, held) << seed;
  }
}

TEST(KeptContract, AShorterSideTakenAtEachCommandBreaksTheContractsRuleAlone) {
  // A turn to the left to a command behind, and before it is there, one behind to the right.
  MadeVehicle v;
  v.forgets_sides = true;
  v.most_turn_rad = 3.1;
  v.longest_s = 6.0;
  const FlownTrack track = track_of(made_log(v, 200.0, 47), v);
  const VehicleContract contract = contract_of(v, 2.0);
  EXPECT_TRUE(kept_contract(track, contract, 2.0, SideRule::each_command).kept);
  EXPECT_FALSE(kept_contract(track, contract, 2.0, SideRule::contract).kept);
}

TEST(KeptContract, AFlightFasterThanTheContractIsReportedBesideItsPlaces) {
  const MadeVehicle v;
  const FlownTrack track = track_of(made_log(v, 120.0, 3), v);
  VehicleContract slow = contract_of(v, 3.0);
  slow.speed_mps = {10.0, 15.0};
  const KeptContract kept = kept_contract(track, slow, 3.0);
  EXPECT_TRUE(kept.kept);
  EXPECT_TRUE(kept.wrong_speed);
}

TEST(FittedContract, TheVehiclesOwnNumbersAreRecoveredWithinBounds) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    MadeVehicle v;
    v.delay_s = 0.6;
    v.heading_error_rad = 0.02;
    std::vector<FlownTrack> tracks;
    for (std::uint64_t k = 0; k < 2; ++k)
      tracks.push_back(track_of(made_log(v, 150.0, 10 * seed + k), v));
    const double tracking_m = 1.2;
    Decider broken;
    const auto fit = fitted_contract(tracks, {tracking_m, 60.0}, broken);
    ASSERT_TRUE(fit) << seed;
    const VehicleContract own = contract_of(v, tracking_m);
    EXPECT_LE(contract_cost(fit->contract, 60.0), 1.1 * contract_cost(own, 60.0)) << seed;
    // A turn may begin earlier by what the tracking distance hides of it.
    EXPECT_GT(fit->contract.command_error_m, 0.4 * v.speed_mps * v.delay_s) << seed;
    EXPECT_LT(fit->contract.command_error_m, 1.6 * own.command_error_m) << seed;
    EXPECT_GT(fit->contract.turn_radius_m.least, 0.85 * v.radius_least_m) << seed;
    EXPECT_LT(fit->contract.turn_radius_m.most, 1.15 * v.radius_most_m) << seed;
    for (const FlownTrack& track : tracks) {
      EXPECT_TRUE(nearest_motion(track, fit->contract, {.limit_m = tracking_m}).stays) << seed;
    }
  }
}

TEST(FittedContract, OfAVehicleThatFliesElsewhereThereIsNone) {
  MadeVehicle v;
  v.longest_s = 80.0;
  v.ignores_from_s = 20.0;
  v.ignores_to_s = 1000.0;
  const FlownTrack track = track_of(made_log(v, 400.0, 4), v);
  Decider broken;
  EXPECT_FALSE(fitted_contract({track}, {2.0, 60.0}, broken));
  EXPECT_GT(track.time_s[broken.sample], 20.0);
}

TEST(NearestMotion, TheResultIsTheSameEveryTime) {
  const MadeVehicle v;
  const FlownTrack track = track_of(made_log(v, 60.0, 9), v);
  const MotionSearch search{.limit_m = 2.0, .wants_places = true};
  const NearestMotion once = nearest_motion(track, contract_of(v, 2.0), search);
  const NearestMotion again = nearest_motion(track, contract_of(v, 2.0), search);
  EXPECT_EQ(once.place_m, again.place_m);
  EXPECT_EQ(once.farthest_m, again.farthest_m);
}

}  // namespace
}  // namespace fairway
