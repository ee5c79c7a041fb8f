#include "fairway/field/passages.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "fairway/field/compute_field.hpp"
#include "fairway/field/connected_parts.hpp"
#include "fairway/field/testing/sample_maps.hpp"

namespace fairway {
namespace {

using samples::Mask;

Mask with_rim(Mask m) {
  for (int ix = 0; ix < m.nx; ++ix) m.at(ix, 0) = m.at(ix, m.ny - 1) = 1;
  for (int iy = 0; iy < m.ny; ++iy) m.at(0, iy) = m.at(m.nx - 1, iy) = 1;
  return m;
}

struct Planned {
  ObstacleMap map;
  Vehicle vehicle;
  Mission mission;
  FieldOptions options;

  FieldOrRefusal field() const { return compute_field(map, vehicle, mission, options); }
  CutOff cut_off_in(const Field& field) const {
    return cut_off(map, vehicle, mission, options, field.region, field.cost_m);
  }
};

/// Free cells of `before` that are cut off there, and still in `after`.
std::size_t still_cut_off(const Field& before, const Field& after) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < before.region.size(); ++i) {
    if (before.region[i] == Region::free && std::isinf(before.cost_m[i]) &&
        std::isinf(after.cost_m[i]))
      ++count;
  }
  return count;
}

/// The largest part of the cells cut off that stays cut off at no alpha, by brute force: any cell
/// of it that the field with hardly any buffer reaches.
std::size_t cells_in_largest_part(const Field& field, const Field& without_buffer) {
  std::vector<std::uint8_t> cut(field.region.size());
  for (std::size_t i = 0; i < cut.size(); ++i) {
    cut[i] = field.region[i] == Region::free && std::isinf(field.cost_m[i]) ? 1 : 0;
  }
  const ConnectedParts parts = connected_parts(cut, field.grid.nx, field.grid.ny);
  std::size_t most = 0;
  for (std::size_t i = 0; i < cut.size(); ++i) {
    if (cut[i] != 0 && std::isfinite(without_buffer.cost_m[i]))
      most = std::max(most, parts.cells[parts.part[i]]);
  }
  return most;
}

/// As printed in a warning.
double printed(double value) { return std::stod(fmt::format("{:.4g}", value)); }

Planned drawn_case(Random& random, Metric metric) {
  const int nx = 30 + static_cast<int>(random.below(50));
  const int ny = 30 + static_cast<int>(random.below(50));
  Mask mask = with_rim(samples::blobs(random, nx, ny, 12, 6.0));
  const int wall = nx / 3 + static_cast<int>(random.below(10));
  const int door = 3 + static_cast<int>(random.below(ny - 12));
  const int door_cells = static_cast<int>(random.below(9));
  for (int iy = 0; iy < ny; ++iy) {
    if (iy < door || iy >= door + door_cells) mask.at(wall, iy) = 1;
  }
  const double cell_m = random.uniform(0.3, 2.0);
  Planned p{samples::map_of(mask, cell_m, random.uniform(-9.0, 9.0)), {5.0, 2.2 * cell_m}, {}, {}};
  p.options.metric = metric;
  p.options.alpha = random.uniform(0.5, 2.0);
  p.options.beta = random.uniform(0.5, 1.2);
  p.mission = GoalMission{{p.map.grid.x0_m + random.uniform(1.0, nx - 1.0) * cell_m,
                           random.uniform(1.0, ny - 1.0) * cell_m},
                          {}};
  return p;
}

