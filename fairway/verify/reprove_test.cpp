// Leaves from outside: what is true is kept, and nothing else.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "fairway/base/random.hpp"
#include "fairway/verify/certify.hpp"
#include "fairway/verify/images.hpp"
#include "fairway/verify/reprove.hpp"
#include "fairway/verify/testing/plans_to_verify.hpp"

namespace fairway {
namespace {

constexpr int most_crossings = CertifyOptions{}.most_crossings;
constexpr float infinite = std::numeric_limits<float>::infinity();

CertifyOptions options_to(int level) {
  CertifyOptions options;
  options.samples = 1000;
  options.undecided_max = 0.0;
  options.last_level = level;
  return options;
}

struct Proved {
  explicit Proved(std::uint64_t seed, int level = 6) : plan(random_plan(seed)), loop(plan) {
    sections = certify(loop.flow(), loop.is_free, options_to(level)).sections;
  }
  Plan plan;
  PlanFlow loop;
  SectionVerdicts sections;
};

std::vector<VerdictSet> answers(const Proved& proved, const SectionVerdicts& sections) {
  Random random(4);
  std::vector<Place> states;
  const Grid& g = proved.plan.grid;
  for (int i = 0; i < 500; ++i) {
    states.push_back({g.x0_m + random.unit() * g.width_m(), g.y0_m + random.unit() * g.height_m(),
                      random.uniform(-pi, pi)});
  }
  const ImageStore images =
      state_images(proved.loop.flow(), states, most_crossings, [] { return true; });
  std::vector<VerdictSet> found;
  for (std::size_t i = 0; i < states.size(); ++i) {
    found.push_back(verdicts_of(images[i], sections.view()));
  }
  return found;
}

/// Everything decided is decided in `truth`, with that verdict, and no time is shorter.
void expect_true(const SectionVerdicts& said, const Proved& truth, const std::string& what) {
  const auto a = answers(truth, said);
  const auto b = answers(truth, truth.sections);
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i].only() == Verdict::undecided || b[i].only() == Verdict::undecided) continue;
    ASSERT_EQ(a[i].only(), b[i].only()) << what;
  }
}

TEST(Reprove, KeepsAllThatWasProved) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    const Proved p(seed);
    const SectionVerdicts again = reproved(p.loop.flow(), p.sections, most_crossings);
    EXPECT_EQ(again.verdict, p.sections.verdict) << seed;
    EXPECT_EQ(again.rank, p.sections.rank) << seed;
    EXPECT_EQ(again.time_s, p.sections.time_s) << seed;
  }
}

TEST(Reprove, KeepsNoFalseClaim) {
  struct Lie {
    const char* name;
    std::function<void(SectionVerdicts&, std::size_t, Random&)> tell;
  };
  const auto say = [](Verdict verdict, std::uint32_t rank, float time_s) {
    return [=](SectionVerdicts& s, std::size_t i, Random&) {
      s.verdict[i] = static_cast<std::uint8_t>(verdict);
      s.rank[i] = rank;
      s.time_s[i] = time_s;
    };
  };
  const std::vector<Lie> lies{
      {"all reach", say(Verdict::reach, 0, 0.5F)},
      {"all reach, late", say(Verdict::reach, 0xffffffffU, 1e30F)},
      {"all reach, never", say(Verdict::reach, 5, infinite)},
      {"all collide", say(Verdict::collide, 0x7fffffffU, 1e30F)},
      {"all leave", say(Verdict::leave, 1, 1e30F)},
      {"all trapped", say(Verdict::trapped, 0, infinite)},
      {"trapped in part",
       [&](SectionVerdicts& s, std::size_t i, Random& random) {
         if (random.below(2) == 0) say(Verdict::trapped, 7, infinite)(s, i, random);
       }},
      {"verdicts at random",
       [](SectionVerdicts& s, std::size_t i, Random& random) {
         s.verdict[i] = static_cast<std::uint8_t>(random.below(5));
       }},
      {"faster", [](SectionVerdicts& s, std::size_t i, Random&) { s.time_s[i] *= 0.5F; }},
      {"ranks at random", [](SectionVerdicts& s, std::size_t i, Random& random) {
         s.rank[i] = static_cast<std::uint32_t>(random.bits() >> random.below(64));
       }}};
  for (std::uint64_t seed = 0; seed < 24; ++seed) {
    const Proved truth(seed);
    for (const Lie& lie : lies) {
      Random random(seed);
      SectionVerdicts told = truth.sections;
      for (std::size_t i = 0; i < told.leaves(); ++i) lie.tell(told, i, random);
      const SectionVerdicts kept = reproved(truth.loop.flow(), told, most_crossings);
      const std::string what = std::string(lie.name) + ", plan " + std::to_string(seed);
      expect_true(kept, truth, what);
      // And continuing from there gives a proof again, by the same rule.
      const SectionVerdicts on =
          certify(truth.loop.flow(), truth.loop.is_free, options_to(5), kept).sections;
      const SectionVerdicts again = reproved(truth.loop.flow(), on, most_crossings);
      EXPECT_EQ(again.verdict, on.verdict) << what;
      EXPECT_EQ(again.rank, on.rank) << what;
      expect_true(on, truth, what);
    }
  }
}

TEST(Reprove, WhatIsNotFlownInTimeIsUndecidedAndTheRestIsStillProved) {
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    const Proved truth(seed, 7);
    const auto decided = [](const SectionVerdicts& s) {
      return s.leaves() -
             static_cast<std::size_t>(std::count(s.verdict.begin(), s.verdict.end(), 0));
    };
    for (const int blocks : {0, 1, 3}) {
      std::atomic<int> flown = 0;
      const SectionVerdicts kept = reproved(truth.loop.flow(), truth.sections, most_crossings,
                                            [&] { return flown++ < blocks; });
      expect_true(kept, truth, "seed " + std::to_string(seed));
      EXPECT_LE(decided(kept), decided(truth.sections));
      if (blocks == 0) {
        EXPECT_EQ(decided(kept), 0U);
      }
    }
    EXPECT_EQ(decided(reproved(truth.loop.flow(), truth.sections, most_crossings)),
              decided(truth.sections));
  }
}

TEST(Reprove, TimesThatAreTooShortAreNotKept) {
  const Proved truth(4, 7);
  SectionVerdicts told = truth.sections;
  std::size_t later = 0;  // leaves from which some time passes
  for (std::size_t i = 0; i < told.leaves(); ++i) {
    if (told.verdict[i] == 0 || told.verdict[i] == 4) continue;
    told.time_s[i] = 0.0F;
    ++later;
  }
  ASSERT_GT(later, 10U);
  const SectionVerdicts kept = reproved(truth.loop.flow(), told, most_crossings);
  for (std::size_t i = 0; i < kept.leaves(); ++i)
    EXPECT_TRUE(kept.verdict[i] == 0 || kept.verdict[i] == 4);
}

TEST(Reprove, SectionsMustBeThoseOfTheFlow) {
  Proved p(1);
  EXPECT_TRUE(sections_fit(p.loop.flow(), p.sections));
  for (CellKind& kind : p.loop.kind) kind = CellKind::ordinary;
  p.loop.kind[p.plan.grid.size() / 2] = CellKind::obstacle;
  EXPECT_FALSE(sections_fit(p.loop.flow(), p.sections));
  p.sections.first.pop_back();
  EXPECT_FALSE(sections_fit(p.loop.flow(), p.sections));
}

}  // namespace
}  // namespace fairway
