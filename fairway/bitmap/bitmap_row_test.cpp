#include "fairway/bitmap/bitmap_row.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "fairway/base/random.hpp"

namespace fairway {
namespace {

constexpr std::array<Side, 4> sides{Side::right, Side::top, Side::left, Side::bottom};

Direction direction(double rad) { return Direction::of(Heading::from_rad(rad)); }

bool stands(Side side) { return side == Side::right || side == Side::left; }

/// The point of a unit cell at `share` along a side.
Vec2 on_border(Side side, double share) {
  const double at = side == Side::right || side == Side::top ? 1.0 : 0.0;
  return stands(side) ? Vec2{at, share} : Vec2{share, at};
}

bool heads_in(Side side, Vec2 u) {
  const double inwards = stands(side) ? u.x : u.y;
  return side == Side::right || side == Side::top ? inwards < 0.0 : inwards > 0.0;
}

/// How far `value` (in pieces) is from the next end of a piece.
double from_end(double value) { return std::abs(value - std::round(value)); }

struct Tally {
  int same = 0;
  int close_calls = 0;
};

/// Every sample that enters a unit cell, against the exact motion snapped by plain trigonometry.
/// Only within 1e-9 of an end of a piece, or of a corner, may the two differ.
void compare(const BitmapSamples& samples, const Direction& command, double r, Tally& tally) {
  const int m = samples.count();
  const CellShape shape{1.0, r};
  const BitmapCommand made_ready = BitmapCommand::of(command, samples);
  for (const Side entry : sides) {
    for (int k = 0; k < m; ++k) {
      if (!heads_in(entry, samples.unit(k))) continue;
      const BitmapRow row(samples, made_ready, r, entry, k);
      const Direction heading{samples.unit(k), Heading::from_rad((k + 0.5) * two_pi / m).rad()};
      for (int i = 0; i < m; ++i) {
        const CellExit exact =
            cross_cell({on_border(entry, samples.position(i)), heading}, command, shape);
        const Vec2 p = exact.state.position_m;
        const double along = (stands(exact.side) ? p.y : p.x) * m;
        const double angle = exact.state.heading.rad < 0.0 ? exact.state.heading.rad + two_pi
                                                           : exact.state.heading.rad;
        const double sector = angle / (two_pi / m);
        const BitmapExit exit = row.exit(samples, i);
        const bool same = exit.side == exact.side && exit.position == static_cast<int>(along) &&
                          exit.heading == static_cast<int>(sector);
        const bool close = from_end(along) < 1e-9 || from_end(sector) < 1e-9 ||
                           std::abs(dot(heading.unit, command.unit) + 1.0) < 1e-12;
        ++(same ? tally.same : tally.close_calls);
        ASSERT_TRUE(same || close)
            << "entry " << static_cast<int>(entry) << " k " << k << " i " << i << " command "
            << command.rad << " r " << r << ": side " << static_cast<int>(exit.side) << " not "
            << static_cast<int>(exact.side) << ", position " << exit.position << " not " << along
            << ", heading " << exit.heading << " not " << sector;
        ASSERT_FALSE(heads_in(exit.side, samples.unit(exit.heading)));
      }
    }
  }
}

TEST(BitmapRow, AgreesWithExactMotionSnappedToSamples) {
  Random random(7);
  Tally tally;
  for (const int m : {4, 12, 40, 100}) {
    const BitmapSamples samples(m);
    for (int draw = 0; draw < 60; ++draw) {
      const double r = draw % 5 == 0 ? 1.0 + 1e-6 : random.uniform(1.0, draw % 2 == 0 ? 1.5 : 20.0);
      compare(samples, direction(random.uniform(-pi, pi)), r, tally);
      if (HasFatalFailure()) return;
    }
  }
  EXPECT_GT(tally.same, 1'000'000);
  EXPECT_LT(tally.close_calls, tally.same / 100'000);
}

TEST(BitmapRow, AgreesWithExactMotionForCommandsAlongAxesAndDiagonalsAndForNone) {
  Tally tally;
  for (const int m : {8, 52}) {
    const BitmapSamples samples(m);
    for (int eighth = -4; eighth <= 4; ++eighth) {
      for (const double off : {0.0, 1e-12, -1e-12, 1e-6, -1e-6}) {
        compare(samples, direction(eighth * pi / 4 + off), 2.5, tally);
        if (HasFatalFailure()) return;
      }
      compare(samples, direction(static_cast<double>(Heading::stored(eighth * pi / 4))), 1.1,
              tally);
      if (HasFatalFailure()) return;
    }
    compare(samples, Direction::none(), 2.5, tally);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(tally.same, 100'000);
}

TEST(BitmapRow, CommandsThatAreSamplesThemselvesAndTheirOpposites) {
  Tally tally;
  const BitmapSamples samples(24);
  for (int k = 0; k < samples.count(); ++k) {
    const Direction command{samples.unit(k), Heading::from_rad((k + 0.5) * two_pi / 24).rad()};
    compare(samples, command, 3.0, tally);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(tally.same, 10'000);
}

TEST(BitmapSamples, TheSectorOfAHeadingHoldsIt) {
  Random random(3);
  for (const int m : {4, 8, 20, 200, 1000, 8192}) {
    const BitmapSamples samples(m);
    for (int k = 0; k < m; ++k) {
      ASSERT_EQ(samples.heading_bin(samples.unit(k)), k);
      ASSERT_NEAR(samples.unit(k).x, std::cos((k + 0.5) * two_pi / m), 1e-14);
      ASSERT_NEAR(samples.unit(k).y, std::sin((k + 0.5) * two_pi / m), 1e-14);
    }
    for (int draw = 0; draw < 1000; ++draw) {
      const double angle = random.uniform(0.0, two_pi);
      if (from_end(angle / (two_pi / m)) < 1e-6) continue;
      ASSERT_EQ(samples.heading_bin({std::cos(angle), std::sin(angle)}),
                static_cast<int>(angle / (two_pi / m)));
    }
  }
}

TEST(BitmapSamples, AxesAreEndsOfSectorsAndBelongToTheSectorCounterClockwise) {
  const BitmapSamples samples(20);
  EXPECT_EQ(samples.heading_bin({1.0, 0.0}), 0);
  EXPECT_EQ(samples.heading_bin({0.0, 1.0}), 5);
  EXPECT_EQ(samples.heading_bin({-1.0, 0.0}), 10);
  EXPECT_EQ(samples.heading_bin({0.0, -1.0}), 15);
}

TEST(BitmapSamples, TurnedAndMirroredSamplesAreSamplesBitForBit) {
  const int m = 52;
  const BitmapSamples samples(m);
  for (int k = 0; k < m; ++k) {
    EXPECT_EQ(samples.unit(samples.wrapped(k + m / 4)), left_of(samples.unit(k)));
    const Vec2 mirrored{samples.unit(k).x, -samples.unit(k).y};
    EXPECT_EQ(samples.unit(m - 1 - k), mirrored);
  }
}

TEST(BitmapSamples, RefusesCountsThatPutSamplesOnAxes) {
  for (const int m : {0, -4, 2, 6, 7, 8196}) EXPECT_ANY_THROW(BitmapSamples{m}) << m;
}

}  // namespace
}  // namespace fairway
