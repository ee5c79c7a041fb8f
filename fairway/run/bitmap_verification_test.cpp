#include "fairway/run/bitmap_verification.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fairway/base/error.hpp"
#include "fairway/run/ask_bitmap.hpp"
#include "fairway/run/ask_certificate.hpp"
#include "fairway/simulate/exact_flight.hpp"
#include "fairway/verify/testing/plans_to_verify.hpp"

namespace fairway {
namespace {

TEST(DrawBitmap, EstimatesTheShareOfTheCellsItRecords) {
  const Plan plan = random_plan(11);
  const BitmapVerification drawn = draw_bitmap(plan, "p", {}, 20, 3);
  const nlohmann::json summary = verification_json(drawn);
  EXPECT_EQ(summary["options"]["samples_per_border"], 20);
  EXPECT_EQ(summary["region_of_interest"], "goal");
  EXPECT_EQ(summary["estimated_reach"], drawn.estimated_reach);
  EXPECT_EQ(summary["proved"], false);
  EXPECT_GT(drawn.estimated_reach, 0.0);
  EXPECT_LT(drawn.estimated_reach, 1.0);
  EXPECT_THAT(verification_words(drawn), testing::HasSubstr("not a proof"));
}

TEST(DrawBitmap, AtAHeadingSaysWhatExactFlightsDoInNearlyEveryCell) {
  const Plan plan = random_plan(11);
  const Bitmap bitmap = draw_bitmap(plan, "p", {}, 200, 1).bitmap;
  const ExactFlights flights(plan);
  const Heading heading = Heading::from_rad(0.8);
  const std::vector<Sampled> answers = sampled_at(bitmap, heading);
  const std::vector<State> states = states_asked_at(plan.grid, heading);
  std::size_t decided = 0;
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (answers[i] == Sampled::undecided) continue;
    ++decided;
    const bool reaches = flights.fly(states[i]).outcome == Outcome::reach;
    wrong += reaches == (answers[i] == Sampled::reach) ? 0 : 1;
  }
  EXPECT_GT(10 * decided, 8 * states.size());
  EXPECT_LE(50 * wrong, decided);
}

TEST(DrawBitmap, RefusesCellsThatAreNotSmallerThanATurn) {
  Plan plan = random_plan(11);
  plan.vehicle.turn_radius_m = plan.grid.cell_m;
  EXPECT_THROW((void)draw_bitmap(plan, "p", {}, 20, 3), InputError);
}

}  // namespace
}  // namespace fairway
