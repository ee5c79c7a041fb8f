#include "fairway/verify/certify.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <vector>

#include <tbb/global_control.h>

#include "fairway/base/random.hpp"
#include "fairway/simulate/exact_flight.hpp"
#include "fairway/verify/images.hpp"
#include "fairway/verify/testing/plans_to_verify.hpp"

namespace fairway {
namespace {

constexpr float no_command = std::numeric_limits<float>::quiet_NaN();

CertifyOptions options_to(int level) {
  CertifyOptions options;
  options.undecided_max = 0.0;
  options.last_level = level;
  options.samples = 4000;
  return options;
}

/// A certified plan that can be queried.
struct Proof {
  const Plan& plan;
  PlanFlow plan_flow;
  Flow flow;
  Certified certified;

  explicit Proof(const Plan& plan_, int level = 10, SectionVerdicts start = {})
      : Proof(plan_, options_to(level), std::move(start)) {}
  Proof(const Plan& plan_, const CertifyOptions& options, SectionVerdicts start = {})
      : plan(plan_),
        plan_flow(plan_),
        flow(plan_flow.flow()),
        certified(certify(flow, plan_flow.is_free, options, std::move(start))) {}

  std::vector<VerdictSet> ask(const std::vector<Place>& states) const {
    const ImageStore images = state_images(flow, states, 3000, [] { return true; });
    std::vector<VerdictSet> found;
    for (std::size_t i = 0; i < states.size(); ++i) {
      found.push_back(verdicts_of(images[i], certified.sections.view()));
    }
    return found;
  }
  Verdict ask(double x_m, double y_m, double heading_rad) const {
    return ask({{x_m, y_m, heading_rad}})[0].only();
  }
  double share(Verdict verdict) const {
    return certified.volume.all[static_cast<std::size_t>(verdict)];
  }
};

std::vector<Place> random_places(const Plan& plan, std::size_t count, std::uint64_t seed) {
  Random random(seed);
  std::vector<Place> places;
  for (std::size_t i = 0; i < count; ++i) {
    places.push_back({plan.grid.x0_m + random.unit() * plan.grid.width_m(),
                      plan.grid.y0_m + random.unit() * plan.grid.height_m(),
                      random.uniform(-pi, pi)});
  }
  return places;
}

Plan plan_of(int nx, int ny, double cell_m, double turn_radius_m,
             const std::function<double(Vec2)>& heading) {
  Plan plan = empty_plan(nx, ny, cell_m, turn_radius_m);
  for (std::size_t i = 0; i < plan.grid.size(); ++i) {
    plan.heading_rad[i] = Heading::stored(heading(plan.grid.center(plan.grid.cell_at(i))));
  }
  return plan;
}

TEST(Certify, ProvesForAUniformFieldWhatItsClosedFormSays) {
  // Heading 0 everywhere, a wall of targets on the right: a state turns to 0, then flies on.
  Plan plan = plan_of(24, 10, 1.0, 3.0, [](Vec2) { return 0.0; });
  for (int iy = 0; iy < 10; ++iy) plan.region[plan.grid.index({23, iy})] = Region::goal;
  const Proof proof(plan, 11);
  EXPECT_LT(proof.share(Verdict::undecided), 0.01);
  Random random(1);
  int reached = 0;
  int left = 0;
  for (int i = 0; i < 4000; ++i) {
    const Place s{random.uniform(0.0, 18.0), random.uniform(0.0, 10.0), random.uniform(-pi, pi)};
    const double h = std::abs(s.heading_rad);
    const double rises = 3.0 * (1.0 - std::cos(h));
    const double room = s.heading_rad > 0.0 ? 10.0 - s.y_m : s.y_m;
    const double back = h > pi / 2 ? 3.0 * (1.0 - std::sin(h)) : 0.0;
    if (std::abs(room - rises) < 1e-6 || std::abs(s.x_m - back) < 1e-6) continue;
    // West first or up first: leaves either way.
    const Verdict expected = rises < room && back < s.x_m ? Verdict::reach : Verdict::leave;
    const Verdict found = proof.ask(s.x_m, s.y_m, s.heading_rad);
    if (found == Verdict::undecided) continue;
    ASSERT_EQ(name_of(found), name_of(expected)) << s.x_m << "," << s.y_m << "," << s.heading_rad;
    (found == Verdict::reach ? reached : left) += 1;
  }
  EXPECT_GT(reached, 1500);
  EXPECT_GT(left, 1000);
}

TEST(Certify, BoundsTheTimeInAUniformField) {
  const double command = static_cast<double>(0.1F);
  Plan plan = plan_of(24, 10, 1.0, 3.0, [&](Vec2) { return command; });
  for (int iy = 0; iy < 10; ++iy) plan.region[plan.grid.index({23, iy})] = Region::goal;
  const Proof proof(plan, 8);
  // An arc to the command, then straight to x = 23, at 10 m/s.
  for (const double h : {1.5, 0.7, 0.1001, -0.6}) {
    const VerdictSet found = proof.ask({{2.0, 4.3, h}})[0];
    ASSERT_EQ(found.only(), Verdict::reach) << h;
    const double arc_end_m = 2.0 + 3.0 * std::abs(std::sin(h) - std::sin(command));
    const double exact_s =
        (3.0 * std::abs(h - command) + (23.0 - arc_end_m) / std::cos(command)) / 10.0;
    EXPECT_GE(found.time_s, exact_s * (1.0 - 1e-9)) << h;
    EXPECT_LE(found.time_s, exact_s * 1.5) << h;
  }
}

TEST(Certify, NeverReachesInACircularVortexThatLeansInwards) {
  const Plan plan = plan_of(
      32, 32, 2.0, 5.0, [](Vec2 p) { return std::atan2(p.y - 32.0, p.x - 32.0) + pi / 2 + 0.3; });
  const Proof proof(plan, 10);
  EXPECT_EQ(proof.share(Verdict::reach), 0.0);
  EXPECT_EQ(proof.share(Verdict::collide), 0.0);
  EXPECT_GT(proof.share(Verdict::trapped), 0.3);
}

TEST(Certify, LeavesFromASource) {
  const Plan plan =
      plan_of(30, 30, 2.0, 5.0, [](Vec2 p) { return std::atan2(p.y - 30.0, p.x - 30.0); });
  const Proof proof(plan, 10);
  EXPECT_EQ(proof.share(Verdict::reach) + proof.share(Verdict::collide), 0.0);
  EXPECT_GT(proof.share(Verdict::leave), 0.97);
}

TEST(Certify, DoesNotReachAGoalThatIsWalledIn) {
  Plan plan = plan_of(19, 19, 2.0, 5.0, [](Vec2 p) { return std::atan2(19.0 - p.y, 19.0 - p.x); });
  for (int iy = 7; iy <= 11; ++iy) {
    for (int ix = 7; ix <= 11; ++ix) {
      const bool wall = iy == 7 || iy == 11 || ix == 7 || ix == 11;
      const bool goal = iy == 9 && ix == 9;
      if (wall) plan.region[plan.grid.index({ix, iy})] = Region::obstacle;
      if (goal) plan.region[plan.grid.index({ix, iy})] = Region::goal;
    }
  }
  const Proof proof(plan, 9);
  for (const Place& s : random_places(plan, 3000, 2)) {
    const Cell c = plan.grid.cell_of({s.x_m, s.y_m});
    if (c.ix >= 7 && c.ix <= 11 && c.iy >= 7 && c.iy <= 11) continue;
    ASSERT_NE(proof.ask(s.x_m, s.y_m, s.heading_rad), Verdict::reach);
  }
  EXPECT_GT(proof.share(Verdict::collide), 0.5);
}

TEST(Certify, FollowsWeavesBetweenOpposingHalfPlanesToTheEndAndBoundsTheirTime) {
  for (const double angle : {0.4, 0.05, 1e-3}) {
    Plan plan = plan_of(12, 6, 1.0, 2.5, [&](Vec2 p) { return p.y < 3.0 ? angle : -angle; });
    for (int iy = 0; iy < 6; ++iy) plan.region[plan.grid.index({11, iy})] = Region::goal;
    const Proof proof(plan, 7);
    const ExactFlights flights(plan);
    int proved = 0;
    for (const Place& s : random_places(plan, 400, 3)) {
      const VerdictSet found = proof.ask({s})[0];
      if (found.only() == Verdict::undecided) continue;
      const FlightResult flown = flights.fly({{s.x_m, s.y_m}, Heading::from_rad(s.heading_rad)});
      ASSERT_EQ(static_cast<int>(found.only()), static_cast<int>(flown.outcome))
          << angle << ": " << s.x_m << "," << s.y_m << "," << s.heading_rad;
      if (found.only() != Verdict::reach) continue;
      ++proved;
      ASSERT_GE(found.time_s, flown.time_s * (1.0 - 1e-9)) << angle;
    }
    EXPECT_GT(proved, 200) << angle;
  }
}

TEST(Certify, AgreesWithExactFlightsOverRandomPlansAndBoundsTheirTime) {
  int decided = 0;
  for (std::uint64_t number = 500; number < 530; ++number) {
    const Plan plan = random_plan(number);
    const Proof proof(plan, 8);
    const ExactFlights flights(plan);
    const std::vector<Place> places = random_places(plan, 500, number);
    const std::vector<VerdictSet> found = proof.ask(places);
    for (std::size_t i = 0; i < places.size(); ++i) {
      const Place& s = places[i];
      if (found[i].only() == Verdict::undecided) continue;
      ++decided;
      const FlightResult flown = flights.fly({{s.x_m, s.y_m}, Heading::from_rad(s.heading_rad)});
      ASSERT_EQ(static_cast<int>(found[i].only()), static_cast<int>(flown.outcome))
          << "plan " << number << ": " << ::testing::PrintToString(s.x_m) << "," << s.y_m << ","
          << s.heading_rad;
      if (found[i].only() == Verdict::reach) {
        ASSERT_GE(found[i].time_s, flown.time_s * (1.0 - 1e-9)) << "plan " << number;
      }
    }
  }
  EXPECT_GT(decided, 10000);
}

/// The plan mirrored in the x axis; exact, because only signs of floats change.
Plan mirrored(const Plan& plan) {
  Plan image = plan;
  image.grid.y0_m = -plan.grid.y0_m - plan.grid.height_m();
  for (std::size_t i = 0; i < plan.grid.size(); ++i) {
    const Cell c = plan.grid.cell_at(i);
    const std::size_t j = plan.grid.index({c.ix, plan.grid.ny - 1 - c.iy});
    image.heading_rad[j] = -plan.heading_rad[i];
    image.region[j] = plan.region[i];
  }
  return image;
}

/// Rotated by 90 degrees about the origin; headings round to floats.
Plan turned(const Plan& plan) {
  Plan image = plan;
  image.grid.nx = plan.grid.ny;
  image.grid.ny = plan.grid.nx;
  image.grid.x0_m = -plan.grid.y0_m - plan.grid.height_m();
  image.grid.y0_m = plan.grid.x0_m;
  for (std::size_t i = 0; i < plan.grid.size(); ++i) {
    const Cell c = plan.grid.cell_at(i);
    const std::size_t j = image.grid.index({plan.grid.ny - 1 - c.iy, c.ix});
    const float h = plan.heading_rad[i];
    image.heading_rad[j] = std::isnan(h) ? h : Heading::stored(static_cast<double>(h) + pi / 2);
    image.region[j] = plan.region[i];
  }
  return image;
}

TEST(Certify, GivesTheMirroredVerdictsForTheMirroredPlan) {
  int decided = 0;
  int differ = 0;
  for (std::uint64_t number = 600; number < 618; ++number) {
    Plan plan = random_plan(number);
    plan.grid.cell_m = 1.0;  // so that the mirror image is exact
    plan.grid.x0_m = plan.grid.y0_m = 0.0;
    plan.vehicle.turn_radius_m = 1.0 + static_cast<double>(number % 3);
    if (plan.vehicle.turn_radius_m == 1.0) plan.vehicle.turn_radius_m = 1.0078125;
    const Plan image = mirrored(plan);
    const Proof one(plan, 8);
    const Proof other(image, 8);
    const std::vector<Place> places = random_places(plan, 300, number);
    std::vector<Place> mirror = places;
    for (Place& s : mirror) {
      s.y_m = -s.y_m;
      s.heading_rad = -s.heading_rad;
    }
    const auto a = one.ask(places);
    const auto b = other.ask(mirror);
    for (std::size_t i = 0; i < places.size(); ++i) {
      decided += a[i].only() != Verdict::undecided;
      differ += a[i].only() != b[i].only();
      if (a[i].only() == Verdict::undecided || b[i].only() == Verdict::undecided) continue;
      ASSERT_EQ(a[i].only(), b[i].only()) << "plan " << number;
    }
  }
  EXPECT_GT(decided, 3500);
  EXPECT_LT(differ, decided / 100);  // one undecided: leaves start at the other end
}

TEST(Certify, GivesTheRotatedVerdictsForTheRotatedPlan) {
  int decided = 0;
  int contradict = 0;
  for (std::uint64_t number = 624; number < 642; ++number) {
    const Plan plan = random_plan(number);
    const Plan image = turned(plan);
    const Proof one(plan, 8);
    const Proof other(image, 8);
    const std::vector<Place> places = random_places(plan, 300, number);
    std::vector<Place> mirror;
    for (const Place& s : places) {
      mirror.push_back({-s.y_m, s.x_m, Heading::from_rad(s.heading_rad + pi / 2).rad()});
    }
    const auto a = one.ask(places);
    const auto b = other.ask(mirror);
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (a[i].only() == Verdict::undecided || b[i].only() == Verdict::undecided) continue;
      ++decided;
      contradict += a[i].only() != b[i].only();
    }
  }
  EXPECT_GT(decided, 3500);
  // Commands that are axes in one plan and neighbouring floats in the other affect a few states.
  EXPECT_LT(contradict, decided / 50);
}

TEST(Certify, RefiningOnlyDecidesMoreAndChangesNoVerdict) {
  for (std::uint64_t number = 700; number < 712; ++number) {
    const Plan plan = random_plan(number);
    const std::vector<Place> places = random_places(plan, 400, number);
    std::vector<VerdictSet> before(places.size());
    double undecided = 1.0;
    for (const int level : {3, 5, 8}) {
      const Proof proof(plan, level);
      const std::vector<VerdictSet> now = proof.ask(places);
      for (std::size_t i = 0; i < places.size(); ++i) {
        if (before[i].only() == Verdict::undecided) continue;
        ASSERT_EQ(now[i].only(), before[i].only()) << "plan " << number << " level " << level;
      }
      ASSERT_LE(proof.share(Verdict::undecided), undecided) << "plan " << number;
      undecided = proof.share(Verdict::undecided);
      before = now;
      const auto& levels = proof.certified.levels;
      for (std::size_t k = 1; k < levels.size(); ++k) {
        ASSERT_LE(levels[k].undecided_volume, levels[k - 1].undecided_volume);
      }
    }
  }
}

TEST(Certify, ResumedKeepsEveryVerdictAndGoesOn) {
  for (std::uint64_t number = 720; number < 730; ++number) {
    const Plan plan = random_plan(number);
    const Proof first(plan, 5);
    const Proof again(plan, 5, first.certified.sections);
    EXPECT_LE(again.share(Verdict::undecided), first.share(Verdict::undecided));
    const Proof on(plan, 9, first.certified.sections);
    EXPECT_LE(on.share(Verdict::undecided), first.share(Verdict::undecided));
    const Proof straight(plan, 9);
    const std::vector<Place> places = random_places(plan, 400, number);
    const auto a = first.ask(places);
    const auto b = on.ask(places);
    const auto c = straight.ask(places);
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (a[i].only() != Verdict::undecided) {
        ASSERT_EQ(a[i].only(), b[i].only()) << number;
      }
      if (b[i].only() != Verdict::undecided && c[i].only() != Verdict::undecided) {
        ASSERT_EQ(b[i].only(), c[i].only()) << number;
      }
    }
  }
}

