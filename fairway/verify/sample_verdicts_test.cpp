#include "fairway/verify/sample_verdicts.hpp"

#include <algorithm>
#include <numeric>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "fairway/base/error.hpp"
#include "fairway/field/direction_field.hpp"
#include "fairway/simulate/exact_flight.hpp"
#include "fairway/verify/certify.hpp"
#include "fairway/verify/images.hpp"
#include "fairway/verify/testing/plans_to_verify.hpp"
#include "fairway/verify/undecided_sections.hpp"

namespace fairway {
namespace {

SectionVerdicts proved(const PlanFlow& pf, int last_level = 7) {
  CertifyOptions options;
  options.undecided_max = 0.0;
  options.samples = 2000;
  options.last_level = last_level;
  return certify(pf.flow(), pf.is_free, options).sections;
}

VerdictMap map_of(const PlanFlow& pf, const SectionVerdicts& sections,
                  const VerdictMapOptions& options = {}) {
  return verdict_map_of({pf.flow(), sections.view(), 0, nullptr, {}}, options);
}

/// Random plans by number: every style of field, with and without obstacles and uncommanded cells.
class VerdictMapOf : public ::testing::TestWithParam<std::uint64_t> {};
INSTANTIATE_TEST_SUITE_P(RandomPlans, VerdictMapOf, ::testing::Range<std::uint64_t>(0, 18));

/// All commands east, the goal a wall of cells on the east side, one obstacle in the way.
Plan corridor() {
  Plan plan = empty_plan(12, 9, 8.0, 20.0);
  for (int iy = 0; iy < 9; ++iy) plan.region[plan.grid.index({11, iy})] = Region::goal;
  plan.region[plan.grid.index({6, 4})] = Region::obstacle;
  return plan;
}

TEST_P(VerdictMapOf, SaysOfEveryStateWhatTheCertificateSays) {
  const Plan plan = random_plan(GetParam());
  const PlanFlow pf(plan);
  const SectionVerdicts sections = proved(pf);
  const VerdictMap map = map_of(pf, sections);
  ASSERT_EQ(map.cells_per_sample, 1);
  ASSERT_EQ(map.heading_rad.size(), 8U);
  std::vector<Place> states;
  for (const double heading : map.heading_rad) {
    for (std::size_t i = 0; i < plan.grid.size(); ++i) {
      const Vec2 p = map.place_m(i);
      states.push_back({p.x, p.y, heading});
    }
  }
  const ImageStore images =
      state_images(pf.flow(), states, CertifyOptions{}.most_crossings, [] { return true; });
  for (std::size_t k = 0; k < states.size(); ++k) {
    if (map.kind[k % map.samples()] != CellKind::ordinary) continue;
    ASSERT_EQ(map.verdict[k], verdicts_of(images[k], sections.view()).only());
  }
}

TEST_P(VerdictMapOf, IsNeverContradictedByAFlight) {
  const Plan plan = random_plan(GetParam());
  const PlanFlow pf(plan);
  const VerdictMap map = map_of(pf, proved(pf));
  const ExactFlights flights(plan);
  for (std::size_t h = 0; h < map.heading_rad.size(); ++h) {
    for (std::size_t i = 0; i < map.samples(); ++i) {
      const Verdict verdict = map.verdict_at(h, i);
      if (verdict == Verdict::undecided) continue;
      const FlightResult flown =
          flights.fly({map.place_m(i), Heading::from_rad(map.heading_rad[h])});
      ASSERT_EQ(std::string(name_of(verdict)), name_of(flown.outcome));
    }
  }
}

TEST_P(VerdictMapOf, CountsEveryStateOfAnOrdinaryCellAndNoneOfOthers) {
  const Plan plan = random_plan(GetParam());
  const PlanFlow pf(plan);
  VerdictMapOptions options;
  options.states_per_sample = static_cast<int>(GetParam() % 40);
  const VerdictMap map = map_of(pf, proved(pf, 4), options);
  ASSERT_EQ(map.count.size(), plan.grid.size());
  for (std::size_t i = 0; i < map.samples(); ++i) {
    ASSERT_EQ(map.kind[i], pf.kind[i]);
    const int sum = std::accumulate(map.count[i].begin(), map.count[i].end(), 0);
    ASSERT_EQ(sum, (map.kind[i] == CellKind::ordinary ? options.states_per_sample : 0));
  }
}

TEST_P(VerdictMapOf, ACoarserOneIsTheFineOneAtTheMiddleCells) {
  const Plan plan = random_plan(GetParam());
  const PlanFlow pf(plan);
  const SectionVerdicts sections = proved(pf, 5);
  const VerdictMap fine = map_of(pf, sections);
  VerdictMapOptions options;
  options.most_across = 1 + static_cast<int>(GetParam() % 7);
  const VerdictMap coarse = map_of(pf, sections, options);
  ASSERT_TRUE(std::max(coarse.nx, coarse.ny) <= options.most_across);
  for (std::size_t i = 0; i < coarse.samples(); ++i) {
    const Cell cell = coarse.cell_of_sample(i);
    ASSERT_TRUE(plan.grid.contains(cell));
    const std::size_t same = plan.grid.index(cell);
    ASSERT_EQ(coarse.kind[i], fine.kind[same]);
    ASSERT_EQ(coarse.count[i], fine.count[same]);
    for (std::size_t h = 0; h < 8; ++h) {
      ASSERT_TRUE(coarse.verdict_at(h, i) == fine.verdict_at(h, same));
    }
  }
}

/// A random plan with further modes in four directions, and what is proved of all.
struct WithModes {
  static constexpr int further = 4;
  Plan plan;
  PlanFlow pf;
  Certified made;

