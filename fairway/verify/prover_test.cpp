#include "fairway/verify/prover.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "fairway/base/random.hpp"
#include "fairway/verify/certify.hpp"
#include "fairway/verify/images.hpp"
#include "fairway/verify/testing/plans_to_verify.hpp"
#include "fairway/verify/testing/told_flights.hpp"
#include "fairway/verify/undecided_sections.hpp"

namespace fairway {
namespace {

constexpr int most_crossings = 1000;
bool always() { return true; }

SectionVerdicts proved(const Flow& flow, int level) {
  Prover prover(flow, undecided_sections(flow, 2), most_crossings, always);
  for (int l = 2; l <= level; ++l) prover.settle(std::ldexp(1.0, 32 - l));
  return prover.graph().sections();
}

std::vector<LeafPlace> places_of(const SectionVerdicts& sections) {
  std::vector<LeafPlace> places;
  for (std::size_t s = 0; s + 1 < sections.first.size(); ++s) {
    for (std::size_t i = sections.first[s]; i < sections.first[s + 1]; ++i) {
      places.push_back({static_cast<std::uint32_t>(s), sections.range_of(s, i)});
    }
  }
  return places;
}

/// The rule of docs/trust.md for one leaf, recomputed from its image.
void expect_rule(const SectionVerdicts& sections, const LeafPlace& place, std::size_t leaf,
                 const Image& image) {
  const auto verdict = static_cast<Verdict>(sections.verdict[leaf]);
  if (verdict == Verdict::undecided) return;
  SCOPED_TRACE("leaf " + std::to_string(leaf) + " of section " + std::to_string(place.section) +
               ", proved " + name_of(verdict));
  ASSERT_FALSE(image.gave_up);
  ASSERT_TRUE(image.ends.bits != 0 || !image.pieces.empty()) << "nothing was reported";
  const auto only = static_cast<std::uint8_t>(1U << static_cast<unsigned>(verdict));
  ASSERT_EQ(image.ends.bits & ~only, 0);
  const bool finite = verdict != Verdict::trapped;
  const auto bound_s = static_cast<double>(sections.time_s[leaf]);
  double own_hops_s = 0.0;
  double rest_s = finite ? image.ends.time_s : 0.0;
  bool leads_on = image.ends.bits != 0;
  for (const ImagePiece& piece : image.pieces) {
    const bool found =
        sections.view().for_leaves(piece.section, piece.range, [&](std::size_t other) {
          EXPECT_EQ(sections.verdict[other], sections.verdict[leaf]);
          if (!finite) return;
          if (other == leaf) {
            EXPECT_TRUE(piece.hop);
            const double move = least_move(piece, place.range);
            ASSERT_GT(move, 0.0);
            const double width =
                static_cast<double>(place.range.hi) - static_cast<double>(place.range.lo);
            own_hops_s =
                std::max(own_hops_s, std::floor(width / move) * static_cast<double>(piece.flown_s));
            return;
          }
          leads_on = true;
          EXPECT_LT(sections.rank[other], sections.rank[leaf]);
          rest_s = std::max(rest_s, static_cast<double>(piece.flown_s) +
                                        static_cast<double>(sections.time_s[other]));
        });
    ASSERT_TRUE(found) << "an image where the section has no leaves";
  }
  if (finite) {
    EXPECT_TRUE(leads_on) << "depends only on itself";
    EXPECT_GE(bound_s, (own_hops_s + rest_s) * (1.0 - 1e-12));
    EXPECT_LT(bound_s, std::numeric_limits<double>::infinity());
  }
}

/// Commands around the centre, leaning inwards; as wide as 4 turning radii.
void turn_to_a_vortex(Plan& plan) {
  plan.vehicle.turn_radius_m =
      std::max(1.01, 0.2 * std::min(plan.grid.nx, plan.grid.ny)) * plan.grid.cell_m;
  const Vec2 middle{plan.grid.x0_m + 0.5 * plan.grid.width_m(),
                    plan.grid.y0_m + 0.5 * plan.grid.height_m()};
  for (std::size_t i = 0; i < plan.grid.size(); ++i) {
    const Vec2 p = plan.grid.center(plan.grid.cell_at(i)) - middle;
    plan.heading_rad[i] = Heading::stored(std::atan2(p.y, p.x) + pi / 2 + 0.4);
    plan.region[i] = Region::free;
  }
}

TEST(Prover, KeepsTheRuleForEveryLeafItProves) {
  std::size_t decided = 0;
  std::size_t trapped = 0;
  for (std::uint64_t number = 0; number < 40; ++number) {
    Plan plan = random_plan(number);
    // Some without an end: most leave on the way.
    if (number % 4 == 0) turn_to_a_vortex(plan);
    const PlanFlow plan_flow(plan);
    const Flow flow = plan_flow.flow();
    const SectionVerdicts sections = proved(flow, 8);
    const std::vector<LeafPlace> places = places_of(sections);
    const ImageStore images = leaf_images(flow, places, most_crossings, always);
    for (std::size_t i = 0; i < places.size(); ++i) {
      SCOPED_TRACE("plan " + std::to_string(number));
      expect_rule(sections, places[i], i, images[i]);
      if (::testing::Test::HasFailure()) return;
      decided += sections.verdict[i] != 0;
      trapped += sections.verdict[i] == static_cast<std::uint8_t>(Verdict::trapped);
    }
  }
  EXPECT_GT(decided, 10000U);
  EXPECT_GT(trapped, 10U);
}

/// What is forgotten of leaves that are decided, or that can only be cut, changes nothing: not even
/// ranks, which count rounds.
TEST(Prover, ProvesTheSameWhetherItKeepsAllLinksOrNot) {
  std::size_t decided = 0;
  for (std::uint64_t number = 0; number < 60; ++number) {
    Plan plan = random_plan(number);
    if (number % 4 == 0) turn_to_a_vortex(plan);
    const PlanFlow plan_flow(plan);
    const Flow flow = plan_flow.flow();
    Prover lean(flow, undecided_sections(flow, 2), most_crossings, always);
    Prover full(flow, undecided_sections(flow, 2), most_crossings, always,
                LeafGraph::Keep::all_links);
    for (int level = 2; level <= 9; ++level) {
      lean.settle(std::ldexp(1.0, 32 - level));
      full.settle(std::ldexp(1.0, 32 - level));
    }
    EXPECT_EQ(lean.graph().undecided(), full.graph().undecided());
    const SectionVerdicts kept = full.graph().sections();
    const SectionVerdicts same = lean.into_sections();
    ASSERT_EQ(same.first, kept.first) << number;
    ASSERT_EQ(same.begin, kept.begin) << number;
    ASSERT_EQ(same.verdict, kept.verdict) << number;
    ASSERT_EQ(same.rank, kept.rank) << number;
    ASSERT_EQ(same.time_s, kept.time_s) << number;
    for (const std::uint8_t verdict : same.verdict) decided += verdict != 0;
  }
  EXPECT_GT(decided, 20000U);
}

TEST(Prover, ProvesForPlacesWhatExactFlightsDoAndWithinTheTime) {
  Random random(2);
  int flown = 0;
  for (std::uint64_t number = 0; number < 40; ++number) {
    const Plan plan = random_plan(number);
    const PlanFlow plan_flow(plan);
    const Flow flow = plan_flow.flow();
    const WideCommands<Wide> commands(flow);
    const SectionVerdicts sections = proved(flow, 8);
    const std::vector<LeafPlace> places = places_of(sections);
    for (int i = 0; i < 40 && !places.empty(); ++i) {
      const std::size_t leaf = random.below(places.size());
      const LeafPlace& place = places[leaf];
      const auto verdict = static_cast<Verdict>(sections.verdict[leaf]);
      if (verdict == Verdict::undecided) continue;
      // Ends of leaves on purpose: a place on a seam belongs to both.
      const double width =
          static_cast<double>(place.range.hi) - static_cast<double>(place.range.lo);
      const double share =
          random.below(3) == 0 ? static_cast<double>(random.below(2)) : random.unit();
      const double at =
          flow.grid.cell_m * 0x1p-32 * (static_cast<double>(place.range.lo) + share * width);
      const auto side = static_cast<Side>(place.section % 4);
      const Wide line(cell_enclosure::is_far(side) ? 0.0 : flow.grid.cell_m);
      const WideVec<Wide> p = cell_enclosure::is_vertical(side) ? WideVec<Wide>{line, Wide(at)}
                                                                : WideVec<Wide>{Wide(at), line};
      const Front front = front_of_section(flow, place.section, 0.0);
      WideFlight<Wide> flight(commands, front.ix, front.iy, p, commands.unit[place.section / 4],
                              [&](std::size_t n) { return random.below(n); });
      const auto end = flight.fly_to_end(3000);
      if (end.end == Verdict::undecided) continue;
      ++flown;
      ASSERT_EQ(name_of(end.end), name_of(verdict))
          << "plan " << number << " section " << place.section << " at " << at;
      if (verdict == Verdict::trapped) continue;
      ASSERT_LE(static_cast<double>(end.length_m) / flow.vehicle.speed_mps,
                static_cast<double>(sections.time_s[leaf]) * (1 + 1e-9))
          << "plan " << number << " section " << place.section << " at " << at;
    }
  }
  EXPECT_GT(flown, 500);
}

TEST(Prover, ConcludesNothingFromNothing) {
  EXPECT_EQ(VerdictSet{}.only(), Verdict::undecided);
  const SectionVerdicts none = undecided_sections(Flow{}, 0);
  EXPECT_EQ(verdicts_of(Image{}, none.view()).only(), Verdict::undecided);
  // A piece on a section without leaves.
  const Plan plan = empty_plan(3, 3, 1.0, 2.0);
  const PlanFlow plan_flow(plan);
  const SectionVerdicts sections = proved(plan_flow.flow(), 4);
  const ImagePiece backwards{
      static_cast<std::uint32_t>(section_of(4, Side::left)), {0, 9}, 0.0F, false};
  Image image;
  image.ends.add(Verdict::leave, 0.0);
  image.pieces = std::span(&backwards, 1);
  EXPECT_EQ(verdicts_of(image, sections.view()).only(), Verdict::undecided);
  // Two different verdicts give none.
  VerdictSet both;
  both.add(Verdict::reach, 1.0);
  both.add(Verdict::trapped, 1.0);
  EXPECT_EQ(both.only(), Verdict::undecided);
}

TEST(Prover, FreesAllOfATrapByOneLeak) {
  // A vortex, leaning inwards: all its section is trapped; with one cell blocked, less of it is,
  // and states that fly into that cell are not.
  Plan plan = empty_plan(16, 16, 2.0, 5.0);
  for (std::size_t i = 0; i < plan.grid.size(); ++i) {
    const Vec2 p = plan.grid.center(plan.grid.cell_at(i)) - Vec2{16.0, 16.0};
    plan.heading_rad[i] = Heading::stored(std::atan2(p.y, p.x) + pi / 2 + 0.3);
  }
  const auto count = [](const SectionVerdicts& sections, Verdict verdict) {
    return std::count(sections.verdict.begin(), sections.verdict.end(),
                      static_cast<std::uint8_t>(verdict));
  };
  const PlanFlow closed(plan);
  const SectionVerdicts before = proved(closed.flow(), 8);
  EXPECT_GT(count(before, Verdict::trapped), 100);
  EXPECT_EQ(count(before, Verdict::reach), 0);
  // Targets all around the centre: every orbit meets one.
  for (std::size_t i = 0; i < plan.grid.size(); ++i) {
    if (plan.grid.cell_at(i).iy == 8 && plan.grid.cell_at(i).ix >= 8) {
      plan.region[i] = Region::goal;
    }
  }
  const PlanFlow open(plan);
  const SectionVerdicts after = proved(open.flow(), 8);
  EXPECT_EQ(count(after, Verdict::trapped), 0);
  EXPECT_GT(count(after, Verdict::reach), 100);
}

TEST(Prover, StoppedSaysUndecidedAndNothingElse) {
  const Plan plan = random_plan(5);
  const PlanFlow plan_flow(plan);
  const Flow flow = plan_flow.flow();
  Prover prover(flow, undecided_sections(flow, 3), most_crossings, [] { return false; });
  EXPECT_FALSE(prover.settle(0x1p20));
  EXPECT_EQ(prover.graph().undecided(), prover.graph().leaves());
}

TEST(LeastMove, IsTheMoveOfTheEndThatWasNotCut) {
  const auto move = [](UnitRange hop, UnitRange leaf) {
    return least_move({0, hop, 0.0F, true}, leaf);
  };
  EXPECT_EQ(move({30, 60}, {10, 40}), 20.0);                // upwards
  EXPECT_EQ(move({0, 30}, {10, 40}), 10.0);                 // downwards
  EXPECT_EQ(move({10, 40}, {10, 40}), 0.0);                 // possibly not at all
  EXPECT_EQ(move({9, 41}, {10, 40}), 0.0);                  // within rounding of not at all
  EXPECT_EQ(move({30, 0xffffffff}, {10, 0xffffffff}), 20);  // cut at the side's end
  EXPECT_EQ(move({0, 25}, {0, 40}), 15.0);                  // and at its start
}

TEST(Units, HoldThePlacesTheyCameFromAndOneMoreEitherSide) {
  Random random(6);
  for (int i = 0; i < 20000; ++i) {
    const double d = std::exp(random.uniform(-3.0, 5.0));
    const double a = random.below(5) == 0 ? 0.0 : random.unit() * d;
    const double b = random.below(5) == 0 ? d : a + random.unit() * (d - a);
    const UnitRange units = units_of({a, b}, d);
    const double scale = 0x1p32 / d;
    ASSERT_LE(units.lo, std::max(0.0, a * scale - 0.9));
    ASSERT_TRUE(units.hi >= std::min(b * scale + 0.9, 4294967295.0)) << b << " of " << d;
    const Interval back = along_of(units, d);
    ASSERT_LE(back.lo, a);
    ASSERT_GE(back.hi, b);
    ASSERT_GE(back.lo, 0.0);
    ASSERT_LE(back.hi, d);
  }
}

}  // namespace
}  // namespace fairway