TEST(Certify, GivesTheSameLeavesOnAnyNumberOfThreads) {
  for (const std::uint64_t number : {1, 2, 6, 9}) {
    const Plan plan = random_plan(number);
    const auto with = [&](std::size_t threads) {
      const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
      return Proof(plan, 9).certified;
    };
    const Certified one = with(1);
    const Certified two = with(2);
    EXPECT_EQ(one.sections.first, two.sections.first);
    EXPECT_EQ(one.sections.begin, two.sections.begin);
    EXPECT_EQ(one.sections.rank, two.sections.rank);
    EXPECT_EQ(one.sections.verdict, two.sections.verdict);
    EXPECT_EQ(one.sections.time_s, two.sections.time_s);
    EXPECT_EQ(one.volume.all, two.volume.all);
    EXPECT_EQ(one.volume.worst_time_s, two.volume.worst_time_s);
  }
}

TEST(Certify, CrossesCellsWithoutCommandsStraight) {
  Plan plan = empty_plan(12, 9, 1.0, 2.0);
  plan.heading_rad.assign(plan.grid.size(), no_command);
  plan.region[plan.grid.index({9, 4})] = Region::goal;
  const Proof proof(plan, 6);
  EXPECT_EQ(proof.certified.sections.leaves(), 0U);
  EXPECT_LT(proof.share(Verdict::undecided), 1e-3);
  EXPECT_EQ(proof.ask(2.5, 4.5, 0.0), Verdict::reach);
  EXPECT_EQ(proof.ask(2.5, 4.5, 0.2), Verdict::leave);
  EXPECT_EQ(proof.ask(2.5, 4.5, pi), Verdict::leave);
  Random random(4);
  for (int i = 0; i < 3000; ++i) {
    const Place s{random.uniform(0.0, 8.5), random.uniform(0.0, 9.0), random.uniform(-pi, pi)};
    // Does the ray meet the square [9, 10] x [4, 5]?
    const double c = std::cos(s.heading_rad);
    const double at_left = s.y_m + (9.0 - s.x_m) * std::tan(s.heading_rad);
    const double at_right = s.y_m + (10.0 - s.x_m) * std::tan(s.heading_rad);
    const double low = std::min(at_left, at_right);
    const double high = std::max(at_left, at_right);
    if (std::abs(low - 5.0) < 1e-9 || std::abs(high - 4.0) < 1e-9) continue;
    const bool meets = c > 0.0 && low < 5.0 && high > 4.0;
    const Verdict found = proof.ask(s.x_m, s.y_m, s.heading_rad);
    if (found == Verdict::undecided) continue;
    ASSERT_EQ(found, meets ? Verdict::reach : Verdict::leave)
        << s.x_m << "," << s.y_m << "," << s.heading_rad;
  }
}

