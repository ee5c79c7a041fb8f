#include "fairway/report/color.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "fairway/base/error.hpp"

namespace fairway {
namespace {

double linear(std::uint8_t byte) {
  const double c = byte / 255.0;
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

/// CIE lightness, 0 black to 100 white: what a grey print keeps of a colour.
double grey_lightness(const Color& c) {
  const double y = 0.2126 * linear(c.red) + 0.7152 * linear(c.green) + 0.0722 * linear(c.blue);
  return y > 0.008856 ? 116.0 * std::cbrt(y) - 16.0 : 903.3 * y;
}

TEST(Color, GreysOfOklabHaveEqualChannelsAndEndAtBlackAndWhite) {
  EXPECT_EQ(color_of_oklch(0.0, 0.0, 0.0), (Color{0, 0, 0}));
  EXPECT_EQ(color_of_oklch(1.0, 0.0, 0.0), (Color{255, 255, 255}));
  for (double lightness = 0.1; lightness < 1.0; lightness += 0.1) {
    const Color grey = color_of_oklch(lightness, 0.0, 123.0);
    EXPECT_NEAR(grey.red, grey.green, 1);
    EXPECT_NEAR(grey.green, grey.blue, 1);
  }
}

TEST(Color, TheCostRampDarkensInEvenStepsSoThatItSurvivesGreyPrintAndColourBlindness) {
  const int steps = 50;
  const double fall = (grey_lightness(cost_ramp(0.0)) - grey_lightness(cost_ramp(1.0))) / steps;
  EXPECT_GT(fall * steps, 40.0);
  for (int i = 0; i < steps; ++i) {
    const double step = grey_lightness(cost_ramp(static_cast<double>(i) / steps)) -
                        grey_lightness(cost_ramp((i + 1.0) / steps));
    EXPECT_GT(step, 0.3 * fall) << "between steps " << i << " and " << i + 1;
    EXPECT_LT(step, 2.0 * fall) << "between steps " << i << " and " << i + 1;
  }
}

TEST(Color, TheCostRampIsCutAtItsEndsAndRefusesNan) {
  EXPECT_EQ(cost_ramp(-1.0), cost_ramp(0.0));
  EXPECT_EQ(cost_ramp(std::numeric_limits<double>::infinity()), cost_ramp(1.0));
  EXPECT_THROW(static_cast<void>(cost_ramp(std::nan(""))), PreconditionViolation);
}

TEST(Color, ObstaclesAreFarDarkerThanEveryShadeOfCost) {
  EXPECT_LT(grey_lightness(palette::obstacle) + 15.0, grey_lightness(cost_ramp(1.0)));
}

TEST(Color, SeriesColoursDifferAndAreDarkEnoughForLinesOnWhite) {
  for (int i = 0; i < 8; ++i) {
    EXPECT_LT(grey_lightness(series_color(i)), 72.0);
    for (int k = 0; k < i; ++k) EXPECT_NE(series_color(i), series_color(k));
  }
  EXPECT_EQ(series_color(8), series_color(0));
}

}  // namespace
}  // namespace fairway
