#include "fairway/run/following_summary.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace fairway {
namespace {

struct Sample {
  ManyFlights flown;
  std::optional<FollowingSummary> summary() const {
    return following_summary(flown, flown.results, flown.measures);
  }
};

/// Four flights that reach, of which one collides, one leaves and one never joins; one that does
/// not reach; one that is trapped.
Sample sample() {
  Sample s;
  s.flown.followed = {one_lap, 5.0, 0.5, {}};
  const auto add = [&](FlightResult result, After after, double joined_s, double measured_s,
                       double share, double mean_m) {
    FlightMeasures m;
    m.turning = {200.0, 4.0, 6, 1.0};
    m.onward.after = after;
    m.following.joined_s = joined_s;
    m.following.measured_s = measured_s;
    m.following.on_path_share = share;
    m.following.distance_mean_m = mean_m;
    s.flown.results.push_back(result);
    s.flown.measures.push_back(m);
  };
  const double never = PathFollowing{}.joined_s;
  add({Outcome::reach, 1.0, 10.0}, After::follow, 2.0, 30.0, 1.0, 1.0);
  add({Outcome::reach, 1.0, 10.0}, After::collide, 4.0, 10.0, 0.5, 3.0);
  add({Outcome::reach, 1.0, 10.0}, After::leave, never, 0.0, 0.0, 0.0);
  add({Outcome::reach, 1.0, 10.0}, After::follow, 9.0, 10.0, 0.0, 6.0);
  add({Outcome::collide, 1.0, 10.0}, After::none, never, 0.0, 0.0, 0.0);
  add({Outcome::trapped, 1.0, 10.0}, After::none, never, 0.0, 0.0, 0.0);
  s.flown.measures.back().turning = {100.0, 1e6, 9'999'999, 1.0};
  for (int i = 0; i < 100; ++i) s.flown.followed->spreads.distance_m.add(i < 95 ? 2.0 : 8.0);
  return s;
}

TEST(FollowingSummary, CountsWhatComesAfterReachingAndWeighsByTime) {
  const auto found = sample().summary();
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->reach, 4U);
  EXPECT_EQ(found->collide_after, 1U);
  EXPECT_EQ(found->leave_after, 1U);
  EXPECT_EQ(found->joined, 3U);
  EXPECT_EQ(found->time_to_join_s.worst, 9.0);
  EXPECT_DOUBLE_EQ(found->on_path_share, (30.0 + 5.0) / 50.0);
  EXPECT_DOUBLE_EQ(found->distance_m.mean, (30.0 + 30.0 + 60.0) / 50.0);
  EXPECT_NEAR(found->distance_m.p95, 2.0, 2.0 / 64);
  EXPECT_EQ(found->distance_m.worst, 8.0);
  const auto json = following_json(found);
  EXPECT_EQ(json["after"], (nlohmann::json{{"follow", 2}, {"collide", 1}, {"leave", 1}}));
  EXPECT_EQ(json["laps"], 1.0);
  EXPECT_TRUE(json["time_s"].is_null());
  EXPECT_TRUE(json["heading_difference_rad"].is_null());  // nothing was pooled
  const std::string words = following_words(found);
  EXPECT_NE(words.find("Followed for 1 lap after they reach the path, 1 of these 4 collide and 1 "
                       "leave the map."),
            std::string::npos)
      << words;
  EXPECT_NE(words.find("3 join the path (within 5 m and 0.5 rad)"), std::string::npos) << words;
}

TEST(FollowingSummary, SaysWhenNoneJoinsAndNothingWhenNoneReaches) {
  Sample s = sample();
  for (FlightMeasures& m : s.flown.measures) m.following = {};
  EXPECT_NE(following_words(s.summary()).find("None ever gets onto the path"), std::string::npos);
  for (FlightResult& r : s.flown.results) r.outcome = Outcome::leave;
  EXPECT_EQ(following_words(s.summary()), "");
  EXPECT_TRUE(following_json(s.summary())["on_path_share"].is_null());
  s.flown.followed.reset();
  EXPECT_TRUE(following_json(s.summary()).is_null());
}

TEST(FollowingSummary, LeavesFlightsThatNeverEndOutOfTurning) {
  const Sample s = sample();
  const TurningSummary turning = turning_summary(s.flown.results, s.flown.measures);
  EXPECT_EQ(turning.reversals, (Spread{5, 6.0, 6.0, 6.0}));
  EXPECT_DOUBLE_EQ(turning.reversals_per_100m.mean, 3.0);
  EXPECT_DOUBLE_EQ(turning.turned_rad_per_100m.worst, 2.0);
  EXPECT_TRUE(turning_json(turning_summary({}, {}))["reversals"].is_null());
}

}  // namespace
}  // namespace fairway
