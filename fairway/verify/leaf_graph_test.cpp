#include "fairway/verify/leaf_graph.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "fairway/base/error.hpp"
#include "fairway/base/random.hpp"
#include "fairway/verify/certify.hpp"
#include "fairway/verify/prover.hpp"
#include "fairway/verify/testing/plans_to_verify.hpp"
#include "fairway/verify/undecided_sections.hpp"

namespace fairway {
namespace {

using Id = LeafGraph::Id;
constexpr UnitRange whole{0, 0xffffffffU};
constexpr int most_crossings = 1000;
bool always() { return true; }

/// `sections` sections with `each` equal leaves.
SectionVerdicts even_sections(std::size_t sections, std::uint32_t each) {
  SectionVerdicts start;
  start.first.push_back(0);
  for (std::size_t s = 0; s < sections; ++s) {
    for (std::uint32_t k = 0; k < each; ++k) {
      start.begin.push_back(static_cast<std::uint32_t>((std::uint64_t{1} << 32) / each * k));
    }
    start.first.push_back(static_cast<std::uint32_t>(start.begin.size()));
  }
  start.rank.assign(start.leaves(), 0);
  start.verdict.assign(start.leaves(), 0);
  start.time_s.assign(start.leaves(), 0.0F);
  return start;
}

/// The same with vectors and exhaustive searches, which the graph must agree with.
struct PlainGraph {
  struct Piece {
    Id from;
    ImagePiece piece;
  };
  struct Decided {
    LeafPlace place;
    float time_s;
  };
  std::map<Id, LeafPlace> leaf;  // open
  std::vector<Decided> decided;
  std::vector<Piece> links;

