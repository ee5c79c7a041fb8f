#include "fairway/verify/fixpoints.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "fairway/base/random.hpp"
#include "fairway/verify/ways_out.hpp"

namespace fairway {
namespace {

using Id = LeafGraph::Id;
constexpr UnitRange whole{0, 0xffffffffU};

/// A graph with one leaf per section and links as drawn: leaf i is all of section i.
LeafGraph drawn_graph(const std::vector<std::vector<Id>>& leads_to) {
  SectionVerdicts start;
  start.first.push_back(0);
  for (std::size_t s = 0; s < leads_to.size(); ++s) {
    start.begin.push_back(0);
    start.first.push_back(static_cast<std::uint32_t>(s + 1));
  }
  start.rank.assign(leads_to.size(), 0);
  start.verdict.assign(leads_to.size(), 0);
  start.time_s.assign(leads_to.size(), 0.0F);
  LeafGraph graph(start);
  for (Id id = 0; id < leads_to.size(); ++id) {
    std::vector<ImagePiece> pieces;
    for (const Id other : leads_to[id]) pieces.push_back({other, whole, 1.0F, false});
    Image image;
    image.pieces = pieces;
    graph.set_image(id, image);
  }
  return graph;
}

std::vector<std::vector<Id>> random_links(Random& random, std::size_t count, double density) {
  std::vector<std::vector<Id>> leads_to(count);
  for (auto& links : leads_to) {
    for (Id other = 0; other < count; ++other) {
      if (random.unit() < density) links.push_back(other);
    }
  }
  return leads_to;
}

std::vector<Id> all_of(const LeafGraph& graph) {
  std::vector<Id> ids;
  for (Id id = 0; id < graph.ids(); ++id) ids.push_back(id);
  return ids;
}

/// [from][to]: whether there is a way of at least one link.
std::vector<std::vector<bool>> ways(const std::vector<std::vector<Id>>& leads_to) {
  const std::size_t n = leads_to.size();
  std::vector<std::vector<bool>> way(n, std::vector<bool>(n, false));
  for (std::size_t i = 0; i < n; ++i) {
    for (const Id other : leads_to[i]) way[i][other] = true;
  }
  for (std::size_t k = 0; k < n; ++k) {
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) way[i][j] = way[i][j] || (way[i][k] && way[k][j]);
    }
  }
  return way;
}

TEST(Components, AreThoseThatReachEachOtherAndTheirEndsComeFirst) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Random random(seed);
    const std::size_t n = 1 + random.below(30);
    const auto leads_to = random_links(random, n, 2.0 * random.unit() / static_cast<double>(n));
    const LeafGraph graph = drawn_graph(leads_to);
    const auto way = ways(leads_to);
    std::vector<std::size_t> of(n, ~std::size_t{0});
    const auto found = components(graph, all_of(graph));
    for (std::size_t c = 0; c < found.size(); ++c) {
      ASSERT_TRUE(std::is_sorted(found[c].begin(), found[c].end()));
      for (const Id id : found[c]) {
        ASSERT_EQ(of[id], ~std::size_t{0}) << "twice";
        of[id] = c;
      }
    }
    for (Id i = 0; i < n; ++i) {
      ASSERT_NE(of[i], ~std::size_t{0}) << "left out";
      for (Id j = 0; j < n; ++j) {
        if (i != j) {
          ASSERT_EQ(of[i] == of[j], way[i][j] && way[j][i]) << seed;
        }
        if (way[i][j]) {
          ASSERT_GE(of[i], of[j]) << seed;
        }
      }
    }
  }
}

TEST(Components, OfAPartIgnoreTheRest) {
  // 0 -> 1 -> 2 -> 0, with 1 left out.
  const LeafGraph graph = drawn_graph({{1}, {2}, {0}});
  const std::vector<Id> part{0, 2};
  EXPECT_EQ(components(graph, part), (std::vector<std::vector<Id>>{{0}, {2}}));
  EXPECT_EQ(components(graph, all_of(graph)), (std::vector<std::vector<Id>>{{0, 1, 2}}));
  EXPECT_TRUE(components(graph, {}).empty());
}

TEST(Components, OfAChainOfAMillionDoNotNeedTheCallStack) {
  std::vector<std::vector<Id>> chain(300000);
  for (Id id = 0; id + 1 < chain.size(); ++id) chain[id].push_back(id + 1);
  const auto found = components(drawn_graph(chain), std::vector<Id>{0, 1, 2});
  EXPECT_EQ(found.size(), 3U);
  const LeafGraph graph = drawn_graph(chain);
  EXPECT_EQ(components(graph, all_of(graph)).size(), chain.size());
}

