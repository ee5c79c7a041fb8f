#include "fairway/inclusion/crossing_graph.hpp"

#include <vector>

#include <gtest/gtest.h>

#include "fairway/base/random.hpp"
#include "fairway/verify/testing/plans_to_verify.hpp"

namespace fairway {
namespace {

TEST(Slots, NumberThoseOfTheSetInOrder) {
  Random random(1);
  Slots slots;
  std::vector<bool> in;
  for (int k = 0; k < 1000; ++k) {
    in.push_back(random.below(3) == 0 || k / 64 == 3);
    slots.add(in.back());
  }
  std::size_t number = 0;
  for (std::size_t k = 0; k < in.size(); ++k) {
    ASSERT_EQ(slots.has(k), in[k]);
    if (!in[k]) continue;
    ASSERT_EQ(slots.number(k), number);
    ++number;
  }
  EXPECT_EQ(slots.count(), number);
}

TEST(LeafArray, KeepsItsEntriesWhenItGrowsAndIsCopied) {
  LeafArray<std::uint32_t> array;
  array.resize(3);
  for (std::uint32_t k = 0; k < 3; ++k) array[k] = k + 7;
  array.resize(1000000);
  const LeafArray<std::uint32_t> copy = array;
  array[2] = 0;
  EXPECT_EQ(copy[0], 7U);
  EXPECT_EQ(copy[2], 9U);
  EXPECT_EQ(copy[3], 0U);
  EXPECT_EQ(copy[999999], 0U);
  EXPECT_EQ(copy.size(), 1000000U);
}

/// Leaves are cut where they lie: against what is expected of each.
TEST(CrossingGraph, CutLeavesAreHalvesInTheirOrderAndOthersStay) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const Plan plan = random_plan(seed);
    const PlanFlow held(plan);
    const Parts parts(held.flow(), VehicleContract::of(plan.vehicle), 1);
    CrossingGraph graph(parts, 2);
    Random random(seed);
    for (int round = 0; round < 5; ++round) {
      std::vector<bool> which;
      std::vector<std::vector<std::uint32_t>> begins(graph.sections());
      for (std::size_t s = 0; s < graph.sections(); ++s) {
        for (auto id = graph.first(s); id < graph.first(s + 1); ++id) {
          Leaf& leaf = graph.leaf(id);
          leaf.end_flown = static_cast<float>(leaf.begin);
          which.push_back(leaf.state != LeafState::idle && random.below(3) == 0);
          begins[s].push_back(leaf.begin);
          if (which.back()) begins[s].push_back((leaf.begin + graph.end_of(id, s)) / 2);
        }
      }
      graph.cut(which);
      for (std::size_t s = 0; s < graph.sections(); ++s) {
        ASSERT_EQ(graph.first(s + 1) - graph.first(s), begins[s].size());
        for (std::size_t k = 0; k < begins[s].size(); ++k) {
          const auto id = static_cast<CrossingGraph::Id>(graph.first(s) + k);
          const Leaf& leaf = graph.leaf(id);
          ASSERT_EQ(leaf.begin, begins[s][k]);
          ASSERT_TRUE(leaf.end_flown == 0.0F || leaf.end_flown == static_cast<float>(leaf.begin));
          ASSERT_EQ(graph.has_slot(id), leaf.state != LeafState::idle);
        }
      }
    }
    EXPECT_GT(graph.leaves(), 100U);
  }
}

}  // namespace
}  // namespace fairway