TEST(Certify, AnswersForAMapOfOneCell) {
  Plan plan = empty_plan(1, 1, 1.0, 1.5);
  plan.heading_rad[0] = 1.0F;
  const Proof free(plan, 6);
  EXPECT_EQ(free.certified.sections.leaves(), 0U);
  EXPECT_EQ(free.share(Verdict::leave) + free.share(Verdict::undecided), 1.0);
  EXPECT_LT(free.share(Verdict::undecided), 1e-3);
  plan.region[0] = Region::goal;
  const Proof goal(plan, 6);
  EXPECT_EQ(goal.ask(0.5, 0.5, 2.0), Verdict::reach);
  EXPECT_EQ(
      std::accumulate(goal.certified.volume.all.begin(), goal.certified.volume.all.end(), 0.0), 0.0)
      << "no cell that is neither obstacle nor target";
  plan.region[0] = Region::obstacle;
  const Proof blocked(plan, 6);
  EXPECT_EQ(blocked.ask(0.5, 0.5, 2.0), Verdict::collide);
}

TEST(Certify, ReachesNothingWithoutATarget) {
  for (std::uint64_t number = 740; number < 760; ++number) {
    Plan plan = random_plan(number);
    for (Region& region : plan.region) {
      if (region == Region::goal) region = Region::free;
    }
    const Proof proof(plan, 7);
    EXPECT_EQ(proof.share(Verdict::reach), 0.0) << number;
    const auto& verdicts = proof.certified.sections.verdict;
    EXPECT_EQ(
        std::count(verdicts.begin(), verdicts.end(), static_cast<std::uint8_t>(Verdict::reach)), 0);
  }
}