  explicit WithModes(std::uint64_t seed) : plan(planned(seed)), pf(plan) {
    CertifyOptions options;
    options.undecided_max = 0.0;
    options.samples = 2000;
    options.last_level = 6;
    made = certify(pf.flow(), pf.is_free, options, {}, {}, plan.further_rad());
  }
  ProofView view() const {
    return {pf.flow(), made.sections.view(), further, plan.mode_heading_rad.data(),
            made.further.view()};
  }

  static Plan planned(std::uint64_t seed) {
    Plan plan = random_plan(seed);
    for (int k = 0; k < further; ++k) {
      const std::vector<float> field =
          direction_field(plan.grid, plan.region, 0.3 + two_pi * k / further, 3 * plan.grid.cell_m);
      plan.mode_heading_rad.insert(plan.mode_heading_rad.end(), field.begin(), field.end());
      plan.record.modes.push_back({"direction", 0.3 + two_pi * k / further});
    }
    return plan;
  }
};

TEST(VerdictMap, NamesTheFirstModeThatIsProvedToReach) {
  std::vector<int> served(WithModes::further + 1);
  for (std::uint64_t seed = 0; seed < 18; ++seed) {
    const WithModes known(seed);
    const VerdictMap map = verdict_map_of(known.view(), {});
    ASSERT_EQ(map.modes, WithModes::further + 1);
    ASSERT_EQ(map.mode.size(), map.verdict.size());
    const VerdictMap alone = map_of(known.pf, known.made.sections);
    EXPECT_TRUE(alone.mode.empty());
    for (std::size_t k = 0; k < map.mode.size(); ++k) {
      const std::size_t i = k % map.samples();
      const std::uint8_t mode = map.mode[k];
      if (map.kind[i] != CellKind::ordinary) {
        ASSERT_EQ(mode, no_mode);
        continue;
      }
      const double heading = map.heading_rad[k / map.samples()];
      const auto reaches = [&](int asked) {
        const Vec2 p = map.place_m(i);
        return ask_mode(known.view(), asked, p.x, p.y, heading).only() == Verdict::reach;
      };
      ASSERT_EQ(map.verdict[k] == Verdict::reach, mode != no_mode);
      ASSERT_TRUE(mode == no_mode || reaches(mode));
      for (int earlier = 0; earlier < std::min<int>(mode, map.modes); ++earlier) {
        ASSERT_FALSE(reaches(earlier));
      }
      // Where none serves, the verdict is what the plan without modes does.
      if (mode == no_mode || mode == 0) {
        ASSERT_EQ(map.verdict[k], alone.verdict[k]);
      }
      if (mode != no_mode) ++served[mode];
    }
  }
  for (const int count : served) EXPECT_GT(count, 0);
}

TEST(VerdictMap, OfAMirroredPlanIsMirroredExceptForTheOffset) {
  Plan plan = corridor();             // its own mirror image about the middle row
  plan.vehicle.turn_radius_m = 22.3;  // quarter turns from the centres touch no row of cells
  const PlanFlow pf(plan);
  const VerdictMap map = map_of(pf, proved(pf, 9));
  int decided = 0;
  int other_way = 0;
  for (std::size_t h = 0; h < 8; ++h) {
    if (h == 4) continue;  // opposite to the commands: the offset decides which way to turn
    for (int iy = 0; iy < map.ny; ++iy) {
      for (int ix = 0; ix < map.nx; ++ix) {
        const Verdict one = map.verdict_at(h, map.index(ix, iy));
        const Verdict other = map.verdict_at((8 - h) % 8, map.index(ix, map.ny - 1 - iy));
        if (one == Verdict::undecided || other == Verdict::undecided) continue;
        ++decided;
        other_way += one == other ? 0 : 1;
      }
    }
  }
  EXPECT_GT(decided, 7 * 9 * 12 / 2);
  EXPECT_LT(other_way, decided / 50);
}

TEST(VerdictMap, OfStatesThatAreAlignedIsKnownByHand) {
  const Plan plan = corridor();
  const PlanFlow pf(plan);
  const VerdictMap map = map_of(pf, proved(pf));
  ASSERT_NEAR(map.heading_rad[0], 0.0, 0.001);
  for (int iy = 0; iy < 9; ++iy) {
    for (int ix = 0; ix < 11; ++ix) {
      if (iy == 4 && ix == 6) continue;
      EXPECT_EQ(map.verdict_at(0, map.index(ix, iy)),
                iy == 4 && ix < 6 ? Verdict::collide : Verdict::reach);
    }
  }
  EXPECT_EQ(map.kind[map.index(6, 4)], CellKind::obstacle);
  EXPECT_EQ(map.kind[map.index(11, 2)], CellKind::target);
}

TEST(VerdictMap, SamplesStatesCloseToTheCentresOfCells) {
  const Plan plan = corridor();
  const PlanFlow pf(plan);
  const VerdictMap map = map_of(pf, undecided_sections(pf.flow(), 2));
  for (std::size_t i = 0; i < map.samples(); ++i) {
    const Vec2 aside = map.place_m(i) - plan.grid.center(plan.grid.cell_at(i));
    EXPECT_LT(norm(aside), plan.grid.cell_m / 30.0);
  }
  for (int h = 0; h < 8; ++h) {
    const Heading nominal = Heading::from_rad(pi / 4 * h);
    const double turn =
        nominal.turn_to(Heading::from_rad(map.heading_rad[static_cast<std::size_t>(h)]));
    EXPECT_LT(std::abs(turn), 0.00051) << h;
  }
}

TEST(VerdictMap, DoesNotDependOnTheNumberOfThreads) {
  const Plan plan = random_plan(7);
  const PlanFlow pf(plan);
  const SectionVerdicts sections = proved(pf, 5);
  const VerdictMap all = map_of(pf, sections);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const VerdictMap single = map_of(pf, sections);
  EXPECT_EQ(all.verdict, single.verdict);
  EXPECT_EQ(all.count, single.count);
}

TEST(VerdictMap, OfNothingProvedIsUndecidedExceptForStatesThatEndBeforeTheSection) {
  const Plan plan = empty_plan(20, 20, 8.0, 20.0);
  const PlanFlow pf(plan);
  const SectionVerdicts nothing = undecided_sections(pf.flow(), 2);
  const VerdictMap map = map_of(pf, nothing);
  EXPECT_EQ(map.verdict_at(0, map.index(3, 10)), Verdict::undecided);
  EXPECT_EQ(map.verdict_at(0, map.index(19, 10)), Verdict::leave);
}

TEST(VerdictMap, OfObstaclesAloneHasNoStates) {
  Plan plan = empty_plan(3, 4, 8.0, 20.0);
  plan.region.assign(plan.grid.size(), Region::obstacle);
  const PlanFlow pf(plan);
  const VerdictMap map = map_of(pf, undecided_sections(pf.flow(), 2));
  for (const auto& count : map.count) {
    EXPECT_EQ(std::accumulate(count.begin(), count.end(), 0), 0);
  }
}

TEST(VerdictMap, OptionsOutOfRangeAreRefused) {
  const Plan plan = empty_plan(3, 3, 8.0, 20.0);
  const PlanFlow pf(plan);
  const SectionVerdicts sections = undecided_sections(pf.flow(), 2);
  EXPECT_THROW(map_of(pf, sections, {.headings = 0}), PreconditionViolation);
  EXPECT_THROW(map_of(pf, sections, {.states_per_sample = 70000}), PreconditionViolation);
  EXPECT_THROW(map_of(pf, sections, {.most_across = 0}), PreconditionViolation);
}

}  // namespace
}  // namespace fairway
