#include "fairway/base/number_text.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "fairway/base/random.hpp"

namespace fairway {
namespace {

TEST(NumberText, CoordinatesAreRightToTheCentimetreAndNeverInPowersOfTen) {
  EXPECT_EQ(coordinate_text(5200009.5), "5200009.5");
  EXPECT_EQ(coordinate_text(5.20001e6), "5200010");
  EXPECT_EQ(coordinate_text(-16.199997), "-16.2");
  EXPECT_EQ(coordinate_text(1.7763568394e-15), "0");
  EXPECT_EQ(coordinate_text(-0.001), "0");
  EXPECT_EQ(coordinate_text(26.5655314583), "26.57");
  EXPECT_EQ(coordinate_text(1200.0), "1200");
  EXPECT_EQ(coordinate_text(1e21), "1000000000000000000000");
  EXPECT_EQ(coordinate_text(std::numeric_limits<double>::infinity()), "inf");
  EXPECT_EQ(coordinate_text(std::nan("")), "nan");
}

TEST(NumberText, CoordinatesAreOffByHalfACentimetreAtMost) {
  Random random(1);
  for (int i = 0; i < 10'000; ++i) {
    const double x = random.uniform(-0.5, 0.5) * std::pow(10.0, random.uniform(0.0, 8.0));
    const std::string text = coordinate_text(x);
    EXPECT_LE(std::abs(std::strtod(text.c_str(), nullptr) - x), 0.005 + 1e-9) << text;
    EXPECT_EQ(text.find('e'), std::string::npos);
  }
}

TEST(NumberText, ShortLengthsKeepThreeDigitsThatCount) {
  EXPECT_EQ(length_text(0.00125), "0.00125");
  EXPECT_EQ(length_text(0.0512345), "0.0512");
  EXPECT_EQ(length_text(0.05), "0.05");
  EXPECT_EQ(length_text(39.3845), "39.38");
  EXPECT_EQ(length_text(0.0), "0");
  EXPECT_EQ(length_text(2000000.0), "2000000");
}

TEST(NumberText, APlaceOutsideIsOutsideAsPrinted) {
  const Grid grid{40, 42, 500000.0, 5199590.0, 10.0};
  EXPECT_EQ(outside_text({500400.0, 5200020.0}, grid),
            "(500400, 5200020) is outside the map, expected x in [500000, 500400] and y in "
            "[5199590, 5200010]");
  EXPECT_EQ(outside_text({500400.0, 5200010.0004}, grid),
            "(500400, 5200010.0004) is outside the map, expected x in [500000, 500400] and y in "
            "[5199590, 5200010]");
  EXPECT_TRUE(is_within(grid, {500400.0, 5200010.0}));
  EXPECT_FALSE(is_within(grid, {500400.0, 5200010.0004}));
  EXPECT_FALSE(is_within(grid, {std::nan(""), 5200000.0}));
}

TEST(NumberText, RoundedDownIsAtMostTheValueAndOneUnitOfItsDigitsBelow) {
  EXPECT_EQ(rounded_down(1.59999, 4), 1.599);
  EXPECT_EQ(rounded_down(0.9, 4), 0.9);
  EXPECT_EQ(rounded_down(2.0, 3), 2.0);
  EXPECT_EQ(rounded_down(std::nextafter(2.0, 0.0), 4), 1.999);
  EXPECT_EQ(rounded_down(12345.0, 3), 12300.0);
  Random random(2);
  for (int i = 0; i < 10'000; ++i) {
    const double x = random.unit() * std::pow(10.0, random.uniform(-8.0, 8.0));
    if (x == 0.0) continue;
    const double told = rounded_down(x, 4);
    EXPECT_LE(told, x);
    EXPECT_GT(told, x * (1.0 - 1.001e-3));
    std::array<char, 40> digits;
    (void)std::snprintf(digits.data(), digits.size(), "%.4g", told);
    EXPECT_EQ(std::strtod(digits.data(), nullptr), told);
  }
}

TEST(NumberText, RoundedUpIsAtLeastTheValueAndOneUnitOfItsDigitsAbove) {
  EXPECT_EQ(rounded_up(1.59901, 4), 1.6);
  EXPECT_EQ(rounded_up(452.06, 3), 453.0);
  EXPECT_EQ(rounded_up(2.0, 3), 2.0);
  EXPECT_EQ(rounded_up(std::nextafter(2.0, 3.0), 4), 2.001);
  EXPECT_EQ(rounded_up(9999.5, 3), 10000.0);
  Random random(3);
  for (int i = 0; i < 10'000; ++i) {
    const double x = random.unit() * std::pow(10.0, random.uniform(-8.0, 8.0));
    if (x == 0.0) continue;
    EXPECT_GE(rounded_up(x, 4), x);
    EXPECT_LT(rounded_up(x, 4), x * (1.0 + 1.001e-3));
  }
}

TEST(NumberText, WholePercentsAreRoundedDownButNotToNothing) {
  EXPECT_EQ(whole_percent_text(0.0), "0 %");
  EXPECT_EQ(whole_percent_text(0.004), "under 1 %");
  EXPECT_EQ(whole_percent_text(0.01), "1 %");
  EXPECT_EQ(whole_percent_text(0.29), "29 %");
  EXPECT_EQ(whole_percent_text(0.9999), "99 %");
  EXPECT_EQ(whole_percent_text(1.0), "100 %");
}

}  // namespace
}  // namespace fairway
