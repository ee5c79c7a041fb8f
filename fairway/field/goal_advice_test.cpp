#include "fairway/field/goal_advice.hpp"

#include <cmath>
#include <regex>
#include <string>

#include <gtest/gtest.h>

#include "fairway/field/compute_field.hpp"
#include "fairway/field/testing/sample_maps.hpp"

namespace fairway {
namespace {

using samples::Mask;

constexpr Vehicle vehicle{10.0, 5.0};

FieldOrRefusal planned(const ObstacleMap& map, Vec2 goal_m, const FieldOptions& options,
                       const Vehicle& v = vehicle) {
  return compute_field(map, v, GoalMission{goal_m, {}}, options);
}

bool goal_fits(const FieldOrRefusal& answer) {
  const auto* refusal = std::get_if<MissionRefusal>(&answer);
  return refusal == nullptr || refusal->reason == MissionRefusal::Reason::unreachable;
}

/// Free cells that reach, and the goal's own, which were free before.
double served_share(const FieldOrRefusal& answer) {
  const auto* field = std::get_if<Field>(&answer);
  if (field == nullptr) return 0.0;
  std::size_t free = 0;
  std::size_t reach = 0;
  for (std::size_t i = 0; i < field->region.size(); ++i) {
    if (field->region[i] != Region::free && field->region[i] != Region::goal) continue;
    ++free;
    reach += std::isfinite(field->cost_m[i]) ? 1 : 0;
  }
  return static_cast<double>(reach) / static_cast<double>(free);
}

struct Refused {
  ObstacleMap map;
  FieldOptions options;
  std::string message;
};

/// A drawn map with a goal that does not fit.
std::optional<Refused> drawn_refusal(Random& random) {
  const int nx = 30 + static_cast<int>(random.below(60));
  const int ny = 30 + static_cast<int>(random.below(60));
  Refused r{samples::map_of(samples::blobs(random, nx, ny, 10, 7.0), random.uniform(0.4, 2.0),
                            random.below(3) == 0 ? 512'345.67 : 0.0),
            {},
            {}};
  r.options.alpha = random.uniform(0.5, 3.0);
  r.options.beta = random.uniform(0.5, 2.0);
  r.options.metric = random.below(3) == 0 ? Metric::paper : Metric::euclidean;
  const Vec2 goal{r.map.grid.x0_m + random.unit() * r.map.grid.width_m(),
                  random.unit() * r.map.grid.height_m()};
  const FieldOrRefusal answer = planned(r.map, goal, r.options);
  if (goal_fits(answer)) return std::nullopt;
  r.message = std::get<MissionRefusal>(answer).message;
  return r;
}

TEST(GoalAdvice, GoalsProposedFitAsPrintedAndServeTheShareReported) {
  Random random(611);
  const std::regex pattern(
      R"((nearest goal that fits|in the largest part of them the nearest) is \[([^,]*), ([^\]]*)\]; it serves (under 1|[0-9]+) %)");
  int places = 0;
  int pockets = 0;
  for (int draw = 0; draw < 400; ++draw) {
    const auto r = drawn_refusal(random);
    if (!r) continue;
    double first_share = -1.0;
    for (std::sregex_iterator m(r->message.begin(), r->message.end(), pattern), end; m != end;
         ++m) {
      const FieldOrRefusal again =
          planned(r->map, {std::stod((*m)[2]), std::stod((*m)[3])}, r->options);
      EXPECT_TRUE(goal_fits(again)) << r->message;
      for (const int group : {2, 3}) {
        const std::string number = (*m)[group];
        EXPECT_LE(number.size() - std::min(number.find('.'), number.size()), 3U) << r->message;
      }
      const double told = (*m)[4] == "under 1" ? 0.0 : std::stod((*m)[4]) / 100.0;
      if (std::holds_alternative<Field>(again)) {
        EXPECT_GE(served_share(again), told - 1e-9) << r->message;
        EXPECT_LE(served_share(again), told + 0.0101) << r->message;
      }
      ++places;
      if (first_share < 0.0) {
        first_share = told;
      } else {
        EXPECT_GE(told, first_share) << r->message;
        ++pockets;
      }
    }
  }
  EXPECT_GT(places, 60);
  EXPECT_GT(pockets, 8);
}

TEST(GoalAdvice, WhereNoGoalFitsEachProposedChangeMakesOneFit) {
  Random random(612);
  const std::regex where(R"(the widest place is \[([^,]*), ([^\]]*)\])");
  const std::regex change(R"((turn_radius_m|alpha|beta) = ([0-9.e+-]+))");
  int hopeless = 0;
  int changes[3] = {0, 0, 0};
  for (int draw = 0; draw < 900; ++draw) {
    const auto r = drawn_refusal(random);
    std::smatch place;
    if (!r || !std::regex_search(r->message, place, where)) continue;
    ++hopeless;
    EXPECT_EQ(r->message.find("nearest goal"), std::string::npos);
    const Vec2 goal{std::stod(place[1]), std::stod(place[2])};
    const std::string rest = place.suffix();
    for (std::sregex_iterator m(rest.begin(), rest.end(), change), end; m != end; ++m) {
      Vehicle v = vehicle;
      FieldOptions options = r->options;
      const double value = std::stod((*m)[2]);
      if ((*m)[1] == "turn_radius_m") ++changes[0], v.turn_radius_m = value;
      if ((*m)[1] == "alpha") ++changes[1], options.alpha = value;
      if ((*m)[1] == "beta") ++changes[2], options.beta = value;
      EXPECT_TRUE(goal_fits(planned(r->map, goal, options, v))) << r->message;
    }
  }
  EXPECT_GT(hopeless, 40);
  for (const int n : changes) EXPECT_GT(n, 8);
}

TEST(GoalAdvice, OnCellsOfMillimetresPlacesArePrintedFinely) {
  Mask mask(60, 60);
  mask.at(30, 30) = 1;
  const ObstacleMap map = samples::map_of(mask, 0.001);
  const FieldOptions options;
  const auto answer = planned(map, {0.0305, 0.0305}, options, {1.0, 0.003});
  const auto& message = std::get<MissionRefusal>(answer).message;
  std::smatch place;
  ASSERT_TRUE(std::regex_search(message, place, std::regex(R"(is \[([^,]*), ([^\]]*)\])")))
      << message;
  EXPECT_TRUE(
      goal_fits(planned(map, {std::stod(place[1]), std::stod(place[2])}, options, {1.0, 0.003})))
      << message;
}

TEST(GoalAdvice, NamesPlacesAsTheUserWritesThem) {
  Mask mask(60, 60);
  mask.at(30, 30) = 1;
  const auto answer = planned(samples::map_of(mask, 1.0), {30.5, 30.5}, {});
  const auto& refusal = std::get<MissionRefusal>(answer);
  ASSERT_TRUE(refusal.words);
  EXPECT_EQ(refusal.words(metres_text), refusal.message);
  const std::string told = refusal.words([](Vec2, int) { return std::string("HERE"); });
  EXPECT_TRUE(
      told.starts_with("the goal HERE lies in an obstacle; the nearest goal that fits is "
                       "HERE; it serves "))
      << told;
}

TEST(RoomiestGoal, IsInTheLargestPartFarFromEverything) {
  Mask mask(80, 40);
  for (int iy = 0; iy < 40; ++iy) mask.at(0, iy) = mask.at(30, iy) = mask.at(79, iy) = 1;
  for (int ix = 0; ix < 80; ++ix) mask.at(ix, 0) = mask.at(ix, 39) = 1;
  const ObstacleMap map = samples::map_of(mask, 1.0);
  std::vector<Region> region(map.grid.size());
  for (std::size_t i = 0; i < region.size(); ++i) {
    region[i] = map.obstacle[i] != 0 ? Region::obstacle : Region::free;
  }
  const auto goal = roomiest_goal(map, region, {1.0, 2.0}, {});
  ASSERT_TRUE(goal);
  EXPECT_NEAR(goal->place_m.x, 54.5, 6.0);
  EXPECT_NEAR(goal->place_m.y, 20.0, 1.0);
  EXPECT_NEAR(goal->serves, 48.0 / 77.0, 1e-12);
  EXPECT_FALSE(roomiest_goal(map, region, {1.0, 30.0}, {}));
}

}  // namespace
}  // namespace fairway
