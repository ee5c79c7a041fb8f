#include "check/motion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <sstream>

#include "fairway/base/random.hpp"
#include "fairway/vehicle/testing/wide_motion.hpp"

namespace fairway_check {
namespace {

using fairway::Random;
using fairway::Wide;
using Exact = fairway::WideVec<Wide>;
constexpr double pi = std::numbers::pi;

bool holds(const Real& a, const Wide& exact) {
  const Wide own(1e-30);
  return Wide(a.lower()) - own <= exact && exact <= Wide(a.upper()) + own;
}
bool holds(const Vec& a, const Exact& exact) { return holds(a.x, exact.x) && holds(a.y, exact.y); }

/// A number in a frame's coordinates, of the exact vector `v`.
Wide along(int side, const Exact& v) {
  return side == 0 ? v.y : side == 1 ? Wide(-v.x) : side == 2 ? Wide(-v.y) : v.x;
}

/// A set with a way to draw its states: positions (or centres, when turning) in a box, headings
/// between two angles.
struct Draw {
  double radius = 2.0;
  double command_rad = 0.0;
  bool has_command = true;
  int turn = 0;
  std::array<double, 4> box{};  // x from, to; y from, to
  std::array<double, 2> heading_rad{};

  Bundle bundle() const {
    Bundle set;
    const Vec a = unit_vector(heading_rad[0]);
    const Vec b = unit_vector(heading_rad[1]);
    set.heading = {hull(a.x, b.x), hull(a.y, b.y)};
    for (int k = -4; k <= 4; ++k) {  // an axis between them
      if (heading_rad[0] > k * pi / 2 || k * pi / 2 > heading_rad[1]) continue;
      const double cosine = k % 2 != 0 ? 0.0 : k % 4 == 0 ? 1.0 : -1.0;
      const double sine = k % 2 == 0 ? 0.0 : k == 1 || k == -3 ? 1.0 : -1.0;
      set.heading = {hull(set.heading.x, Real(cosine)), hull(set.heading.y, Real(sine))};
    }
    const Vec place{Real(box[0], box[1]), Real(box[2], box[3])};
    set.at = turn == 0 ? place : Vec{Real(-0.5, 0.5), Real(-0.5, 0.5)};
    set.turn = turn;
    if (turn != 0) set.centre = place;
    return set;
  }
  std::string words() const {
    std::ostringstream out;
    out.precision(17);
    out << "radius " << radius << " turn " << turn << " box " << box[0] << " " << box[1] << " "
        << box[2] << " " << box[3] << " heading " << heading_rad[0] << " " << heading_rad[1]
        << " command " << (has_command ? command_rad : std::nan(""));
    return out.str();
  }
};

double heading(Random& random) {
  constexpr std::array<double, 5> off{0.0, 1e-8, -1e-8, 1e-4, -1e-15};
  if (random.below(2) == 0) return random.uniform(-pi, pi);
  return (static_cast<double>(random.below(4)) - 1.5) * (pi / 2) - pi / 4 + off[random.below(5)];
}

double end(Random& random) { return random.below(2) == 0 ? -0.5 : 0.5; }

/// Sets on sides, in corners and through corners on purpose; commands ahead, behind and mirrored.
Draw draw(Random& random) {
  constexpr std::array<double, 5> radii{1.0000001, 1.01, 1.5, 2.5, 300.0};
  constexpr std::array<double, 6> widths{0.0, 1e-12, 1e-7, 1e-3, 0.05, 0.3};
  Draw d;
  d.radius = radii[random.below(radii.size())];
  const double h = heading(random);
  const double heading_width = widths[random.below(widths.size())];
  d.heading_rad = {std::max(-pi, h - 0.5 * heading_width), std::min(pi, h + 0.5 * heading_width)};
  const std::array<double, 5> commands{heading(random), h, h > 0 ? h - pi : h + pi, -h,
                                       h > 0 ? pi - h : -pi - h};
  d.command_rad = static_cast<double>(static_cast<float>(commands[random.below(5)]));
  d.has_command = random.below(8) != 0;
  std::array<double, 2> p{};
  const double k = random.below(2) == 0 ? 1.0 : -1.0;
  for (double& x : p) x = random.below(4) != 0 ? random.unit() - 0.5 : end(random);
  if (random.below(3) == 0) {  // from a corner backwards, along an arc
    const double w = h + k * random.uniform(0.0, 0.8);
    p = {end(random) - k * d.radius * (std::sin(w) - std::sin(h)),
         end(random) + k * d.radius * (std::cos(w) - std::cos(h))};
  }
  for (double& x : p) x = std::clamp(x, -0.5, 0.5);
  if (random.below(3) == 0) {
    d.turn = k > 0 ? 1 : -1;
    p = {p[0] - k * d.radius * std::sin(h), p[1] + k * d.radius * std::cos(h)};
  }
  const double width = widths[random.below(widths.size())];
  for (std::size_t i = 0; i < 2; ++i) {
    d.box[2 * i] = p[i] - random.unit() * width;
    d.box[2 * i + 1] = d.box[2 * i] + width;
    if (d.box[2 * i + 1] < p[i]) d.box[2 * i + 1] = p[i];
    for (std::size_t e = 2 * i; d.turn == 0 && e < 2 * i + 2; ++e) {
      d.box[e] = std::clamp(d.box[e], -0.5, 0.5);
    }
  }
  return d;
}

double part(Random& random, double low, double high) {
  const double t = random.below(3) == 0 ? static_cast<double>(random.below(2)) : random.unit();
  return std::clamp(low + t * (high - low), low, high);
}

bool encloses(const Way& way, const fairway::WideExit<Wide>& exit) {
  const int side = static_cast<int>(exit.side);
  const Exact middle{Wide(0.5), Wide(0.5)};
  const bool place = way.side == side && holds(way.place, along(side, exit.p - middle));
  const bool circle =
      way.turn == exit.turn && (way.turn == 0 || holds(way.centre, exit.centre - middle));
  return place && circle && way.aligned == exit.aligned && holds(way.heading, exit.u) &&
         static_cast<long double>(way.length) >= exit.length * (1.0L - 1e-15L);
}

/// Counts the states followed; every exit of each must lie in one of the ways.
int follow_members(const Draw& d, Random& random, const std::vector<Way>& ways) {
  const fairway::WideCell<Wide> cell(1.0, d.radius);
  int followed = 0;
  for (int m = 0; m < 8; ++m) {
    const Exact u = fairway::wide_unit<Wide>(part(random, d.heading_rad[0], d.heading_rad[1]));
    Exact p{Wide(part(random, d.box[0], d.box[1])), Wide(part(random, d.box[2], d.box[3]))};
    if (d.turn != 0) p = p - (Wide(d.turn) * Wide(d.radius)) * fairway::wide_left(u);
    p = p + Exact{Wide(0.5), Wide(0.5)};
    if (p.x < 0 || p.x > 1 || p.y < 0 || p.y > 1) continue;
    // A state on a side that heads out of it belongs to another cell.
    if ((p.x == 0 && u.x < 0) || (p.x == 1 && u.x > 0) || (p.y == 0 && u.y < 0) ||
        (p.y == 1 && u.y > 0))
      continue;
    std::vector<fairway::WideExits<Wide>> outcomes;
    const Exact command = fairway::wide_unit<Wide>(d.command_rad);
    const int turn = d.has_command ? fairway::WideCell<Wide>::turn_of(u, command) : 0;
    if (turn == 0) {
      fairway::WideExit<Wide> exit;
      exit.aligned = d.has_command;
      outcomes.emplace_back();
      cell.straight(p, u, exit, outcomes.back());
    } else {
      for (const int sign : {1, -1}) {
        if (turn == sign || turn == 2) outcomes.push_back(cell.turning(p, u, command, sign));
      }
    }
    for (const auto& exits : outcomes) {
      for (std::size_t i = 0; i < exits.count; ++i) {
        const bool found = std::any_of(ways.begin(), ways.end(),
                                       [&](const Way& way) { return encloses(way, exits.of[i]); });
        EXPECT_TRUE(found) << d.words() << "\nstate " << static_cast<double>(p.x) << " "
                           << static_cast<double>(p.y) << " side "
                           << static_cast<int>(exits.of[i].side) << " aligned "
                           << exits.of[i].aligned;
        if (!found) return -1;
      }
    }
    ++followed;
  }
  return followed;
}

TEST(CheckMotion, EveryStateOfASetLeavesByOneOfItsWays) {
  Random random = Random::stream(7, 1);
  int followed = 0;
  int narrow_lost = 0;
  for (int i = 0; i < 30000; ++i) {
    const Draw d = draw(random);
    std::vector<Way> ways;
    bool known = false;
    {
      const Upwards upwards;
      const Command command{unit_vector(d.command_rad), d.has_command, false};
      known = find_ways(d.bundle(), command, Real(d.radius), ways);
    }
    const double width =
        std::max({d.box[1] - d.box[0], d.box[3] - d.box[2], d.heading_rad[1] - d.heading_rad[0]});
    if (!known) {
      narrow_lost += width < 1e-6 ? 1 : 0;
      continue;
    }
    const int found = follow_members(d, random, ways);
    ASSERT_GE(found, 0);
    followed += found;
  }
  EXPECT_GT(followed, 50000);
  EXPECT_LT(narrow_lost, 300);  // commands at right angles, within rounding
}

}  // namespace
}  // namespace fairway_check
