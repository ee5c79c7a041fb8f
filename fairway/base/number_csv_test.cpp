#include "fairway/base/number_csv.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <cmath>

#include "fairway/base/error.hpp"
#include "fairway/base/heading.hpp"
#include "fairway/base/random.hpp"

namespace fairway {
namespace {

using ::testing::HasSubstr;

constexpr std::array<CsvColumn, 3> columns{{{"a_m"}, {"turn_rad", CsvQuantity::heading}, {"b_m"}}};

std::vector<std::vector<double>> rows_of(std::string_view text) {
  std::vector<std::vector<double>> rows;
  for_csv_lines(text, "f.csv", columns, "rows", [&](std::span<const double> v, const CsvPlace&) {
    rows.emplace_back(v.begin(), v.end());
  });
  return rows;
}

std::string refusal_of(std::string_view text) {
  try {
    (void)rows_of(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

using Rows = std::vector<std::vector<double>>;

TEST(NumberCsv, ReadsColumnsInTheirOrderAndByName) {
  const Rows expected{{1.0, 0.5, -2e3}, {4.0, pi, 6.0}};
  EXPECT_EQ(rows_of("1,0.5,-2e3\n4,540deg,6"), expected);
  EXPECT_EQ(rows_of("\xef\xbb\xbf# x\r\nb_m,name,turn_rad,a_m\r\n\r\n-2e3,p, 0.5,+1\r\n"
                    "6,q,180 deg,4\r\n"),
            expected);
}

TEST(NumberCsv, TakesSemicolonsTabsQuotesAndEveryLineEnd) {
  const Rows expected{{1.0, 0.5, -2e3}, {4.0, pi, 6.0}};
  EXPECT_EQ(rows_of("1;0.5;-2e3\r4;540deg;6\r"), expected);
  EXPECT_EQ(rows_of("a_m\tturn_rad\tb_m\n1\t0.5\t-2e3\n4\t540deg\t6\n"), expected);
  EXPECT_EQ(rows_of("\"a_m\",\"turn_rad\",\"b_m\"\n\"1\",\"0.5\",\"-2e3\"\n4,'540deg',6\n"),
            expected);
  EXPECT_EQ(csv_values("1; \"0.5\" ;-2e3", "state", columns), expected[0]);
  EXPECT_THAT(refusal_of("1,2,3\r\r1,2\r"), HasSubstr("f.csv:3: 2 fields"));
}

TEST(NumberCsv, SaysTheLineAndWhatIsWrong) {
  EXPECT_THAT(refusal_of("1,2,3\n1,2\n"), HasSubstr("f.csv:2: 2 fields: expected 3 (a_m,turn_rad"));
  EXPECT_THAT(refusal_of("1,2,3\n#\n1,2,\n"), HasSubstr("f.csv:3: b_m is '': expected a finite"));
  EXPECT_THAT(refusal_of("1,2deg,inf\n"), HasSubstr("f.csv:1: b_m is 'inf'"));
  EXPECT_THAT(refusal_of("1,2rad,3\n"), HasSubstr("suffix deg"));
  EXPECT_THAT(refusal_of("1deg,2,3\n"), HasSubstr("a_m is '1deg'"));
  EXPECT_THAT(refusal_of("a_m,b_m\n1,2\n"), HasSubstr("f.csv:1: no column turn_rad"));
  EXPECT_THAT(refusal_of("a_m,b_m,a_m,turn_rad\n"), HasSubstr("f.csv:1: column a_m appears twice"));
  EXPECT_THAT(refusal_of("1,2,3\na_m,turn_rad,b_m\n"), HasSubstr("f.csv:2: a_m is 'a_m'"));
  EXPECT_THAT(refusal_of("# 1,2,3\n"),
              HasSubstr("f.csv: no rows: expected lines a_m,turn_rad,b_m"));
}

RC_GTEST_PROP(NumberCsv, NumbersComeBackAsTheyWere, (std::uint64_t seed)) {
  Random random(seed);
  std::string text;
  Rows rows;
  for (int i = 0; i < 5; ++i) {
    rows.push_back({random.normal() * std::pow(10.0, random.uniform(-9, 9)),
                    random.uniform(-3.1, 3.1), random.unit()});
    for (std::size_t c = 0; c < 3; ++c) {
      std::array<char, 40> digits;
      (void)std::snprintf(digits.data(), digits.size(), "%.17g", rows.back()[c]);
      text += std::string(digits.data()) + (c == 2 ? "\n" : ",");
    }
  }
  RC_ASSERT(rows_of(text) == rows);
}

RC_GTEST_PROP(NumberCsv, AnyTextIsReadOrRefusedAsBadInput, ()) {
  const auto text = *rc::gen::container<std::string>(
      rc::gen::elementOf(std::string("0123456789.,,,\n\n-+e#degadin_m \r\t")));
  try {
    for (const auto& row : rows_of(text)) {
      for (const double value : row) RC_ASSERT(std::isfinite(value));
      RC_ASSERT(row[1] > -pi && row[1] <= pi);
    }
  } catch (const InputError&) {
  }
}

}  // namespace
}  // namespace fairway