TEST(GreatestByRemoval, IsTheLargestPartThatNothingLeads) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Random random(seed);
    const std::size_t n = 1 + random.below(40);
    const auto leads_to = random_links(random, n, 1.5 / static_cast<double>(n));
    std::vector<bool> leak(n);
    for (std::size_t i = 0; i < n; ++i) leak[i] = random.below(8) == 0;
    const LeafGraph graph = drawn_graph(leads_to);
    const auto stays = [&](Id id, const auto& is_in) {
      if (leak[id]) return false;
      bool all = true;
      for (const LeafGraph::Link& link : graph.links(id)) {
        graph.for_leaves(link.section, link.range,
                         [&](const LeafGraph::Leaf& other) { all = all && is_in(other.id); });
      }
      return all;
    };
    const std::vector<Id> found = greatest_by_removal(graph, all_of(graph), stays);
    const auto way = ways(leads_to);
    std::vector<Id> expected;  // no way to a leak
    for (Id i = 0; i < n; ++i) {
      bool safe = !leak[i];
      for (Id j = 0; j < n; ++j) safe = safe && !(way[i][j] && leak[j]);
      if (safe) expected.push_back(i);
    }
    ASSERT_EQ(found, expected) << seed;
  }
}

/// Of the open leaves: those from which no way of links leads to a leak.
std::vector<Id> lacking_a_way(const LeafGraph& graph, const std::vector<bool>& leak) {
  std::vector<bool> out = leak;
  for (bool more = true; more;) {
    more = false;
    for (Id id = 0; id < graph.ids(); ++id) {
      if (!graph.is_open(id) || out[id]) continue;
      bool leads_out = false;
      for (const LeafGraph::Link& link : graph.links(id)) {
        graph.for_leaves(link.section, link.range, [&](const LeafGraph::Leaf& other) {
          leads_out = leads_out || (other.id != LeafGraph::none && out[other.id]);
        });
      }
      out[id] = leads_out;
      more = more || leads_out;
    }
  }
  std::vector<Id> lacking;
  for (Id id = 0; id < graph.ids(); ++id) {
    if (graph.is_open(id) && !out[id]) lacking.push_back(id);
  }
  return lacking;
}

TEST(WaysOut, AreFoundAgainWhateverIsCutAndDecided) {
  std::size_t lacked = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Random random(seed);
    const std::size_t n = 2 + random.below(60);
    LeafGraph graph = drawn_graph(random_links(random, n, 1.2 / static_cast<double>(n)));
    std::vector<bool> leak(n);
    for (std::size_t i = 0; i < n; ++i) leak[i] = random.below(8) == 0;
    WaysOut ways;
    ways.forget_all(graph);
    for (int step = 0; step < 60; ++step) {
      const auto leaks = [&](Id id) { return leak[id]; };
      const std::vector<Id> found = ways.lacking(graph, leaks);
      ASSERT_EQ(found, lacking_a_way(graph, leak)) << seed << " " << step;
      lacked += found.size();
      for (std::size_t changes = random.below(4); changes > 0; --changes) {
        const Id id = static_cast<Id>(random.below(graph.ids()));
        if (!graph.is_open(id)) continue;
        if (random.below(3) == 0) {  // what leads to it leaks
          const LeafPlace place = graph.place(id);
          graph.decide(id, Verdict::reach, 1, 1.0F);
          graph.for_dependents(place.section, place.range, [&](Id other) {
            leak[other] = true;
            ways.forget_step(other, id);
          });
          graph.release(id);
          continue;
        }
        const LeafPlace before = graph.place(id);
        graph.for_dependents(before.section, before.range,
                             [&](Id other) { ways.forget_step(other, id); });
        const Id upper = graph.cut(id);
        leak.resize(graph.ids());
        for (const Id half : {id, upper}) {
          std::vector<ImagePiece> pieces(random.below(3));
          leak[half] = random.below(12) == 0;
          for (ImagePiece& piece : pieces) {
            piece = {static_cast<std::uint32_t>(random.below(n)), whole, 1.0F, false};
            graph.for_leaves(piece.section, whole, [&](const LeafGraph::Leaf& other) {
              leak[half] = leak[half] || other.verdict == Verdict::reach;
            });
          }
          Image image;
          image.pieces = pieces;
          graph.set_image(half, image);
          ways.forget(half);
        }
      }
    }
  }
  EXPECT_GT(lacked, 10000U);
}

