#include "fairway/verify/hand_over.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "fairway/base/heading.hpp"
#include "fairway/base/random.hpp"
#include "fairway/field/direction_field.hpp"
#include "fairway/verify/ask_modes.hpp"
#include "fairway/verify/certify.hpp"
#include "fairway/verify/mode_choice.hpp"
#include "fairway/verify/section_flight.hpp"
#include "fairway/verify/state_flight.hpp"
#include "fairway/verify/testing/plans_to_verify.hpp"

namespace fairway {
namespace {

constexpr int most_crossings = 1000;

/// A plan with its modes, proved.
struct Modal {
  Plan plan;
  PlanFlow of_plan;
  Certified proved;

  Modal(Plan made, CertifyOptions options) : plan(std::move(made)), of_plan(plan) {
    options.samples = 1000;
    proved = certify(of_plan.flow(), of_plan.is_free, options, {}, {}, plan.further_rad());
  }
  Modal(const Modal&) = delete;
  Modal& operator=(const Modal&) = delete;

  ProofView view() const {
    return {of_plan.flow(), proved.sections.view(), static_cast<int>(plan.further_modes()),
            plan.mode_heading_rad.data(), proved.further.view()};
  }
};

CertifyOptions usual_options() {
  CertifyOptions options;
  options.last_level = 8;
  return options;
}

/// A random plan with `modes` further random fields, some of them smooth.
Plan random_modal_plan(std::uint64_t seed, int modes) {
  Plan plan = random_plan(seed);
  Random random = Random::stream(0x30de, seed);
  for (int k = 0; k < modes; ++k) {
    const double turn = random.uniform(-pi, pi);
    const bool is_rough = random.below(4) == 0;
    for (std::size_t i = 0; i < plan.grid.size(); ++i) {
      const double rad = is_rough ? random.uniform(-pi, pi) : turn + random.uniform(-0.2, 0.2);
      const bool none = random.below(30) == 0;
      plan.mode_heading_rad.push_back(none ? NAN : Heading::stored(rad));
    }
    plan.record.modes.push_back({"direction", turn});
  }
  return plan;
}

/// Calls with every leaf of every further mode: mode, section, leaf, its range.
template <typename Body>
void for_mode_leaves(const Modal& m, const Body& body) {
  const SectionVerdicts& s = m.proved.further;
  const std::size_t sections = 4 * m.plan.grid.size();
  for (std::size_t n = 0; n + 1 < s.first.size(); ++n) {
    for (std::size_t leaf = s.first[n]; leaf < s.first[n + 1]; ++leaf) {
      body(static_cast<int>(n / sections) + 1, n % sections, leaf, s.range_of(n, leaf));
    }
  }
}

TEST(HandOver, LeavesOfAllModesObeyTheRule) {
  std::size_t handed_over = 0;
  std::size_t by_themselves = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE("random plan " + std::to_string(seed));
    const Modal m(random_modal_plan(seed, 3), usual_options());
    const ProofView proof = m.view();
    const SectionVerdicts& s = m.proved.further;
    for_mode_leaves(m, [&](int mode, std::size_t section, std::size_t leaf, UnitRange range) {
      if (s.verdict[leaf] != static_cast<std::uint8_t>(Verdict::reach)) {
        EXPECT_EQ(s.verdict[leaf], static_cast<std::uint8_t>(Verdict::undecided));
        EXPECT_TRUE(s.next_mode.empty() || s.next_mode[leaf] == no_mode);
        return;
      }
      const Flow flow = proof.flow_of(mode);
      if (s.next_mode[leaf] != no_mode) {
        ++handed_over;
        ASSERT_LT(s.next_mode[leaf], mode);
        EXPECT_EQ(s.rank[leaf], 0U);
        const std::array<ModeView, 1> to{
            {{proof.flow_of(s.next_mode[leaf]), proof.sections_of(s.next_mode[leaf])}}};
        const HandOver again =
            hand_over(flow, {static_cast<std::uint32_t>(section), range}, to, most_crossings);
        ASSERT_EQ(again.mode, 0);
        EXPECT_LE(again.time_s, s.time_s[leaf]);
        return;
      }
      ++by_themselves;
      const std::vector<LeafPlace> place{{static_cast<std::uint32_t>(section), range}};
      const ImageStore images = leaf_images(flow, place, most_crossings, [] { return true; });
      ASSERT_TRUE(images[0].ends.bits != 0 || !images[0].pieces.empty());
      for (const ImagePiece& piece : images[0].pieces) {
        if (piece.hop && piece.section == section) continue;
        proof.sections_of(mode).for_leaves(piece.section, piece.range, [&](std::size_t other) {
          EXPECT_EQ(s.verdict[other], s.verdict[leaf]);
          EXPECT_LT(s.rank[other], s.rank[leaf]);
          EXPECT_LE(piece.flown_s + s.time_s[other], s.time_s[leaf] * (1.0F + 1e-5F));
        });
      }
    });
  }
  EXPECT_GT(handed_over, 500U);
  EXPECT_GT(by_themselves, 100U);
}

/// Places inside leaves that are handed over, each on its own: what holds of a set holds of them.
TEST(HandOver, EveryPlaceOfALeafThatIsHandedOverReachesInTime) {
  std::size_t places = 0;
  std::size_t timed = 0;
  for (std::uint64_t seed = 100; seed < 140; ++seed) {
    SCOPED_TRACE("random plan " + std::to_string(seed));
    const Modal m(random_modal_plan(seed, 2), usual_options());
    const ProofView proof = m.view();
    const SectionVerdicts& s = m.proved.further;
    Random random = Random::stream(seed, 3);
    for_mode_leaves(m, [&](int mode, std::size_t section, std::size_t leaf, UnitRange range) {
      if (s.next_mode.empty() || s.next_mode[leaf] == no_mode) return;
      const Cell cell = m.plan.grid.cell_at(section / 4);
      const auto side = static_cast<Side>(section % 4);
      const Vec2 corner = m.plan.grid.corner(cell);
      const double d = m.plan.grid.cell_m;
      for (const double part : {0.0, 1.0, random.unit(), random.unit()}) {
        const double along = d * (range.lo + part * (range.hi - range.lo)) / units_per_side;
        const Vec2 p = side == Side::right  ? Vec2{d, along}
                       : side == Side::left ? Vec2{0.0, along}
                       : side == Side::top  ? Vec2{along, d}
                                            : Vec2{along, 0.0};
        const VerdictSet found =
            ask_mode(proof, s.next_mode[leaf], corner.x + p.x, corner.y + p.y,
                     static_cast<double>(proof.flow_of(mode).heading_rad[section / 4]));
        // On the border within rounding: the set of places may touch what the leaf does not.
        if (found.only() == Verdict::undecided && (part == 0.0 || part == 1.0)) continue;
        ++places;
        if (found.only() == Verdict::undecided) continue;
        EXPECT_EQ(found.only(), Verdict::reach);
        // The query's bound may be looser: it takes the heading as known within rounding. That of
        // the place alone, as a leaf with its exact heading, may not.
        const auto unit = static_cast<std::uint32_t>(along / d * units_per_side);
        if (unit < range.lo || unit > range.hi) continue;
        const std::array<ModeView, 1> to{
            {{proof.flow_of(s.next_mode[leaf]), proof.sections_of(s.next_mode[leaf])}}};
        const HandOver alone =
            hand_over(proof.flow_of(mode), {static_cast<std::uint32_t>(section), {unit, unit}}, to,
                      most_crossings);
        EXPECT_EQ(alone.mode, 0);
        ++timed;
        EXPECT_LE(alone.time_s, s.time_s[leaf] * (1.0 + 1e-6));
      }
    });
  }
  EXPECT_GT(places, 1000U);
  EXPECT_GT(timed, 300U);
}

TEST(HandOver, AModeLikeTheFirstAddsNothing) {
  for (const std::uint64_t seed : {3U, 8U, 21U}) {
    Plan plan = random_plan(seed);
    plan.mode_heading_rad = plan.heading_rad;
    plan.record.modes.push_back({"direction", 0.0});
    const Modal m(plan, usual_options());
    ASSERT_EQ(m.proved.volume.reach_by_mode.size(), 2U);
    EXPECT_EQ(m.proved.volume.reach_by_mode[1], 0.0);
  }
}

TEST(HandOver, TheFirstModeIsProvedAsWithoutOthers) {
  const Plan plan = random_modal_plan(5, 3);
  Plan alone = plan;
  alone.mode_heading_rad.clear();
  alone.record.modes.clear();
  const Modal with(plan, usual_options());
  const Modal without(alone, usual_options());
  EXPECT_EQ(with.proved.sections.begin, without.proved.sections.begin);
  EXPECT_EQ(with.proved.sections.verdict, without.proved.sections.verdict);
  EXPECT_EQ(with.proved.sections.time_s, without.proved.sections.time_s);
  EXPECT_GE(with.proved.volume.all[1], without.proved.volume.all[1]);
}

TEST(HandOver, WithoutEarlierModesNothingIsHandedOver) {
  const Plan plan = random_plan(4);
  const PlanFlow of_plan(plan);
  for (std::uint32_t s = 0; s < 4 * plan.grid.size(); ++s) {
    if (!is_section(of_plan.flow(), s)) continue;
    const HandOver none = hand_over(of_plan.flow(), {s, {0, 0xffffffffU}}, {}, most_crossings);
    EXPECT_EQ(none.mode, no_mode);
    EXPECT_FALSE(none.in_part);
  }
}

/// A wall fills the upper half beyond a border. The earlier mode reaches from the lower half.
TEST(HandOver, ALeafBesideAnObstacleIsHandedOverOnlyInPart) {
  Plan plan = empty_plan(6, 2, 1.0, 1.5);
  for (std::size_t i = 0; i < plan.grid.size(); ++i) {
    const Cell c = plan.grid.cell_at(i);
    if (c.iy == 1 && c.ix >= 2) plan.region[i] = Region::obstacle;
    if (c.ix == 5 && c.iy == 0) plan.region[i] = Region::goal;
  }
  const PlanFlow first(plan);
  const Certified proved = certify(first.flow(), first.is_free, usual_options());
  std::vector<float> up(plan.grid.size(), Heading::stored(0.5));
  Flow other = first.flow();
  other.heading_rad = up.data();
  const std::array<ModeView, 1> earlier{{{first.flow(), proved.sections.view()}}};
  const auto right_of = [&](int ix) {
    return static_cast<std::uint32_t>(4 * plan.grid.index({ix, 0}) +
                                      static_cast<std::size_t>(Side::right));
  };
  const HandOver whole = hand_over(other, {right_of(1), {0, 0xffffffffU}}, earlier, 1000);
  EXPECT_EQ(whole.mode, no_mode);
  EXPECT_TRUE(whole.in_part);
  const HandOver low = hand_over(other, {right_of(1), {0, 0x40000000U}}, earlier, 1000);
  EXPECT_EQ(low.mode, 0);
  EXPECT_GT(low.time_s, 0.0);
}

TEST(ProveModes, TheSameLeavesOnAnyNumberOfThreads) {
  const Plan plan = random_modal_plan(11, 4);
  const auto proved_on = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return Modal(plan, usual_options()).proved.further;
  };
  const SectionVerdicts one = proved_on(1);
  const SectionVerdicts two = proved_on(2);
  EXPECT_EQ(one.begin, two.begin);
  EXPECT_EQ(one.verdict, two.verdict);
  EXPECT_EQ(one.rank, two.rank);
  EXPECT_EQ(one.time_s, two.time_s);
  EXPECT_EQ(one.next_mode, two.next_mode);
}