TEST(Certify, SaysWhatStoppedItAndWhatItHasIsStillProved) {
  const Plan plan = random_plan(3);
  CertifyOptions options = options_to(20);
  options.time_limit_s = 1e-9;
  const Proof hasty(plan, options);
  EXPECT_EQ(hasty.certified.stopped_by, StoppedBy::time_limit);
  EXPECT_EQ(Proof(plan, 4).certified.stopped_by, StoppedBy::last_level);
  options = options_to(20);
  options.undecided_max = 1.0;
  EXPECT_EQ(Proof(plan, options).certified.stopped_by, StoppedBy::undecided_max);
  options = options_to(20);
  options.memory_limit_bytes = 1;
  EXPECT_EQ(Proof(plan, options).certified.stopped_by, StoppedBy::memory_limit);
  // What the hasty proof left undecided then gets the same verdicts.
  const Proof full(plan, 8);
  const Proof on(plan, 8, hasty.certified.sections);
  const std::vector<Place> places = random_places(plan, 500, 8);
  const auto a = full.ask(places);
  const auto b = on.ask(places);
  for (std::size_t i = 0; i < places.size(); ++i) EXPECT_EQ(a[i].only(), b[i].only());
}

TEST(Certify, SharesSumToOneWhereThereAreCells) {
  for (std::uint64_t number = 760; number < 770; ++number) {
    const Plan plan = random_plan(number);
    const Proof proof(plan, 5);
    const VolumeFractions& volume = proof.certified.volume;
    for (const auto& shares : {volume.all, volume.free, volume.commanded, volume.buffer}) {
      const double sum = std::accumulate(shares.begin(), shares.end(), 0.0);
      EXPECT_TRUE(std::abs(sum - 1.0) < 1e-12 || sum == 0.0) << number;
    }
  }
}

TEST(Certify, CountsSafeStartsWithACommandApart) {
  // All cells command east except those of the first column, which have no command.
  Plan plan = empty_plan(3, 4, 1.0, 2.0);
  for (int iy = 0; iy < 4; ++iy) plan.heading_rad[plan.grid.index({0, iy})] = NAN;
  plan.region[plan.grid.index({2, 1})] = Region::goal;
  plan.region[plan.grid.index({2, 2})] = Region::goal;
  const Proof proof(plan, 10);
  const VolumeFractions& volume = proof.certified.volume;
  const std::size_t reach = static_cast<std::size_t>(Verdict::reach);
  EXPECT_GT(volume.commanded[reach], volume.free[reach] + 0.05);
  EXPECT_EQ(volume.free[reach], volume.all[reach]);  // there is no buffer
  EXPECT_EQ(volume.usable[reach], volume.commanded[reach]);
}

}  // namespace
}  // namespace fairway
