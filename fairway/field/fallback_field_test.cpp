#include "fairway/field/fallback_field.hpp"

#include <cmath>
#include <cstring>
#include <limits>
#include <variant>

#include <gtest/gtest.h>

#include "fairway/field/compute_field.hpp"
#include "fairway/field/connected_parts.hpp"
#include "fairway/field/holding_circle.hpp"
#include "fairway/field/testing/sample_maps.hpp"

namespace fairway {
namespace {

using samples::Mask;

constexpr Vehicle vehicle{10.0, 4.0};

FieldOptions with(FallbackRule rule) {
  FieldOptions options;
  options.alpha = 1.0;
  options.beta = 1.0;
  options.fallback = rule;
  return options;
}

Field field_of(const ObstacleMap& map, const Mission& mission, FallbackRule rule) {
  return std::get<Field>(compute_field(map, vehicle, mission, with(rule)));
}

/// A room of width x height cells, walled off, below one of 44 x 44 cells with the goal in it.
ObstacleMap two_rooms(int width, int height, double cell_m) {
  Mask m(std::max(width, 44) + 2, height + 47, 1);
  for (int iy = 1; iy <= height; ++iy) {
    for (int ix = 1; ix <= width; ++ix) m.at(ix, iy) = 0;
  }
  for (int iy = height + 2; iy < height + 46; ++iy) {
    for (int ix = 1; ix <= 44; ++ix) m.at(ix, iy) = 0;
  }
  return samples::map_of(m, cell_m);
}
Mission goal_above(const ObstacleMap& map) {
  return GoalMission{map.grid.center({22, map.grid.ny - 23}), {}};
}

/// Of the lower room.
std::size_t commands_below(const Field& field, int height) {
  std::size_t commands = 0;
  for (std::size_t i = 0; i < field.heading_rad.size(); ++i) {
    if (field.grid.cell_at(i).iy > height) break;
    commands += std::isnan(field.heading_rad[i]) ? 0 : 1;
  }
  return commands;
}

/// The least odd number of cells across a square room that a circle fits into.
int just_enough(double cell_m) {
  const Grid grid{1, 1, 0.0, 0.0, cell_m};
  return 2 * static_cast<int>(std::floor(holding_room_m(grid, vehicle) / cell_m)) + 1;
}

TEST(FallbackField, ARoomThatACircleJustFitsIntoHasCommandsAndOneThatItDoesNotHasNone) {
  for (const double cell_m : {0.9, 1.0, 1.6, 2.0, 3.6}) {
    const int enough = just_enough(cell_m);
    for (const int side : {1, 2, enough - 1, enough, enough + 1, enough + 7}) {
      const ObstacleMap map = two_rooms(side, side, cell_m);
      const Field field = field_of(map, goal_above(map), FallbackRule::hold);
      ASSERT_EQ(field.holding_places.size(), side < enough ? 0U : 1U) << cell_m << " " << side;
      EXPECT_EQ(commands_below(field, side),
                side < enough ? 0U : static_cast<std::size_t>(side * side));
      for (const HoldingPlace& place : field.holding_places) {
        EXPECT_GE(place.radius_m, 1.2 * vehicle.turn_radius_m);
        EXPECT_LT(place.radius_m, 1.2 * vehicle.turn_radius_m + 0.5 * cell_m + 1e-9);
        const double from_left = place.center_m.x - map.grid.corner({1, 1}).x;
        EXPECT_GT(from_left, place.radius_m + 0.25 * vehicle.turn_radius_m);
      }
    }
  }
}

TEST(FallbackField, ACorridorOneCellWideHasNoCommands) {
  const ObstacleMap map = two_rooms(60, 1, 1.0);
  EXPECT_EQ(commands_below(field_of(map, goal_above(map), FallbackRule::hold), 1), 0U);
}

TEST(FallbackField, ALongRoomHasFewCirclesFarApart) {
  const ObstacleMap map = two_rooms(900, 21, 1.0);
  const Field field = field_of(map, goal_above(map), FallbackRule::hold);
  EXPECT_EQ(commands_below(field, 21), 900U * 21U);
  ASSERT_GE(field.holding_places.size(), 3U);
  ASSERT_LE(field.holding_places.size(), 5U);
  for (std::size_t i = 0; i < field.holding_places.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      EXPECT_GE(norm(field.holding_places[i].center_m - field.holding_places[k].center_m), 200.0);
    }
  }
}

TEST(FallbackField, WhereNothingIsCutOffNothingChanges) {
  const ObstacleMap map = samples::map_of(Mask(50, 40), 1.0);
  for (const Mission& mission :
       {Mission{GoalMission{{25.0, 20.0}, {}}}, Mission{PathMission{{{9.0, 9.0}, {40.0, 30.0}}}}}) {
    const Field hold = field_of(map, mission, FallbackRule::hold);
    const Field none = field_of(map, mission, FallbackRule::none);
    EXPECT_TRUE(hold.holding_places.empty());
    EXPECT_EQ(
        std::memcmp(hold.heading_rad.data(), none.heading_rad.data(), 4 * hold.heading_rad.size()),
        0);
  }
}

TEST(FallbackField, ChangesNothingButCellsWithoutCommandAndLeadsAllThatIsJoinedToACircle) {
  Random random(7);
  std::size_t places = 0;
  for (int draw = 0; draw < 30; ++draw) {
    Mask m = samples::blobs(random, 90, 80, 14, 9.0);
    for (int k = 0; k < 80; ++k) m.at(40, k) = 1;  // the west is walled off
    for (int iy = 20; iy < 60; ++iy) {
      for (int ix = 45; ix < 88; ++ix) m.at(ix, iy) = 0;
    }
    const ObstacleMap map = samples::map_of(m, random.uniform(0.7, 1.7));
    const Mission mission = GoalMission{map.grid.center({66, 40}), {}};
    const Field hold = field_of(map, mission, FallbackRule::hold);
    const Field none = field_of(map, mission, FallbackRule::none);
    ASSERT_EQ(hold.region, none.region);
    ASSERT_EQ(hold.cost_m, none.cost_m);
    ASSERT_EQ(hold.unreachable_free_cells, none.unreachable_free_cells);
    places += hold.holding_places.size();
    std::vector<std::uint8_t> open(map.grid.size());
    for (std::size_t i = 0; i < open.size(); ++i) {
      if (!std::isnan(none.heading_rad[i])) {
        ASSERT_EQ(hold.heading_rad[i], none.heading_rad[i]);
        continue;
      }
      open[i] = none.region[i] != Region::obstacle ? 1 : 0;
      ASSERT_TRUE(open[i] != 0 || std::isnan(hold.heading_rad[i]));
      ASSERT_TRUE(std::isnan(hold.heading_rad[i]) || std::abs(hold.heading_rad[i]) <= 3.1415927F);
    }
    const ConnectedParts parts = connected_parts(open, map.grid.nx, map.grid.ny);
    std::vector<std::uint8_t> has_circle(parts.cells.size());
    for (const HoldingPlace& place : hold.holding_places) {
      const std::size_t at = map.grid.index(map.grid.cell_of(place.center_m));
      ASSERT_EQ(open[at], 1);
      has_circle[parts.part[at]] = 1;
    }
    for (std::size_t i = 0; i < open.size(); ++i) {
      if (open[i] == 0) continue;
      EXPECT_EQ(std::isnan(hold.heading_rad[i]), has_circle[parts.part[i]] == 0) << draw;
    }
  }
  EXPECT_GT(places, 20U);
}

TEST(FallbackField, IsTheSameOnAnyNumberOfThreads) {
  const ObstacleMap map = two_rooms(200, 60, 1.0);
  const auto made = [&] { return field_of(map, goal_above(map), FallbackRule::hold); };
  const Field one = samples::on_threads(1, made);
  const Field three = samples::on_threads(3, made);
  EXPECT_EQ(one.holding_places, three.holding_places);
  EXPECT_EQ(
      std::memcmp(one.heading_rad.data(), three.heading_rad.data(), 4 * one.heading_rad.size()), 0);
}

}  // namespace
}  // namespace fairway