TEST(CutOff, TheReportedAlphaAndRadiusOpenThePassageAndSlightlyMoreDoesNot) {
  Random random(901);
  int opened = 0;
  int by_radius = 0;
  int walled = 0;
  for (int draw = 0; draw < 1500; ++draw) {
    const Metric metric = draw % 3 == 0   ? Metric::paper
                          : draw % 3 == 1 ? Metric::octile
                                          : Metric::euclidean;
    Planned p = drawn_case(random, metric);
    const FieldOrRefusal answer = p.field();
    const Field* before = std::get_if<Field>(&answer);
    if (before == nullptr || before->unreachable_free_cells == 0) continue;
    const CutOff cut = p.cut_off_in(*before);
    EXPECT_EQ(cut.cut_off_cells, before->unreachable_free_cells);

    Planned bare = p;
    bare.options.alpha = 1e-3;
    const FieldOrRefusal bare_answer = bare.field();
    const Field& without_buffer = std::get<Field>(bare_answer);
    EXPECT_EQ(cut.walled_off_cells, still_cut_off(*before, without_buffer)) << draw;
    const std::size_t largest = cells_in_largest_part(*before, without_buffer);
    ASSERT_EQ(cut.passage.has_value(), largest > 0) << draw;
    if (!cut.passage) {
      ++walled;
      continue;
    }
    EXPECT_GE(cut.passage->opens_cells, largest);

    const auto cut_off_with = [&](double alpha, double turn_radius_m) {
      Planned again = p;
      again.options.alpha = alpha;
      again.vehicle.turn_radius_m = turn_radius_m;
      const FieldOrRefusal again_answer = again.field();
      return still_cut_off(*before, std::get<Field>(again_answer));
    };
    const double r = p.vehicle.turn_radius_m;
    const double alpha = printed(cut.passage->alpha);
    EXPECT_EQ(alpha, cut.passage->alpha);
    EXPECT_EQ(cut_off_with(alpha, r), cut.cut_off_cells - cut.passage->opens_cells) << draw;
    EXPECT_GT(cut_off_with(std::min(alpha * 1.002, p.options.alpha), r),
              cut.cut_off_cells - cut.passage->opens_cells)
        << draw;
    ++opened;
    if (!cut.passage->turn_radius_m) continue;
    const double radius_m = printed(*cut.passage->turn_radius_m);
    EXPECT_EQ(cut_off_with(p.options.alpha, radius_m), cut.cut_off_cells - cut.passage->opens_cells)
        << draw;
    EXPECT_GT(cut_off_with(p.options.alpha, std::min(radius_m * 1.002, r)),
              cut.cut_off_cells - cut.passage->opens_cells)
        << draw;
    ++by_radius;
  }
  EXPECT_GT(opened, 60);
  EXPECT_GT(by_radius, 15);
  EXPECT_GT(walled, 5);
}

TEST(CutOff, ACorridorIsTheNarrowestPlaceItselfInItsMiddle) {
  Mask mask = with_rim(Mask(60, 30));
  for (int ix = 25; ix < 36; ++ix) {
    for (int iy = 0; iy < 30; ++iy) mask.at(ix, iy) = iy < 13 || iy > 17 ? 1 : 0;  // 5 cells wide
  }
  Planned p{samples::map_of(mask, 2.0, 100.0), {1.0, 3.0}, GoalMission{{122.0, 30.0}, {}}, {}};
  p.options.beta = 1.0;
  const FieldOrRefusal answer = p.field();
  const CutOff cut = p.cut_off_in(std::get<Field>(answer));
  ASSERT_TRUE(cut.passage);
  EXPECT_EQ(cut.walled_off_cells, 0U);
  EXPECT_EQ(cut.passage->opens_cells, cut.cut_off_cells);
  EXPECT_NEAR(cut.passage->place_m.x, 161.0, 3.0);
  EXPECT_DOUBLE_EQ(cut.passage->place_m.y, 31.0);
  EXPECT_DOUBLE_EQ(cut.passage->width_m, 12.0);  // three cells to either side
  EXPECT_DOUBLE_EQ(cut.passage->needed_m, 12.0);
  EXPECT_NEAR(cut.passage->alpha, 2.0, 1e-3);
  EXPECT_LT(cut.passage->alpha, 2.0);
}

TEST(CutOff, NothingIsSaidWhereEveryFreeCellReaches) {
  Planned p{
      samples::map_of(with_rim(Mask(40, 40)), 1.0), {1.0, 2.0}, GoalMission{{20, 20}, {}}, {}};
  const FieldOrRefusal answer = p.field();
  const CutOff cut = p.cut_off_in(std::get<Field>(answer));
  EXPECT_EQ(cut.cut_off_cells, 0U);
  EXPECT_EQ(cut.share(), 0.0);
  EXPECT_FALSE(cut.passage);
}

TEST(ConnectedParts, CellsThatTouchAtACornerAreOnePart) {
  const Mask m = samples::drawn({"##..#",  //
                                 "..#..",  //
                                 "....#"});
  const ConnectedParts parts = connected_parts(m.cells, m.nx, m.ny);
  ASSERT_EQ(parts.cells.size(), 3U);
  EXPECT_EQ(parts.part[m.index(2, 1)], parts.part[m.index(1, 2)]);
  EXPECT_EQ(parts.part[m.index(0, 0)], no_part);
  EXPECT_EQ(parts.cells[parts.largest()], 3U);
  EXPECT_EQ(connected_parts({}, 0, 0).largest(), no_part);
}

}  // namespace
}  // namespace fairway