TEST(WaysOut, OfManyAreFoundOnAllThreads) {
  // Chains of 100, some of which end in a leak.
  constexpr Id length = 100;
  std::vector<std::vector<Id>> chains(3000 * length);
  for (Id id = 0; id < chains.size(); ++id) {
    if (id % length + 1 < length) chains[id].push_back(id + 1);
  }
  const LeafGraph graph = drawn_graph(chains);
  const auto leaks = [](Id id) { return id % length + 1 == length && id / length % 3 != 0; };
  WaysOut ways;
  ways.forget_all(graph);
  for (int time = 0; time < 2; ++time) {
    const std::vector<Id> found = ways.lacking(graph, leaks);
    ASSERT_EQ(found.size(), chains.size() / 3);
    for (const Id id : found) ASSERT_EQ(id / length % 3, 0U);
  }
}

TEST(LeastByRounds, DecidesInTheRoundOfTheLongestWay) {
  // 3 ends; the others lead to the next, and 5 leads to itself forever.
  LeafGraph graph = drawn_graph({{1}, {2}, {3}, {}, {0, 3}, {5}});
  Worklist waiting;
  for (Id id = 0; id < graph.ids(); ++id) waiting.add(id);
  std::uint32_t round_number = 0;
  const auto examine = [&](Id id) {
    if (id == 3) return 1;
    bool all = !graph.links(id).empty();
    for (const LeafGraph::Link& link : graph.links(id)) {
      graph.for_leaves(link.section, link.range, [&](const LeafGraph::Leaf& other) {
        all = all && other.verdict == Verdict::reach;
      });
    }
    return all ? 1 : 0;
  };
  const auto conclude = [&](const std::vector<Id>& round, const std::vector<int>& holds) {
    ++round_number;
    for (std::size_t k = 0; k < round.size(); ++k) {
      if (holds[k] != 0) graph.decide(round[k], Verdict::reach, round_number, 0.0F);
    }
    for (std::size_t k = 0; k < round.size(); ++k) {
      if (holds[k] == 0) continue;
      graph.for_dependents(graph.place(round[k]).section, whole, [&](Id other) {
        if (graph.is_open(other)) waiting.add(other);
      });
    }
  };
  EXPECT_TRUE(least_by_rounds(
      waiting, [] { return true; }, examine, conclude));
  const std::vector<std::uint32_t> rank = graph.sections().rank;  // a leaf a section
  EXPECT_EQ(rank[3], 1U);
  EXPECT_EQ(rank[2], 2U);
  EXPECT_EQ(rank[1], 3U);
  EXPECT_EQ(rank[0], 4U);
  EXPECT_EQ(rank[4], 5U);
  EXPECT_TRUE(graph.is_open(5));
  waiting.add(5);
  EXPECT_FALSE(least_by_rounds(
      waiting, [] { return false; }, examine, conclude));
  EXPECT_FALSE(waiting.empty());
}

TEST(ImageVerdicts, CountTheHopsOnTheLeafItself) {
  LeafGraph graph = drawn_graph({{1}, {}});
  const Id own = 0;
  const Id upper = graph.cut(own);
  const UnitRange range = graph.place(own).range;
  const ImagePiece pieces[2]{{0, {range.lo + 1000, range.hi + 1000}, 0.5F, true},
                             {1, whole, 2.0F, false}};
  Image image;
  image.pieces = pieces;
  graph.set_image(own, image);
  graph.decide(upper, Verdict::reach, 1, 3.0F);
  graph.decide(1, Verdict::reach, 1, 4.0F);
  const auto verdict_at = [](const LeafGraph::Leaf& leaf) { return leaf.verdict; };
  const VerdictSet found = image_verdicts(graph, own, verdict_at);
  EXPECT_EQ(found.only(), Verdict::reach);
  const double hops = std::floor(width_of(range) / 1000.0);
  EXPECT_GE(found.time_s, hops * 0.5 + 2.0 + 4.0);
  EXPECT_LE(found.time_s, (hops * 0.5 + 2.0 + 4.0) * (1.0 + 1e-12));
  // Without the move it waits for itself.
  const ImagePiece still[1]{{0, {range.lo, range.hi}, 0.5F, true}};
  image.pieces = still;
  graph.set_image(own, image);
  EXPECT_EQ(image_verdicts(graph, own, verdict_at).only(), Verdict::undecided);
}

}  // namespace
}  // namespace fairway
