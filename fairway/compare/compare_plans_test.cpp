// What a comparison promises: nothing differs from itself, order changes signs alone, and what it
// lists is true.
#include "fairway/compare/compare_plans.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "fairway/base/error.hpp"
#include "fairway/base/markup_text.hpp"
#include "fairway/compare/comparison_page.hpp"
#include "fairway/compare/comparison_text.hpp"
#include "fairway/compare/require_alike.hpp"
#include "fairway/compare/state_verdicts.hpp"
#include "fairway/compare/testing/bay_plans.hpp"
#include "fairway/run/contract_verification.hpp"
#include "fairway/simulate/exact_flight.hpp"

namespace fairway {
namespace {

using testing::bay_plan;
using ::testing::HasSubstr;
using testing::proved_bay_plan;

CompareOptions few_states() {
  CompareOptions options;
  options.states = 6000;
  options.map_across = 40;
  options.map_headings = 6;
  return options;
}

Comparison compared(const std::vector<ComparedPlan>& plans,
                    const CompareOptions& options = few_states()) {
  const Progress silent;
  StageClock clock(silent);
  return compare_plans(plans, options, clock);
}

/// The paper's buffer and a narrow one, proved once.
const std::vector<ComparedPlan>& wide_and_narrow() {
  static const std::vector<ComparedPlan> plans{proved_bay_plan("wide", 2.0),
                                               proved_bay_plan("narrow", 0.5)};
  return plans;
}

const ComparedMeasure& line(const Comparison& c, const std::string& key) {
  for (const ComparedMeasure& m : c.table) {
    if (m.key == key) return m;
  }
  throw PreconditionViolation("no such line");
}

double share(const SampledValue& e) { return std::isfinite(e.value) ? e.value : 0.0; }

TEST(ComparePlans, FindsNoDifferenceBetweenAPlanAndItself) {
  const ComparedPlan& plan = wide_and_narrow()[0];
  const Comparison c = compared({plan, plan});
  for (const ComparedMeasure& m : c.table) {
    EXPECT_EQ(m.value[0].value, m.value[1].value) << m.key;
    EXPECT_EQ(m.difference_from_first[1].value, 0.0) << m.key;
    if (std::isfinite(m.difference_from_first[1].standard_error)) {
      EXPECT_EQ(m.difference_from_first[1].standard_error, 0.0) << m.key;
    }
  }
  ASSERT_EQ(c.pairs.size(), 1U);
  EXPECT_EQ(c.pairs[0].only_first.value, 0.0);
  EXPECT_EQ(c.pairs[0].only_second.value, 0.0);
  EXPECT_THAT(c.pairs[0].map.only_first, ::testing::Each(0));
  EXPECT_THAT(c.pairs[0].map.only_second, ::testing::Each(0));
  EXPECT_EQ(differing_states_csv(c, Knowledge::exact), "x_m,y_m,heading_rad,verdict_1,verdict_2\n");
}

TEST(ComparePlans, InTheOtherOrderMirrorsEverything) {
  const std::vector<ComparedPlan>& plans = wide_and_narrow();
  const Comparison forward = compared(plans);
  const Comparison backward = compared({plans[1], plans[0]});
  ASSERT_EQ(forward.ground.states, backward.ground.states);
  ASSERT_EQ(forward.table.size(), backward.table.size());
  for (std::size_t i = 0; i < forward.table.size(); ++i) {
    const ComparedMeasure& a = forward.table[i];
    const ComparedMeasure& b = backward.table[i];
    EXPECT_EQ(a.key, b.key);
    EXPECT_EQ(a.value[0].value, b.value[1].value) << a.key;
    EXPECT_EQ(a.value[0].standard_error, b.value[1].standard_error) << a.key;
    EXPECT_EQ(a.difference_from_first[1].value, -b.difference_from_first[1].value) << a.key;
  }
  const PairDifference& f = forward.pairs[0];
  const PairDifference& b = backward.pairs[0];
  EXPECT_GT(f.only_first.value, 0.0);
  EXPECT_EQ(f.only_first.value, b.only_second.value);
  EXPECT_EQ(f.only_second.value, b.only_first.value);
  EXPECT_EQ(f.only_first_failing.value, b.only_second_failing.value);
  EXPECT_EQ(f.map.only_first, b.map.only_second);
  EXPECT_EQ(f.map.neither, b.map.neither);
}

TEST(ComparePlans, SharesAgreeWithThoseOfTheCertificates) {
  const std::vector<ComparedPlan>& plans = wide_and_narrow();
  const Comparison c = compared(plans);
  for (std::size_t k = 0; k < plans.size(); ++k) {
    const auto evidence = nlohmann::json::parse(plans[k].certificate->evidence_json);
    for (const Verdict verdict : {Verdict::reach, Verdict::collide, Verdict::undecided}) {
      const auto v = static_cast<std::size_t>(verdict);
      const auto expect_near = [&](const SampledValue& found, const char* member) {
        const double told = evidence[member].value(name_of(verdict), 0.0);
        EXPECT_NEAR(share(found), told, 4.0 * found.standard_error + 2e-3)
            << member << ", " << name_of(verdict) << " of " << plans[k].name;
      };
      expect_near(c.measures[k].exact.all[v], "volume_fraction");
      expect_near(c.measures[k].exact.safe_start[v], "volume_fraction_free");
      expect_near(c.measures[k].exact.buffer[v], "volume_fraction_buffer");
    }
  }
  const PairDifference& d = c.pairs[0];
  EXPECT_NEAR(d.only_first.value + d.only_second.value + d.both.value + d.neither.value, 1.0,
              1e-12);
  EXPECT_NEAR(line(c, "proved").value[0].value, d.only_first.value + d.both.value, 1e-12);
  EXPECT_NEAR(line(c, "proved").difference_from_first[1].value,
              d.only_second.value - d.only_first.value, 1e-12);
}

TEST(ComparePlans, StatesThatOneWinsAreFlownAgainAndWon) {
  const std::vector<ComparedPlan>& plans = wide_and_narrow();
  const Comparison c = compared(plans);
  const std::array<ExactFlights, 2> flights{ExactFlights(plans[0].plan),
                                            ExactFlights(plans[1].plan)};
  std::array<std::size_t, 2> won{};
  std::size_t listed = 0;
  for (std::size_t i = 0; i < c.ground.states.size(); ++i) {
    for (std::size_t k = 0; k < 2; ++k) {
      const Verdict verdict = c.verdicts[0][k][i];
      const Verdict other = c.verdicts[0][1 - k][i];
      if (!is_kept(verdict) || is_kept(other)) continue;
      ++listed;
      EXPECT_EQ(flights[k].fly(c.ground.states[i]).outcome, Outcome::reach);
      if (!fails(other)) continue;
      ++won[k];
      EXPECT_EQ(flights[1 - k].fly(c.ground.states[i]).outcome, static_cast<Outcome>(other));
    }
  }
  EXPECT_GT(won[0], 20U);
  const std::string csv = differing_states_csv(c, Knowledge::exact);
  EXPECT_EQ(static_cast<std::size_t>(std::count(csv.begin(), csv.end(), '\n')), 1 + listed);
  const double n = static_cast<double>(c.ground.counted);
  EXPECT_NEAR(c.pairs[0].only_first_failing.value, static_cast<double>(won[0]) / n, 1e-12);
}

TEST(ComparePlans, FlownWithoutCertificatesSeesWhatIsProved) {
  const std::vector<ComparedPlan>& proved = wide_and_narrow();
  std::vector<ComparedPlan> flown = proved;
  for (ComparedPlan& plan : flown) plan.certificate.reset();
  const Comparison a = compared(proved);
  const Comparison b = compared(flown);
  EXPECT_FALSE(b.is_proved);
  EXPECT_EQ(line(b, "proved").name, "seen to reach the goal");
  for (std::size_t k = 0; k < 2; ++k) {
    for (std::size_t i = 0; i < a.ground.states.size(); ++i) {
      if (a.verdicts[0][k][i] == Verdict::undecided) continue;
      EXPECT_EQ(a.verdicts[0][k][i], b.verdicts[0][k][i]);
    }
  }
}

TEST(ComparePlans, OverOtherCellsIsOverTheirCommonGround) {
  const std::vector<ComparedPlan> plans{bay_plan("coarse", 1.0), bay_plan("fine", 1.0, 4.0)};
  const Comparison c = compared(plans);
  const Comparison swapped = compared({plans[1], plans[0]});
  EXPECT_EQ(c.ground.grid, plans[1].plan.grid);
  EXPECT_LT(c.ground.counted, c.ground.states.size());  // the hook is wider in coarse cells
  EXPECT_EQ(c.ground.states, swapped.ground.states);
  EXPECT_EQ(c.ground.counts, swapped.ground.counts);
  EXPECT_EQ(line(c, "proved").value[0].value, line(swapped, "proved").value[1].value);
  for (std::size_t i = 0; i < c.ground.states.size(); ++i) {
    if (!c.ground.is_counted(i)) continue;
    for (const ComparedPlan& p : plans) {
      EXPECT_TRUE(is_on_ground(p.plan, c.ground.states[i].position_m));
    }
  }
  EXPECT_EQ(line(c, "proved").value[0].states, c.ground.counted);
  EXPECT_THAT(c.warnings, ::testing::Contains(HasSubstr("different cells, of 8 and 4 m")));
}

std::string refusal(const ComparedPlan& a, const ComparedPlan& b) {
  try {
    (void)require_alike(std::vector<ComparedPlan>{a, b});
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(RequireAlike, RefusesOtherFramesMissionsAndMapsAndSaysWhich) {
  const ComparedPlan plan = bay_plan("one", 1.0);
  EXPECT_EQ(refusal(plan, plan), "");
  ComparedPlan other = bay_plan("two", 1.0, 8.0, GoalMission{{100.0, 220.0}, {}});
  EXPECT_EQ(refusal(plan, other),
            "two.safetensors: its mission is the goal at (100, 220); that of one.safetensors is "
            "the goal at (380, 220): only plans of one mission can be compared");
  other = plan;
  other.from = "two";
  other.plan.record.frame = Frame{{5000.0, 0.0, 0.25}, {}, {}};
  EXPECT_THAT(refusal(plan, other), HasSubstr("two: its frame lies with its origin at (5000, 0), "
                                              "turned by 0.25 rad; that of one.safetensors"));
  other = plan;
  other.plan.record.mission = PathMission{{{0.0, 0.0}, {10.0, 10.0}}};
  EXPECT_THAT(refusal(plan, other), HasSubstr("to follow an open path of 2 points from (0, 0)"));
  other = plan;
  other.plan.record.mission.reset();
  EXPECT_THAT(refusal(plan, other), HasSubstr("does not say its mission"));
  other = plan;
  other.plan.grid.x0_m += 10'000.0;
  EXPECT_THAT(refusal(plan, other), HasSubstr("does not overlap that of one.safetensors"));
  other = bay_plan("fine", 1.0, 4.0);
  EXPECT_EQ(refusal(plan, other), "");
  other.plan.record.inputs = std::vector<InputFile>{{"bay.pgm", "def"}};
  EXPECT_EQ(refusal(plan, other),
            "fine.safetensors: has cells of 4 m and another map than one.safetensors, with cells "
            "of 8 m: only plans of one map can be compared over different cells");
}

TEST(RequireAlike, TellsOtherVehiclesAndObstacles) {
  const ComparedPlan plan = bay_plan("one", 1.0);
  ComparedPlan other = plan;
  other.name = "two";
  other.plan.vehicle.turn_radius_m = 25.0;
  other.plan.region[other.plan.grid.index({10, 30})] = Region::obstacle;
  const std::vector<std::string> told = require_alike(std::vector<ComparedPlan>{plan, other});
  ASSERT_EQ(told.size(), 2U);
  EXPECT_THAT(told[0], HasSubstr("one and two are for different vehicles"));
  EXPECT_THAT(told[1], HasSubstr("different obstacles, in 1 of 2,400 cells"));
}

TEST(ComparePlans, TellsTheWorstFirstAndEveryNumberInItsFiles) {
  const std::vector<ComparedPlan>& plans = wide_and_narrow();
  const Comparison c = compared(plans);
  const std::vector<std::string> lines = difference_lines(c);
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_THAT(lines[0], HasSubstr("proved to reach the goal under wide but not under narrow"));
  EXPECT_EQ(c.table.front().key, "fails");
  const std::string csv = comparison_csv(c);
  const auto json = comparison_json(plans, c);
  EXPECT_EQ(json["table"].size(), c.table.size());
  EXPECT_EQ(static_cast<std::size_t>(std::count(csv.begin(), csv.end(), '\n')),
            1 + 2 * c.table.size());
  const std::string page = comparison_page(plans, c, "fairway compare <a> b");
  EXPECT_THAT(page, HasSubstr("<h1>wide against narrow</h1>"));
  EXPECT_THAT(page, HasSubstr("fairway compare &lt;a&gt; b"));
  EXPECT_THAT(page, ::testing::Not(HasSubstr("<script")));
  EXPECT_THAT(page, ::testing::Not(HasSubstr("http")));  // nothing is fetched
  const std::string text = comparison_text(c);
  for (const ComparedMeasure& m : c.table) {
    EXPECT_THAT(text, HasSubstr(m.name));
    EXPECT_THAT(page, HasSubstr(markup_text(m.name)));
  }
}

TEST(ComparePlans, OnePlanAloneIsMeasuredAsAmongOthers) {
  const ComparedPlan& plan = wide_and_narrow()[0];
  const Progress silent;
  StageClock clock(silent);
  CompareOptions options = few_states();
  const PlanMeasures alone = measure_plan(plan, options, clock);
  const Comparison c = compared({plan, plan});
  const auto reach = static_cast<std::size_t>(Verdict::reach);
  EXPECT_EQ(alone.exact.all[reach].value, c.measures[1].exact.all[reach].value);
  EXPECT_EQ(alone.costs.time_s.value, c.measures[1].costs.time_s.value);
  EXPECT_FALSE(alone.contract);
  options.bound = [](const Plan&) {
    return LengthBound{"a tenth of a metre", [](const State&) { return 0.1; }};
  };
  const PlanMeasures other = measure_plan(plan, options, clock);
  EXPECT_EQ(other.costs.shortest_bound, "a tenth of a metre");
  EXPECT_NEAR(other.costs.length_ratio.value, 10.0 * alone.costs.length_m.value, 1e-6);
}

TEST(ComparePlans, UnderAContractProvesLessAndNothingThatFlightsDeny) {
  std::vector<ComparedPlan> plans = wide_and_narrow();
  VehicleContract contract = VehicleContract::of(plans[0].plan.vehicle);
  contract.command_error_m = 3.0;
  contract.heading_error_rad = 0.02;
  for (ComparedPlan& plan : plans) {
    ContractVerifyOptions options;
    options.samples = 20'000;
    options.find_witnesses = false;
    options.limits.time_limit_s = 60.0;
    plan.contract =
        verify_contract(plan.plan, plan.name, {}, contract, options, [](const std::string&) {
        }).certificate;
  }
  const Comparison c = compared(plans);
  ASSERT_TRUE(c.has_contract);
  EXPECT_EQ(c.pairs.size(), 2U);
  EXPECT_EQ(line(c, "contract_proved").name, "proved to reach the goal within the contract");
  for (std::size_t k = 0; k < plans.size(); ++k) {
    const bool many = c.measures[k].contract->all[0].value > 0.02;  // undecided
    const auto told =
        ::testing::Contains(::testing::StartsWith(plans[k].name + ": under the contract"));
    EXPECT_TRUE(many ? ::testing::Value(c.warnings, told)
                     : ::testing::Value(c.warnings, ::testing::Not(told)));
  }
  for (std::size_t k = 0; k < plans.size(); ++k) {
    const auto evidence = nlohmann::json::parse(plans[k].contract->evidence_json);
    const SampledValue& found =
        c.measures[k].contract->all[static_cast<std::size_t>(Verdict::reach)];
    EXPECT_NEAR(found.value, evidence["volume_fraction"]["reach"].get<double>(),
                5.0 * found.standard_error + 5e-3);
    EXPECT_LT(found.value, line(c, "proved").value[k].value);
    EXPECT_GT(found.value, 0.3);
    const ExactFlights flights(plans[k].plan);  // the exact vehicle keeps the contract
    for (std::size_t i = 0; i < c.ground.states.size(); i += 5) {
      if (c.verdicts[1][k][i] != Verdict::reach) continue;
      EXPECT_EQ(flights.fly(c.ground.states[i]).outcome, Outcome::reach);
    }
  }
}

TEST(ComparePlans, MoreThanTwoAreComparedWithTheFirst) {
  std::vector<ComparedPlan> plans = wide_and_narrow();
  plans.push_back(plans[0]);
  plans[2].name = "again";
  const Comparison c = compared(plans);
  ASSERT_EQ(c.pairs.size(), 2U);
  EXPECT_EQ(c.pairs[1].second, 2U);
  EXPECT_EQ(c.pairs[1].only_first.value, 0.0);
  EXPECT_EQ(line(c, "proved").difference_from_first[2].value, 0.0);
  EXPECT_GT(std::abs(line(c, "proved").difference_from_first[1].value), 0.0);
}

}  // namespace
}  // namespace fairway