  /// Start and id of each leaf there; none: decided.
  std::vector<std::pair<std::uint32_t, Id>> on(std::size_t section, UnitRange range) const {
    std::vector<std::pair<std::uint32_t, Id>> found;
    const auto add = [&](const LeafPlace& place, Id id) {
      if (place.section == section && overlap(place.range, range)) {
        found.emplace_back(place.range.lo, id);
      }
    };
    for (const auto& [id, place] : leaf) add(place, id);
    for (const Decided& it : decided) add(it.place, LeafGraph::none);
    std::sort(found.begin(), found.end());
    return found;
  }
  bool leads_to_decided(const ImagePiece& piece) const {
    const auto found = on(piece.section, piece.range);
    return std::all_of(found.begin(), found.end(),
                       [](const auto& it) { return it.second == LeafGraph::none; });
  }
  /// Of what a leaf waits for, what is decided by now: forgotten. The longest time there.
  double fold(Id id) {
    double time_s = 0.0;
    std::erase_if(links, [&](const Piece& link) {
      if (link.from != id || !leads_to_decided(link.piece)) return false;
      for (const Decided& it : decided) {
        if (it.place.section != link.piece.section) continue;
        if (!overlap(it.place.range, link.piece.range)) continue;
        time_s = std::max(time_s,
                          static_cast<double>(link.piece.flown_s) + static_cast<double>(it.time_s));
      }
      return true;
    });
    return time_s;
  }
  std::multiset<Id> into(std::size_t section, UnitRange range) const {
    std::multiset<Id> from;
    for (const Piece& link : links) {
      if (link.piece.section == section && overlap(link.piece.range, range)) from.insert(link.from);
    }
    return from;
  }
  std::size_t links_of(Id id) const {
    return static_cast<std::size_t>(
        std::count_if(links.begin(), links.end(), [id](const Piece& it) { return it.from == id; }));
  }
  void forget(Id id) {
    std::erase_if(links, [id](const Piece& link) { return link.from == id; });
  }
};

UnitRange random_range(Random& random) {
  const auto a = static_cast<std::uint32_t>(random.below(0x100000000U));
  const auto width = static_cast<std::uint32_t>(std::exp(22.0 * random.unit()));
  return {a, a > 0xffffffffU - width ? 0xffffffffU : a + width};
}

TEST(LeafGraph, AgreesWithAPlainOneWhateverIsCutLinkedAndDecided) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    Random random(seed);
    constexpr std::size_t sections = 5;
    LeafGraph graph(even_sections(sections, 1U << random.below(4)));
    PlainGraph plain;
    for (Id id = 0; id < graph.ids(); ++id) plain.leaf[id] = graph.place(id);
    for (int step = 0; step < 300; ++step) {
      const Id id = static_cast<Id>(random.below(graph.ids()));
      if (!graph.is_open(id)) continue;
      const std::uint64_t act = random.below(6);
      if (act == 0 && width_of(graph.place(id).range) > 4.0) {
        const LeafPlace whole_leaf = graph.place(id);
        const Id high = graph.cut(id);
        plain.forget(id);
        plain.leaf[id] = graph.place(id);
        plain.leaf[high] = graph.place(high);
        ASSERT_EQ(graph.place(id).range.lo, whole_leaf.range.lo);
        ASSERT_EQ(graph.place(id).range.hi, graph.place(high).range.lo);
        ASSERT_EQ(graph.place(high).range.hi, whole_leaf.range.hi);
        ASSERT_TRUE(graph.links(id).empty());
      } else if (act == 1) {
        const auto time_s = static_cast<float>(random.unit());
        graph.decide(id, Verdict::reach, 7, time_s);
        ASSERT_FALSE(graph.is_open(id));
        graph.release(id);
        plain.forget(id);
        plain.decided.push_back({plain.leaf[id], time_s});
        plain.leaf.erase(id);
      } else {
        if (act != 2) {
          std::vector<ImagePiece> pieces(random.below(4));
          for (ImagePiece& piece : pieces) {
            piece = {static_cast<std::uint32_t>(random.below(sections)), random_range(random),
                     static_cast<float>(random.unit()), false};
          }
          Image image;
          image.pieces = pieces;
          graph.keep_image(id, image);
          plain.forget(id);
          ASSERT_EQ(graph.links(id).size(), pieces.size());
          for (std::size_t k = 0; k < pieces.size(); ++k) {
            ASSERT_EQ(graph.links(id)[k].section, pieces[k].section);
          }
          for (const ImagePiece& piece : pieces) plain.links.push_back({id, piece});
        }
        const double ended_s = graph.ends(id).time_s;
        const std::size_t links = plain.links_of(id);
        graph.await_links(id);
        const double folded_s = plain.fold(id);
        ASSERT_EQ(graph.links(id).size(), plain.links_of(id));
        ASSERT_GE(graph.ends(id).time_s, std::max(ended_s, folded_s));
        ASSERT_LE(graph.ends(id).time_s, std::max(ended_s, folded_s * (1.0 + 1e-12)));
        if (graph.links(id).size() < links) {
          ASSERT_EQ(graph.ends(id).only(), Verdict::reach);
        }
      }
      ASSERT_EQ(graph.leaves(), plain.leaf.size() + plain.decided.size());
      ASSERT_EQ(graph.undecided(), plain.leaf.size());
      const std::size_t section = random.below(sections);
      const UnitRange range = random.below(4) == 0 ? whole : random_range(random);
      std::vector<std::pair<std::uint32_t, Id>> found;
      graph.for_leaves(section, range, [&](const LeafGraph::Leaf& leaf) {
        found.emplace_back(leaf.begin, leaf.id);
      });
      ASSERT_EQ(found, plain.on(section, range)) << "seed " << seed << " step " << step;
      std::multiset<Id> from;
      graph.for_dependents(section, range, [&](Id leaf) { from.insert(leaf); });
      ASSERT_EQ(from, plain.into(section, range)) << "seed " << seed << " step " << step;
    }
    ASSERT_LE(graph.ids(), plain.leaf.size() + plain.decided.size());
  }
}

TEST(LeafGraph, GivesBackTheLeavesItBeganWith) {
  SectionVerdicts start = even_sections(3, 4);
  start.verdict[5] = static_cast<std::uint8_t>(Verdict::leave);
  start.rank[5] = 3;
  start.time_s[5] = 2.5F;
  const LeafGraph graph(start);
  const SectionVerdicts back = graph.sections();
  EXPECT_EQ(back.first, start.first);
  EXPECT_EQ(back.begin, start.begin);
  EXPECT_EQ(back.rank, start.rank);
  EXPECT_EQ(back.verdict, start.verdict);
  EXPECT_EQ(back.time_s, start.time_s);
  EXPECT_EQ(graph.highest_rank(), 3U);
  EXPECT_EQ(graph.undecided(), 11U);
}