/// Cut off before or among the modes, the result says so, and claims nothing of the rest.
TEST(ProveModes, ALimitIsToldAndLeavesAWholeCertificate) {
  const Plan plan = random_modal_plan(11, 4);
  CertifyOptions at_once = usual_options();
  at_once.time_limit_s = 1e-9;
  CertifyOptions small = usual_options();
  small.memory_limit_bytes = 1;
  for (const auto& [options, by] :
       {std::pair{at_once, StoppedBy::time_limit}, std::pair{small, StoppedBy::memory_limit}}) {
    const Modal m(plan, options);
    EXPECT_EQ(m.proved.stopped_by, by);
    EXPECT_EQ(m.proved.volume.reach_by_mode.size(), 5U);
    EXPECT_EQ(m.proved.further.first.size(), 4 * 4 * plan.grid.size() + 1);
    EXPECT_EQ(m.proved.further.first.back(), m.proved.further.leaves());
  }
}

/// The bound told at the start holds, and modes only go down, wherever the vehicle asks.
TEST(ModeChoice, NeverGoesUpAndNeverLater) {
  std::size_t changes = 0;
  for (std::uint64_t seed = 0; seed < 80; ++seed) {
    const Modal m(random_modal_plan(seed, 3), usual_options());
    const ProofView proof = m.view();
    Random random = Random::stream(seed, 9);
    const Grid& g = m.plan.grid;
    for (int n = 0; n < 20; ++n) {
      const double x = random.unit() * g.width_m();
      const double y = random.unit() * g.height_m();
      ModeChoice choice(proof);
      const ProvedState begun = choice.at(x, y, random.uniform(-pi, pi));
      if (begun.verdict != Verdict::reach || begun.mode == 0) continue;
      // Somewhere else, as after a gust: if it is proved there, it goes on with one that is.
      const double h = random.uniform(-pi, pi);
      const double x2 = x + 0.3 * g.cell_m * random.unit();
      const ProvedState all = ask_all_modes(proof, x2, y, h);
      const ProvedState now = choice.at(x2, y, h);
      EXPECT_EQ(now.verdict == Verdict::reach, all.verdict == Verdict::reach);
      const VerdictSet own = ask_mode(proof, begun.mode, x2, y, h);
      if (own.only() == Verdict::reach) {
        EXPECT_LE(now.mode, begun.mode);
        EXPECT_LE(now.time_s, own.time_s);
        changes += now.mode < begun.mode ? 1 : 0;
      }
    }
  }
  EXPECT_GT(changes, 10U);
}

