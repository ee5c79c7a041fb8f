#include "fairway/vehicle/turn_side.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "fairway/base/random.hpp"

namespace fairway {
namespace {

/// Rule 3 of vehicle/contract.hpp, word by word: which way to turn.
class Rule {
 public:
  explicit Rule(double hold_side_rad) : hold_side_rad_(hold_side_rad) {}

  /// The turn that is due, positive to the left; through more than half a turn if a side is held.
  double due(double command_rad, double course_rad) {
    double turn = std::remainder(command_rad - course_rad, 2.0 * pi);
    if (std::abs(turn) <= hold_side_rad_) {
      held_ = 0;
      return turn;
    }
    if (held_ == 0) held_ = turn > 0.0 ? 1 : -1;
    if (turn * held_ < 0.0) turn += held_ * 2.0 * pi;
    return turn;
  }
  int held() const { return held_; }

 private:
  double hold_side_rad_;
  int held_ = 0;
};

TEST(TurnSides, MakeAnAutopilotThatTurnsTheShorterWayKeepTheRule) {
  Random random(1);
  int opposed = 0;  // the shorter way for the command itself is not the one held
  for (int flight = 0; flight < 400; ++flight) {
    const double hold = flight % 2 == 0 ? 0.5 * pi : random.uniform(0.2, pi);
    TurnSide side(hold);
    Rule rule(hold);
    double course = random.uniform(-pi, pi);
    double command = random.uniform(-pi, pi);
    const bool hostile = flight % 3 == 0;
    for (int step = 0; step < 400; ++step) {
      // A hostile command changes sides about the opposite of the course.
      if (hostile) {
        command = course + pi + random.uniform(-0.6, 0.6);
      } else if (random.below(30) == 0) {
        command = random.uniform(-20.0, 20.0);
      }
      const double due = rule.due(command, course);
      const double handed = side.keep(command, course);
      ASSERT_EQ(side.held(), rule.held());
      ASSERT_GT(handed, -pi);
      ASSERT_LE(handed, pi);
      // The autopilot is slow: it turns from where it has got to in the meantime.
      const double lag = random.uniform(0.0, 0.15) * (due > 0.0 ? 1.0 : -1.0);
      const double late = std::abs(due) > 0.3 ? lag : 0.0;
      const double turn = std::remainder(handed - (course + late), 2.0 * pi);
      const double shorter = std::remainder(command - course, 2.0 * pi);
      opposed += shorter * due < 0.0 ? 1 : 0;
      ASSERT_GE(turn * due, 0.0) << handed << " for " << command << " at " << course;
      ASSERT_LE(std::abs(turn + late), std::abs(due) + 1e-12);  // never beyond the command
      if (std::abs(due) > hold) {
        ASSERT_LE(std::abs(turn + late), 0.5 * pi + 1e-12);
      }
      course += std::clamp(turn, -0.08, 0.08);
    }
  }
  EXPECT_GT(opposed, 5000);
}

TEST(TurnSides, HandOutNearCommandsAsTheyAre) {
  TurnSide side;
  for (const double off : {0.0, 0.3, -0.3, 1.5707, -1.5707}) {
    EXPECT_NEAR(side.keep(1.0 + off, 1.0), Heading::from_rad(1.0 + off).rad(), 1e-15);
    EXPECT_EQ(side.held(), 0);
  }
  EXPECT_EQ(side.keep(0.25, 0.25 + 2.0 * pi), 0.25);
}

TEST(TurnSides, HoldTheSideWhileTheCommandIsBehindAndForgetItThen) {
  TurnSide side;
  EXPECT_NEAR(side.keep(2.6, 0.0), 0.5 * pi, 1e-15);   // 150 degrees to the left
  EXPECT_NEAR(side.keep(-2.6, 0.0), 0.5 * pi, 1e-15);  // now behind to the right: still left
  EXPECT_EQ(side.held(), 1);
  EXPECT_EQ(side.keep(-1.5, 0.0), -1.5);  // beside: to the right, and nothing is held
  EXPECT_EQ(side.held(), 0);
  EXPECT_NEAR(side.keep(-2.6, 0.0), -0.5 * pi, 1e-15);
}

TEST(TurnSides, OfTheExactOppositeTakeOneAndKeepIt) {
  TurnSide side;
  const double first = side.keep(pi, 0.0);
  EXPECT_NEAR(std::abs(first), 0.5 * pi, 1e-15);
  for (const double wobble : {-1e-9, 1e-9, -0.3, 0.3}) {
    EXPECT_EQ(side.keep(pi + wobble, 0.0), first);
  }
}

TEST(TurnSides, StayAsTheyAreForWhatIsNotANumber) {
  TurnSide side;
  (void)side.keep(2.6, 0.0);
  EXPECT_TRUE(std::isnan(side.keep(NAN, 0.0)));
  EXPECT_TRUE(std::isnan(side.keep(1.0, std::numeric_limits<double>::infinity())));
  EXPECT_EQ(side.held(), 1);
}

}  // namespace
}  // namespace fairway