TEST(LeafGraph, FreesWhatDecidedLeavesHeldAndUsesItAgain) {
  LeafGraph graph(even_sections(1, 8));
  const ImagePiece pieces[3]{{0, {0, 9}, 1.0F, false}, {0, {5, 70}, 1.0F, false}, {}};
  Image image;
  image.pieces = pieces;
  for (Id id = 0; id < 4; ++id) graph.set_image(id, image);
  const std::size_t before = graph.bytes();
  for (Id id = 0; id < 4; ++id) graph.decide(id, Verdict::reach, 1, 1.0F);
  for (Id id = 4; id < 8; ++id) graph.set_image(id, image);
  EXPECT_LE(graph.bytes(), before + 200);  // the free list
  const Id ids = graph.ids();
  for (Id id = 0; id < 4; ++id) graph.release(id);
  for (Id id = 4; id < 8; ++id) graph.cut(id);
  EXPECT_EQ(graph.ids(), ids);
  EXPECT_EQ(graph.leaves(), 12U);
}

TEST(LeafGraph, KnowsAHopOntoItsOwnSectionByHowFarItMoves) {
  LeafGraph graph(even_sections(2, 1));
  const Id id = 0;
  graph.cut(id);
  const UnitRange own = graph.place(id).range;
  const ImagePiece pieces[3]{{0, {own.lo + 1000, own.hi + 1000}, 1.0F, true},
                             {0, {own.lo + 1000, own.hi + 1000}, 1.0F, false},
                             {1, {own.lo + 1000, own.hi + 1000}, 1.0F, true}};
  Image image;
  image.pieces = pieces;
  graph.set_image(id, image);
  EXPECT_EQ(graph.own_move(id, graph.links(id)[0]), 1000.0);
  EXPECT_EQ(graph.own_move(id, graph.links(id)[1]), 0.0);
  EXPECT_EQ(graph.own_move(id, graph.links(id)[2]), 0.0);
}

TEST(LeafGraph, ThatDoesNotKeepLinksCannotBeInvalidated) {
  const Plan plan = empty_plan(3, 3, 1.0, 2.0);
  const PlanFlow owner(plan);
  LeafGraph graph(undecided_sections(owner.flow(), 2));
  EXPECT_THROW((void)graph.invalidate(owner.flow(), std::vector<bool>(9, true)),
               PreconditionViolation);
}

/// Every leaf proved after commands were changed has a verdict that a proof from scratch does not
/// contradict, and no more is undecided than a proof from scratch leaves.
TEST(LeafGraph, AfterAnInvalidationProvesWhatAProofFromScratchProves) {
  std::size_t changed_verdicts = 0;
  std::size_t kept = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    Random random(1000 + seed);
    Plan plan = random_plan(seed);
    PlanFlow owner(plan);
    const Flow flow = owner.flow();
    Prover prover(flow, undecided_sections(flow, 2), most_crossings, always,
                  LeafGraph::Keep::all_links);
    const auto settle = [](Prover& p) {
      for (int level = 2; level <= 7; ++level) p.settle(std::ldexp(1.0, 32 - level));
    };
    settle(prover);
    const SectionVerdicts before = prover.graph().sections();
    for (int change = 0; change < 3; ++change) {
      std::vector<bool> changed(plan.grid.size(), false);
      for (int k = 0; k < 2; ++k) {
        const std::size_t cell = random.below(plan.grid.size());
        changed[cell] = true;
        plan.heading_rad[cell] = random.below(6) == 0 ? std::numeric_limits<float>::quiet_NaN()
                                                      : Heading::stored(random.uniform(-pi, pi));
        if (random.below(4) == 0) {
          owner.kind[cell] = static_cast<CellKind>(random.below(3));
        }
      }
      prover.invalidate(changed);
      settle(prover);
      Prover fresh(flow, undecided_sections(flow, 2), most_crossings, always);
      settle(fresh);
      const SectionVerdicts now = prover.graph().sections();
      ASSERT_EQ(now.first.size(), before.first.size());
      for (std::size_t s = 0; s + 1 < now.first.size(); ++s) {
        ASSERT_EQ(now.first[s] < now.first[s + 1], is_section(flow, s)) << seed << " " << s;
      }
      for (std::size_t s = 0; s + 1 < now.first.size(); ++s) {
        for (std::size_t i = now.first[s]; i < now.first[s + 1]; ++i) {
          const auto verdict = static_cast<Verdict>(now.verdict[i]);
          if (verdict == Verdict::undecided) continue;
          const UnitRange inner{now.range_of(s, i).lo + 1, now.range_of(s, i).hi - 1};
          fresh.graph().for_leaves(s, inner, [&](const LeafGraph::Leaf& leaf) {
            const Verdict other = leaf.verdict;
            EXPECT_TRUE(other == Verdict::undecided || other == verdict)
                << "seed " << seed << " section " << s;
            ++kept;
          });
        }
      }
      changed_verdicts += now.verdict != before.verdict;
    }
    if (::testing::Test::HasFailure()) return;
  }
  EXPECT_GT(changed_verdicts, 20U);
  EXPECT_GT(kept, 5000U);
}

