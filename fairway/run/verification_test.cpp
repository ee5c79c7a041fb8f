// Going on from an earlier certificate: of the same proof alone, and only with what is true of it.
#include "fairway/run/verification.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "fairway/base/error.hpp"
#include "fairway/certificate/proof_identity.hpp"
#include "fairway/verify/testing/plans_to_verify.hpp"

namespace fairway {
namespace {

Plan sample_plan() {
  Plan plan = random_plan(11);
  plan.record.frame = Frame{{1.0, 2.0, 0.25}, GeoReference{47.0, 8.0, 0.5}, {}};
  return plan;
}

Verification verified(const Plan& plan, const RegionOfInterest& region = {},
                      std::optional<EarlierProof> earlier = {}) {
  CertifyOptions options;
  options.samples = 1000;
  options.last_level = 6;
  options.undecided_max = 0.0;
  return verify_plan(plan, "the plan", region, options, std::move(earlier));
}

std::string refusal(const Plan& plan, const RegionOfInterest& region, const Certificate& earlier) {
  try {
    (void)verified(plan, region, EarlierProof{earlier, "old.cert"});
    return "";
  } catch (const InputError& error) {
    return error.what();
  }
}

TEST(Resume, GoesOnFromTheSameProofAlone) {
  const Plan plan = sample_plan();
  const Certificate earlier = verified(plan).certificate;
  EXPECT_EQ(proof_identity(earlier), proof_identity(plan, {}));
  EXPECT_EQ(refusal(plan, {}, earlier), "");
  const auto expect_refused = [&](const Plan& other, const RegionOfInterest& region) {
    EXPECT_EQ(refusal(other, region, earlier),
              "old.cert: belongs to a different plan, vehicle or region; cannot resume from it");
    EXPECT_NE(proof_identity(other, region), proof_identity(earlier));
  };
  Plan other = plan;
  other.vehicle.speed_mps *= 0.5;
  expect_refused(other, {});
  other = plan;
  other.vehicle.turn_radius_m *= 1.25;
  expect_refused(other, {});
  other = plan;
  other.grid.cell_m *= 0.5;
  expect_refused(other, {});
  other = plan;
  other.grid.x0_m += 1.0;
  expect_refused(other, {});
  other = plan;
  other.record.frame->world_from_grid.x_m = 5000.0;
  expect_refused(other, {});
  other = plan;
  other.cost_m[0] += 1.0F;
  expect_refused(other, {});
  other = plan;
  std::swap(other.grid.nx, other.grid.ny);  // the same bytes, another grid
  expect_refused(other, {});
  expect_refused(plan, {RegionOfInterest::Kind::obstacle, {}});
  expect_refused(plan, {RegionOfInterest::Kind::rectangle, {0.0, 0.0, 1.0, 1.0}});
}

TEST(Resume, TakesOverOnlyWhatIsProvedAgain) {
  const Plan plan = sample_plan();
  const Certificate honest = verified(plan).certificate;
  Certificate forged = honest;
  for (std::size_t i = 0; i < forged.sections.leaves(); ++i) {
    forged.sections.verdict[i] = static_cast<std::uint8_t>(Verdict::reach);
    forged.sections.rank[i] = 0;
    forged.sections.time_s[i] = 0.5F;
  }
  const Certificate again = verified(plan, {}, EarlierProof{forged, "forged"}).certificate;
  std::size_t reaches = 0;
  for (const std::uint8_t verdict : again.sections.verdict) reaches += verdict == 1 ? 1 : 0;
  EXPECT_LT(reaches, again.sections.leaves());
  const SectionVerdicts& a = again.sections;
  const SectionVerdicts& b = honest.sections;
  ASSERT_EQ(a.begin, b.begin);  // the same leaves, each as it was proved at first, or later
  for (std::size_t i = 0; i < a.leaves(); ++i) {
    if (a.verdict[i] != 0 && b.verdict[i] != 0) {
      ASSERT_EQ(a.verdict[i], b.verdict[i]);
    }
  }
}

TEST(Resume, SaysHowManyLeavesItDropped) {
  const Plan plan = sample_plan();
  const Certificate honest = verified(plan).certificate;
  const auto undecided = [](const Certificate& c) {
    return static_cast<std::size_t>(
        std::count(c.sections.verdict.begin(), c.sections.verdict.end(), 0));
  };
  const std::size_t decided = honest.sections.leaves() - undecided(honest);
  const auto kept = verified(plan, {}, EarlierProof{honest, "old"}).resumed;
  ASSERT_TRUE(kept);
  EXPECT_EQ(kept->decided, decided);
  EXPECT_EQ(kept->dropped, 0U);
  EXPECT_EQ(resumed_words(*kept),
            "All " + std::to_string(decided) + " decided leaves of old were proved again.");
  Certificate forged = honest;
  std::size_t lies = 0;  // a bound of no time from a leaf that takes some
  for (std::size_t i = 0; i < forged.sections.leaves(); ++i) {
    if (forged.sections.verdict[i] != static_cast<std::uint8_t>(Verdict::reach)) continue;
    forged.sections.time_s[i] = 0.0F;
    ++lies;
  }
  ASSERT_GT(lies, 0U);
  const auto dropped = verified(plan, {}, EarlierProof{forged, "forged"}).resumed;
  EXPECT_EQ(dropped->dropped, lies);
  EXPECT_TRUE(dropped->in_time);
  EXPECT_EQ(resumed_words(*dropped), "Of " + std::to_string(decided) +
                                         " decided leaves of forged, " + std::to_string(lies) +
                                         " were dropped: they could not be proved again.");
  EXPECT_FALSE(verified(plan).resumed);
}

TEST(Resume, TheTimeLimitHoldsForProvingAgain) {
  const Plan plan = sample_plan();
  const Certificate honest = verified(plan).certificate;
  CertifyOptions options;
  options.samples = 1000;
  options.time_limit_s = 1e-9;
  const Verification made = verify_plan(plan, "the plan", {}, options, EarlierProof{honest, "old"});
  EXPECT_EQ(made.resumed->dropped, made.resumed->decided);
  EXPECT_FALSE(made.resumed->in_time);
  EXPECT_EQ(made.outcome.stopped_by, StoppedBy::time_limit);
  EXPECT_THAT(resumed_words(*made.resumed),
              testing::HasSubstr("the time limit left no time to prove them again"));
}

TEST(Resume, RefusesLeavesWhereThereCanBeNone) {
  const Plan plan = sample_plan();
  Certificate earlier = verified(plan).certificate;
  for (std::size_t s = 0; s + 1 < earlier.sections.first.size(); ++s) {
    earlier.sections.first[s] = 0;
  }
  EXPECT_THAT(refusal(plan, {}, earlier),
              testing::HasSubstr("has leaves where the plan allows none"));
}

}  // namespace
}  // namespace fairway
