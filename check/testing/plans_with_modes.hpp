// For tests: plans with modes, and the leaves of the modes of their certificates.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include "check/testing/taken_apart.hpp"
#include "fairway/base/random.hpp"
#include "fairway/field/direction_field.hpp"
#include "fairway/verify/testing/plans_to_verify.hpp"

namespace fairway_check {

inline constexpr int street_nx = 26;
inline constexpr int street_ny = 11;
inline constexpr std::uint8_t stays = 255;

/// With fields that go on in so many directions.
inline void add_directions(fairway::Plan& plan, int count) {
  for (int k = 0; k < count; ++k) {
    const double direction_rad = fairway::Heading::from_rad(2.0 * fairway::pi * k / count).rad();
    const std::vector<float> field =
        fairway::direction_field(plan.grid, plan.region, direction_rad, 16.0);
    plan.mode_heading_rad.insert(plan.mode_heading_rad.end(), field.begin(), field.end());
    plan.record.modes.push_back({"direction", direction_rad});
  }
}

/// A street too narrow to turn in, with a goal at one end and a square at the other: who heads away
/// from the goal has to go on to the square.
inline fairway::Plan street() {
  fairway::Plan plan = fairway::empty_plan(street_nx, street_ny, 8.0, 20.0);
  for (std::size_t i = 0; i < plan.grid.size(); ++i) {
    const fairway::Cell c = plan.grid.cell_at(i);
    const bool in_street = c.iy >= 3 && c.iy <= 7;
    const bool in_square = c.ix < 11 && c.ix > 0 && c.iy > 0 && c.iy < street_ny - 1;
    if (!in_street && !in_square) plan.region[i] = fairway::Region::obstacle;
    if (c.ix >= street_nx - 2 && in_street) plan.region[i] = fairway::Region::goal;
    const bool is_free = plan.region[i] == fairway::Region::free;
    if (is_free && (c.iy == 3 || c.iy == 7)) plan.region[i] = fairway::Region::buffer;
    plan.heading_rad[i] = static_cast<float>(0.1 * (5 - c.iy));
  }
  add_directions(plan, 4);
  return plan;
}

/// With fields that nobody would fly: of every style, with commands equal to those of
/// other modes here and there, exactly opposite to them, or missing.
inline void add_odd_modes(fairway::Plan& plan, std::uint64_t seed) {
  fairway::Random random = fairway::Random::stream(0x0de5, seed);
  const auto modes = 1 + random.below(4);
  const std::size_t cells = plan.grid.size();
  for (std::uint64_t k = 0; k < modes; ++k) {
    const auto style = static_cast<fairway::FieldStyle>(random.below(fairway::field_styles));
    const fairway::Vec2 goal{random.uniform(0.0, plan.grid.nx), random.uniform(0.0, plan.grid.ny)};
    const double twist = random.uniform(-fairway::pi, fairway::pi);
    for (std::size_t i = 0; i < cells; ++i) {
      const fairway::Cell c = plan.grid.cell_at(i);
      const float own = plan.heading_rad[i];
      const float before = k == 0 ? own : plan.mode_heading_rad[(k - 1) * cells + i];
      float rad = fairway::Heading::stored(
          sample_heading(style, random, {c.ix + 0.5, c.iy + 0.5}, goal, twist));
      switch (random.below(8)) {
        case 0:
          rad = own;
          break;
        case 1:
          rad = before;
          break;
        case 2:
          rad = std::isnan(own) ? own
                                : fairway::Heading::stored(static_cast<double>(own) + fairway::pi);
          break;
        default:
          break;
      }
      if (random.below(20) == 0) rad = std::numeric_limits<float>::quiet_NaN();
      plan.mode_heading_rad.push_back(rad);
    }
    plan.record.modes.push_back({"turning_places"});
  }
}

/// A leaf of a further mode, in the arrays of all of them.
struct ModeLeaf {
  TakenApart& of;
  std::size_t at;

  std::uint8_t verdict() const { return of.at<std::uint8_t>("mode_leaf_verdict", at); }
  std::uint8_t next() const { return of.at<std::uint8_t>("mode_leaf_next", at); }
  std::uint32_t rank() const { return of.at<std::uint32_t>("mode_leaf_rank", at); }
  float time_s() const { return of.at<float>("mode_leaf_time_s", at); }
  bool reaches() const { return verdict() == reach; }
  bool hands_over() const { return next() != stays; }

  void put_verdict(std::uint8_t v) const { of.put("mode_leaf_verdict", at, v); }
  void put_next(std::uint8_t mode) const { of.put("mode_leaf_next", at, mode); }
  void put_rank(std::uint32_t rank) const { of.put("mode_leaf_rank", at, rank); }
  void put_time(float s) const { of.put("mode_leaf_time_s", at, s); }
};

inline std::size_t mode_leaves(const TakenApart& parts) {
  return parts.arrays.at("mode_leaf_verdict").size();
}
inline std::size_t section_of_mode_leaf(const TakenApart& parts, std::size_t leaf) {
  std::size_t s = 0;
  while (parts.at<std::uint32_t>("mode_section_first", s + 1) <= leaf) ++s;
  return s;
}
inline std::size_t mode_of_leaf(const TakenApart& parts, std::size_t leaf) {
  return 1 +
         section_of_mode_leaf(parts, leaf) / (4 * std::size_t{street_nx} * std::size_t{street_ny});
}

/// Numbers of leaves with this property, at most `most` of them, spread over all that have it.
inline std::vector<std::size_t> some_leaves(TakenApart& parts, std::size_t most,
                                            const std::function<bool(const ModeLeaf&)>& is_one) {
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i < mode_leaves(parts); ++i) {
    if (is_one({parts, i})) all.push_back(i);
  }
  EXPECT_FALSE(all.empty());
  std::vector<std::size_t> some;
  for (std::size_t i = 0; i < std::min(most, all.size()); ++i) {
    some.push_back(all[i * all.size() / std::min(most, all.size())]);
  }
  return some;
}

inline bool is_reaching(const ModeLeaf& leaf) { return leaf.reaches(); }
inline bool is_handed_over(const ModeLeaf& leaf) { return leaf.reaches() && leaf.hands_over(); }
inline bool is_flown_on(const ModeLeaf& leaf) { return leaf.reaches() && !leaf.hands_over(); }
inline bool is_open(const ModeLeaf& leaf) { return !leaf.reaches(); }

}  // namespace fairway_check