/// A corridor of cells that all head east, to a goal at its end.
Plan corridor() {
  Plan plan = empty_plan(24, 3, 1.0, 3.0);
  for (int iy = 0; iy < 3; ++iy) plan.region[plan.grid.index({23, iy})] = Region::goal;
  return plan;
}

TEST(LeafGraph, AnInvalidationReachesLeavesThatWereDecidedWhenItBegan) {
  const Plan plan = corridor();
  PlanFlow owner(plan);
  const Flow flow = owner.flow();
  Prover first(flow, undecided_sections(flow, 2), most_crossings, always);
  first.settle(0x1p26);
  // Continuing from what is decided, with an obstacle seven cells ahead of the leaves in question.
  Prover prover(flow, first.graph().sections(), most_crossings, always, LeafGraph::Keep::all_links);
  std::vector<bool> changed(plan.grid.size(), false);
  for (int iy = 0; iy < 3; ++iy) {
    changed[plan.grid.index({15, iy})] = true;
    owner.kind[plan.grid.index({15, iy})] = CellKind::obstacle;
  }
  prover.invalidate(changed);
  prover.settle(0x1p26);
  std::size_t before_it = 0;
  const std::size_t section = section_of(plan.grid.index({8, 1}), Side::right);
  prover.graph().for_leaves(section, whole, [&](const LeafGraph::Leaf& leaf) {
    EXPECT_EQ(leaf.verdict, Verdict::collide);
    ++before_it;
  });
  EXPECT_GT(before_it, 0U);
}

TEST(LeafGraph, MayBeInvalidatedAtAnyMoment) {
  const Plan plan = corridor();
  PlanFlow owner(plan);
  const Flow flow = owner.flow();
  bool go_on = true;
  Prover prover(
      flow, undecided_sections(flow, 2), most_crossings, [&] { return go_on; },
      LeafGraph::Keep::all_links);
  const auto put = [&](int ix, CellKind kind) {
    std::vector<bool> changed(plan.grid.size(), false);
    changed[plan.grid.index({ix, 1})] = true;
    owner.kind[plan.grid.index({ix, 1})] = kind;
    prover.invalidate(changed);
  };
  put(10, CellKind::obstacle);  // before anything was examined
  put(11, CellKind::obstacle);  // twice
  go_on = false;
  EXPECT_FALSE(prover.settle(0x1p26));
  put(12, CellKind::obstacle);  // after a stop
  put(10, CellKind::ordinary);
  go_on = true;
  EXPECT_TRUE(prover.settle(0x1p26));
  for (std::size_t s = 0; s < 4 * plan.grid.size(); ++s) {
    EXPECT_EQ(prover.graph().has_leaves(s), is_section(flow, s)) << s;
  }
  EXPECT_THROW(prover.invalidate({}), PreconditionViolation);
}

}  // namespace
}  // namespace fairway