/// A street to the right in which three modes differ. Left of x = 2, only mode 2 goes on along it;
/// from there, only modes 0 and 1 do, and mode 0 weaves: it takes longer, and brings only those in
/// the lower half.
Plan plan_with_a_slower_first_mode() {
  Plan plan = empty_plan(12, 3, 1.0, 1.5);
  std::vector<float> straight(plan.grid.size(), 0.0F);
  std::vector<float> at_first(plan.grid.size(), 0.0F);
  for (std::size_t i = 0; i < plan.grid.size(); ++i) {
    const Cell c = plan.grid.cell_at(i);
    plan.region[i] = c.iy != 1 ? Region::obstacle : c.ix == 11 ? Region::goal : Region::free;
    const bool is_left = c.ix < 2;
    plan.heading_rad[i] = is_left ? 1.5F : c.ix % 4 < 2 ? -0.3F : 0.3F;
    straight[i] = is_left ? 1.5F : 0.0F;
    at_first[i] = is_left ? 0.0F : -1.5F;
  }
  for (const std::vector<float>& mode : {straight, at_first}) {
    plan.mode_heading_rad.insert(plan.mode_heading_rad.end(), mode.begin(), mode.end());
    plan.record.modes.push_back({"direction", 0.0});
  }
  return plan;
}

