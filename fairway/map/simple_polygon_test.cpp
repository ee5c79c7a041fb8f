#include "fairway/map/simple_polygon.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "fairway/base/heading.hpp"
#include "fairway/base/random.hpp"

namespace fairway {
namespace {

using Ring = std::vector<Vec2>;

// Exact for small integers: do the closed segments share a point?
bool share_a_point(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  const auto side = [](Vec2 p, Vec2 q, Vec2 r) {
    const double det = cross(q - p, r - p);
    return (det > 0) - (det < 0);
  };
  const auto on = [&](Vec2 p, Vec2 q, Vec2 r) {
    return side(p, q, r) == 0 && dot(p - r, q - r) <= 0.0;
  };
  return (side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0) || on(a, b, c) ||
         on(a, b, d) || on(c, d, a) || on(c, d, b);
}

bool simple_by_definition(const Ring& ring) {
  const std::size_t n = ring.size();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 1; j < n; ++j) {
      const Vec2 a = ring[i], b = ring[(i + 1) % n], c = ring[j], d = ring[(j + 1) % n];
      if (j == i + 1) {
        if (cross(b - a, d - b) == 0.0 && dot(b - a, d - b) < 0.0) return false;
      } else if (i == 0 && j == n - 1) {
        if (cross(d - c, b - a) == 0.0 && dot(d - c, b - a) < 0.0) return false;
      } else if (share_a_point(a, b, c, d)) {
        return false;
      }
    }
  return true;
}

TEST(SimplePolygon, AgreesWithTheDefinitionOnSmallWholeCoordinates) {
  int simple = 0;
  int crossing = 0;
  for (std::uint64_t seed = 0; seed < 20000; ++seed) {
    Random random = Random::stream(1, seed);
    Ring ring;
    const std::size_t corners = 3 + random.below(5);
    while (ring.size() < corners) {
      const Vec2 p{static_cast<double>(random.below(5)), static_cast<double>(random.below(5))};
      if (ring.empty() || !(ring.back() == p)) ring.push_back(p);
    }
    if (ring.front() == ring.back()) continue;
    const bool expected = simple_by_definition(ring);
    ASSERT_EQ(!find_contact({ring}).has_value(), expected) << seed;
    ++(expected ? simple : crossing);
  }
  EXPECT_GT(simple, 2000);
  EXPECT_GT(crossing, 2000);
}

TEST(SimplePolygon, TheEdgesAndThePlaceAreNamed) {
  const auto contact = find_contact({{{0, 0}, {2, 2}, {2, 0}, {0, 2}}});
  ASSERT_TRUE(contact);
  EXPECT_EQ(contact->first_edge, 0U);
  EXPECT_EQ(contact->second_edge, 2U);
  EXPECT_EQ(contact->at, (Vec2{1, 1}));
}

TEST(SimplePolygon, AHoleMayTouchTheRingButNotCrossIt) {
  const Ring outer = {{0, 0}, {10, 0}, {10, 10}, {0, 10}};
  EXPECT_FALSE(find_contact({outer, {{0, 5}, {3, 4}, {3, 6}}}));
  const auto contact = find_contact({outer, {{-1, 5}, {3, 4}, {3, 6}}});
  ASSERT_TRUE(contact);
  EXPECT_EQ(contact->first_ring, 0U);
  EXPECT_EQ(contact->second_ring, 1U);
}

TEST(SimplePolygon, ManyCornersAreChecked) {
  Ring ring;
  for (int i = 0; i < 20000; ++i) {
    const double angle = two_pi * i / 20000;
    const double radius = 100.0 + 5.0 * std::sin(40.0 * angle);
    ring.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  EXPECT_FALSE(find_contact({ring}));
  std::swap(ring[7000], ring[7001]);
  EXPECT_TRUE(find_contact({ring}));
}

}  // namespace
}  // namespace fairway
