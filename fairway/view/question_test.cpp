#include "fairway/view/question.hpp"

#include <functional>
#include <string>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace fairway {
namespace {

const Grid grid{10, 5, 100.0, -20.0, 4.0};

std::string refusal(const std::function<void()>& asks) {
  try {
    asks();
  } catch (const BadQuestion& wrong) {
    return wrong.what();
  }
  return "accepted";
}

TEST(Question, NeedsExactlyItsParametersEachOnce) {
  const auto of = [](const Parameters& given) {
    return refusal([&] { require_parameters(given, {"x", "y"}); });
  };
  EXPECT_EQ(of({{"x", "1"}, {"y", "2"}}), "accepted");
  EXPECT_EQ(of({{"x", "1"}}), "parameter \"y\" is missing, expected once");
  EXPECT_EQ(of({{"x", "1"}, {"x", "1"}, {"y", "2"}}), "parameter \"x\" is repeated, expected once");
  EXPECT_EQ(of({{"x", "1"}, {"y", "2"}, {"z", "3"}}), "unknown parameter \"z\", expected x, y");
  EXPECT_EQ(of({{"x", "1"}, {"y", "2"}, {std::string(50, 'a') + "\n", ""}}),
            "unknown parameter \"" + std::string(40, 'a') + "...\", expected x, y");
  EXPECT_EQ(refusal([] {
              require_parameters({{"a\x1b", "1"}}, {});
            }),
            "unknown parameter \"a?\", expected none");
}

TEST(Question, ANumberIsTheWholeTextAndFinite) {
  const auto of = [](const std::string& text) { return number_parameter({{"x", text}}, "x"); };
  EXPECT_EQ(of("1.5"), 1.5);
  EXPECT_EQ(of("-1e2"), -100.0);
  for (const char* text :
       {"", " 1", "1 ", "1,5", "nan", "inf", "-inf", "1e999", "0x10", "1..2", "+1", "1;2", "one"}) {
    EXPECT_NE(refusal([&] { (void)of(text); }), "accepted") << text;
  }
  EXPECT_NE(refusal([&] { (void)of(std::string("1\0", 2)); }), "accepted");
}

TEST(Question, AStateLiesOnTheGrid) {
  const auto of = [](double x, double y, double h) {
    return refusal([&] {
      const Parameters given{
          {"x", std::to_string(x)}, {"y", std::to_string(y)}, {"h", std::to_string(h)}};
      (void)state_parameters(given, grid, "x", "y", "h");
    });
  };
  EXPECT_EQ(of(100.0, -20.0, 0.0), "accepted");
  EXPECT_EQ(of(139.999, -0.001, 7.0), "accepted");
  EXPECT_EQ(of(140.0, -10.0, 0.0),
            "(x, y) = (140, -10) is outside the plan, expected 100 <= x < 140 and -20 <= y < 0");
  EXPECT_NE(of(99.999, -10.0, 0.0), "accepted");
  EXPECT_NE(of(120.0, 0.0, 0.0), "accepted");
  EXPECT_NE(of(1e300, 0.0, 0.0), "accepted");
  EXPECT_EQ(of(120.0, -10.0, 1e7), "h = 10000000 is not a heading, expected radians");
}

RC_GTEST_PROP(Question, OnlyStatesAreReadAsStates, ()) {
  const auto text = *rc::gen::string<std::string>();
  try {
    const State s = state_parameters({{"x", text}, {"y", "-10"}, {"h", "0"}}, grid, "x", "y", "h");
    RC_ASSERT(grid.contains(grid.cell_of(s.position_m)));
  } catch (const BadQuestion&) {
  }
}

TEST(Question, OnlyTheLoopbackIsALocalHost) {
  for (const char* host : {"127.0.0.1:8080", "localhost:8080"}) {
    EXPECT_TRUE(is_local_host(host, 8080)) << host;
  }
  EXPECT_TRUE(is_local_host("localhost", 80));
  for (const char* host : {"", "localhost", "localhost:80", "127.0.0.1:8081",
                           "127.0.0.1:8080.evil.org", "evil.org:8080", "localhost.evil.org:8080",
                           "127.0.0.2:8080", "0.0.0.0:8080", "LOCALHOST:8080 ", "[::1]:8080"}) {
    EXPECT_FALSE(is_local_host(host, 8080)) << host;
  }
}

}  // namespace
}  // namespace fairway