TEST(ModeChoice, IsNotLaterThanToldWhereAnEarlierModeIsProvedButSlower) {
  const Modal m(plan_with_a_slower_first_mode(), usual_options());
  constexpr double begin = 1.03125;
  std::size_t slower = 0;
  for (double y = 1.25; y < 1.5; y += 0x1p-12) {
    ModeChoice choice(m.view());
    const ProvedState told = choice.at(begin, y, 0.0);
    // A leaf that mode 0 does not bring as a whole is handed over to mode 1: at some of its places
    // both are proved.
    const VerdictSet slow = ask_mode(m.view(), 0, 2.0, y, 0.0);
    if (told.mode != 2 || slow.only() != Verdict::reach) continue;
    if ((2.0 - begin) / m.plan.vehicle.speed_mps + slow.time_s < told.time_s + 0.003) continue;
    ++slower;
    for (const double x : {1.5, 1.75, 2.0}) {
      const ProvedState now = choice.at(x, y, 0.0);
      EXPECT_EQ(now.verdict, Verdict::reach) << x;
      EXPECT_EQ(now.mode, x < 2.0 ? 2 : 1) << x;
      const double flown_s = (x - begin) / m.plan.vehicle.speed_mps;
      EXPECT_LE(flown_s + now.time_s, told.time_s * (1.0 + 1e-6)) << x << ", " << y;
    }
  }
  EXPECT_GT(slower, 0U);
}

TEST(ModeChoice, SaysNothingOfAFurtherModeThatIsNotProved) {
  const Modal m(plan_with_a_slower_first_mode(), usual_options());
  ModeChoice choice(m.view());
  ASSERT_EQ(choice.at(0.5, 1.2, 0.0).mode, 2);
  // Blown off course, towards a wall: mode 0 is known to collide, but it is mode 2 that is flown.
  ASSERT_EQ(ask_mode(m.view(), 0, 0.5, 1.8, 1.5).only(), Verdict::collide);
  const ProvedState now = choice.at(0.5, 1.8, 1.5);
  EXPECT_EQ(now.mode, 2);
  EXPECT_EQ(now.verdict, Verdict::undecided);
  EXPECT_EQ(now.time_s, std::numeric_limits<double>::infinity());
  // Who begins there is told of mode 0, which it flies.
  ModeChoice other(m.view());
  EXPECT_EQ(other.at(0.5, 1.8, 1.5).verdict, Verdict::collide);
  EXPECT_EQ(other.mode(), 0);
}

}  // namespace
}  // namespace fairway
