#include "fairway/field/compute_field.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

#include "fairway/base/error.hpp"
#include "fairway/base/heading.hpp"
#include "fairway/field/testing/sample_maps.hpp"

namespace fairway {
namespace {

using samples::Mask;

constexpr Vehicle vehicle{10.0, 4.0};
constexpr double inf = std::numeric_limits<double>::infinity();

// A map with room for both missions in its middle; obstacles, pockets and walls around.
ObstacleMap blob_map(Random& random, int nx = 64, int ny = 56) {
  Mask m = samples::blobs(random, nx, ny, 10, 4.0);
  for (int k = 0; k < 15; ++k) {  // a yard with a free pocket
    m.at(k, 14) = m.at(14, k) = 1;
  }
  for (int iy = 0; iy < 5; ++iy) {
    for (int ix = 0; ix < 5; ++ix) m.at(ix, iy) = 0;
  }
  for (int iy = 18; iy < 44; ++iy) {
    for (int ix = 16; ix < 48; ++ix) m.at(ix, iy) = 0;
  }
  return samples::map_of(m, 1.25);
}

const GoalMission goal{{39.3, 36.2}, {}};
const PathMission path{{{30.3, 32.1}, {47.2, 33.9}, {46.1, 44.0}, {31.0, 42.5}}, true};
const PathMission line{{{28.0, 30.0}, {50.0, 45.0}}, false};

FieldOptions modest() {
  FieldOptions options;
  options.alpha = 1.0;
  options.beta = 1.0;
  return options;
}

Field field_of(const ObstacleMap& map, const Mission& mission, const FieldOptions& options) {
  FieldOrRefusal found = compute_field(map, vehicle, mission, options);
  const auto* refusal = std::get_if<MissionRefusal>(&found);
  if (refusal != nullptr) throw std::runtime_error(refusal->message);
  return std::get<Field>(std::move(found));
}

void expect_field(const Field& f, const ObstacleMap& map) {
  ASSERT_EQ(f.grid, map.grid);
  const std::size_t cells = f.grid.size();
  ASSERT_EQ(f.region.size(), cells);
  ASSERT_EQ(f.cost_m.size(), cells);
  ASSERT_EQ(f.heading_rad.size(), cells);
  std::size_t unreachable = 0;
  std::size_t goals = 0;
  for (std::size_t i = 0; i < cells; ++i) {
    const Region r = f.region[i];
    ASSERT_TRUE(r == Region::free || r == Region::buffer || r == Region::obstacle ||
                r == Region::goal);
    ASSERT_EQ(r == Region::obstacle, map.obstacle[i] != 0);
    ASSERT_TRUE(f.cost_m[i] >= 0.0F);  // not NaN either
    ASSERT_TRUE(r != Region::obstacle || f.cost_m[i] == inf);
    ASSERT_TRUE(r != Region::goal || std::isfinite(f.cost_m[i]));
    ASSERT_TRUE(!std::isnan(f.heading_rad[i]) || !std::isfinite(f.cost_m[i])) << "cell " << i;
    ASSERT_TRUE(std::isnan(f.heading_rad[i]) || std::isfinite(f.cost_m[i]) ||
                (r != Region::obstacle && !f.holding_places.empty()))
        << "cell " << i;
    if (std::isfinite(f.cost_m[i])) {
      const double h = f.heading_rad[i];
      ASSERT_TRUE(h > -pi && h <= pi) << h;
    }
    unreachable += r == Region::free && !std::isfinite(f.cost_m[i]) ? 1 : 0;
    goals += r == Region::goal ? 1 : 0;
  }
  ASSERT_EQ(f.unreachable_free_cells, unreachable);
  ASSERT_GT(goals, 0U);
}

TEST(ComputeField, HoldsItsPropertiesWithEveryMetricFilterBlendAndMission) {
  Random random(131);
  std::size_t unreachable = 0;
  for (int draw = 0; draw < 6; ++draw) {
    const ObstacleMap map = blob_map(random);
    for (const Metric metric : {Metric::euclidean, Metric::octile, Metric::paper}) {
      for (const Filter filter : {Filter::paper, Filter::free_space}) {
        for (const Blend blend : {Blend::paper, Blend::continuous}) {
          for (const Mission& mission : {Mission{goal}, Mission{path}, Mission{line}}) {
            FieldOptions options = modest();
            options.metric = metric;
            options.filter = filter;
            options.blend = blend;
            options.sigma_cells = draw == 0 ? 0.0 : random.uniform(0.2, 9.0);
            options.sigma_path = draw == 1 ? 0.0 : random.uniform(0.1, 2.0);
            options.sigma_border = draw == 2 ? 0.0 : random.uniform(0.1, 2.0);
            const Field f = field_of(map, mission, options);
            expect_field(f, map);
            if (HasFatalFailure()) FAIL() << "draw " << draw;
            unreachable += f.unreachable_free_cells;
          }
        }
      }
    }
  }
  EXPECT_GT(unreachable, 0U) << "no map had a walled-off pocket";
}

bool same_bits(const std::vector<float>& a, const std::vector<float>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

TEST(ComputeField, DoesNotDependOnTheNumberOfThreads) {
  Random random(132);
  Mask m = samples::blobs(random, 800, 700, 150, 14.0);
  for (int iy = 300; iy < 340; ++iy) {
    for (int ix = 400; ix < 440; ++ix) m.at(ix, iy) = 0;
  }
  const ObstacleMap map = samples::map_of(m, 1.0);
  ASSERT_GT(map.grid.size(), 500'000U) << "the cost-to-go uses threads from here on";
  const auto computed = [&] { return field_of(map, GoalMission{{420.5, 320.3}, {}}, modest()); };
  const Field one = samples::on_threads(1, computed);
  for (const int threads : {2, 3}) {
    const Field many = samples::on_threads(threads, computed);
    EXPECT_EQ(one.region, many.region);
    EXPECT_TRUE(same_bits(one.cost_m, many.cost_m)) << threads << " threads";
    EXPECT_TRUE(same_bits(one.heading_rad, many.heading_rad)) << threads << " threads";
    EXPECT_EQ(one.vanished_cells, many.vanished_cells);
  }
}

// --- Symmetry ------------------------------------------------------------------------------------

// Turning or mirroring map and mission turns or mirrors the plan: regions and costs to float
// rounding in every cell. Headings, where no tie is decided by the order of the cells.
struct Image {
  ObstacleMap map;
  Mission mission;
  std::vector<Region> region;
  std::vector<float> cost_m;
  std::vector<float> heading_rad;  ///< turned or mirrored as directions too
};

Vec2 quarter_turned(const Grid& g, Vec2 p) { return {g.height_m() - p.y, p.x}; }
Vec2 mirrored(const Grid& g, Vec2 p) { return {g.width_m() - p.x, p.y}; }

template <typename Move>
Mission moved(const Mission& mission, const Move& move) {
  Mission out = mission;
  if (auto* g = std::get_if<GoalMission>(&out)) {
    g->goal_m = move(g->goal_m);
  } else {
    for (Vec2& p : std::get<PathMission>(out).vertices_m) p = move(p);
  }
  return out;
}

Image image_of(const ObstacleMap& map, const Mission& mission, const Field& f, bool turn) {
  const Grid& g = map.grid;
  Image out;
  out.map = map;
  const auto arrange = [&](const auto& array) {
    return turn ? samples::quarter_turned(array, g.nx, g.ny) : samples::mirrored(array, g.nx, g.ny);
  };
  if (turn) out.map.grid = {g.ny, g.nx, 0.0, 0.0, g.cell_m};
  out.map.obstacle = arrange(map.obstacle);
  out.mission =
      moved(mission, [&](Vec2 p) { return turn ? quarter_turned(g, p) : mirrored(g, p); });
  out.region = arrange(f.region);
  out.cost_m = arrange(f.cost_m);
  out.heading_rad = arrange(f.heading_rad);
  for (float& h : out.heading_rad) {
    if (!std::isnan(h)) h = Heading::stored(turn ? h + pi / 2 : pi - h);
  }
  return out;
}

// Cells whose commands in `f`'s image and in `other` differ by more than 0.002 rad.
std::vector<std::uint8_t> apart_of(const Image& image, const Field& other) {
  std::vector<std::uint8_t> apart(image.cost_m.size(), 0);
  for (std::size_t i = 0; i < apart.size(); ++i) {
    if (!std::isfinite(image.cost_m[i])) continue;  // circles have a side
    const double turn =
        Heading::from_rad(image.heading_rad[i]).turn_to(Heading::from_rad(other.heading_rad[i]));
    apart[i] = std::fabs(turn) > 0.002 ? 1 : 0;
  }
  return apart;
}

void expect_same_regions_and_costs(const Image& image, const Field& other) {
  ASSERT_EQ(other.region, image.region);
  for (std::size_t i = 0; i < image.cost_m.size(); ++i) {
    const bool finite = std::isfinite(image.cost_m[i]);
    ASSERT_EQ(std::isfinite(other.cost_m[i]), finite) << "cell " << i;
    if (!finite || image.region[i] == Region::buffer)
      continue;  // either of two tied exits may count
    ASSERT_NEAR(other.cost_m[i], image.cost_m[i], 1e-5 * (1.0 + image.cost_m[i])) << "cell " << i;
  }
}

// Two exits from the buffer at the same least distance: the order of the cells chooses.
bool tied_exits(const Image& image, std::size_t i) {
  const Grid& g = image.map.grid;
  double least = inf;
  int count = 0;
  for (std::size_t b = 0; b < g.size(); ++b) {
    const bool safe = image.region[b] == Region::free || image.region[b] == Region::goal;
    if (!safe || !std::isfinite(image.cost_m[b])) continue;
    const double d = norm(g.center(g.cell_at(b)) - g.center(g.cell_at(i)));
    if (d < least - 1e-9) count = 0;
    if (d < least + 1e-9) ++count;
    least = std::min(least, d);
  }
  return count > 1;
}

TEST(ComputeField, TurnsAndMirrorsWithMapAndMissionExceptForTiedExitsAndRidges) {
  for (const Metric metric : {Metric::euclidean, Metric::octile, Metric::paper}) {
    Random random(133);
    std::size_t commands = 0;
    std::size_t untied_apart = 0;
    std::size_t all_apart = 0;
    for (int draw = 0; draw < 8; ++draw) {
      const ObstacleMap map = blob_map(random);
      const bool turn = draw % 2 == 0;
      const Mission mission = draw % 4 < 2 ? Mission{goal} : Mission{line};
      FieldOptions options = modest();
      options.metric = metric;
      options.axis_capture_rad = 0.0;
      options.path_field = PathField::paper;  // the other's looks for obstacles meet cells' corners
      options.sigma_path = options.sigma_border = options.sigma_cells = 0.0;
      const Image raw = image_of(map, mission, field_of(map, mission, options), turn);
      const Field other = field_of(raw.map, raw.mission, options);
      expect_same_regions_and_costs(raw, other);
      const std::vector<std::uint8_t> apart = apart_of(raw, other);
      for (std::size_t i = 0; i < apart.size(); ++i) {
        commands += std::isnan(raw.heading_rad[i]) ? 0 : 1;
        all_apart += apart[i];
        if (apart[i] == 0) continue;
        untied_apart += raw.region[i] == Region::buffer && tied_exits(raw, i) ? 0 : 1;
      }
      // Filtered, a cell is apart only if its kernel holds one that was. Between walls a cell sees
      // along its row first and then along its column: that mirrors, but does not turn. The
      // paper's filter with the paper's metric averages directions of obstacles, tied ones too.
      if (metric == Metric::paper && turn) continue;
      options.sigma_cells = 1.5;
      options.filter = turn ? Filter::paper : Filter::free_space;
      const Image smooth = image_of(map, mission, field_of(map, mission, options), turn);
      const Field smooth_other = field_of(smooth.map, smooth.mission, options);
      expect_same_regions_and_costs(smooth, smooth_other);
      const std::vector<std::uint8_t> now_apart = apart_of(smooth, smooth_other);
      const Grid& g = raw.map.grid;
      for (std::size_t i = 0; i < now_apart.size(); ++i) {
        if (now_apart[i] == 0) continue;
        const Cell c = g.cell_at(i);
        bool explained = false;
        for (int iy = std::max(0, c.iy - 3); iy <= std::min(g.ny - 1, c.iy + 3); ++iy) {
          for (int ix = std::max(0, c.ix - 3); ix <= std::min(g.nx - 1, c.ix + 3); ++ix) {
            explained = explained || apart[g.index({ix, iy})] != 0;
          }
        }
        ASSERT_TRUE(explained) << "cell " << c.ix << ", " << c.iy << ", draw " << draw;
      }
      if (HasFatalFailure()) FAIL() << "draw " << draw;
    }
    // Measured: 2.5, 3.9 and 3.3 % of the commands.
    EXPECT_LT(static_cast<double>(all_apart), 0.05 * static_cast<double>(commands));
    // Octile and paper costs also tie between neighbours in safe start: 1.4 and 1.6 %.
    const double share = metric == Metric::euclidean ? 0.0 : 0.025;
    EXPECT_LE(static_cast<double>(untied_apart), share * static_cast<double>(commands));
  }
}

// --- Answers -------------------------------------------------------------------------------------

TEST(ComputeField, AGoalThatNoOtherCellCanReachIsRefusedAsUnreachable) {
  // A round yard whose one free cell is the goal.
  Mask m(60, 60, 1);
  for (int iy = 0; iy < 60; ++iy) {
    for (int ix = 0; ix < 60; ++ix) {
      if (std::hypot(ix - 30, iy - 30) < 4.3) m.at(ix, iy) = 0;
    }
  }
  FieldOptions options = modest();
  options.beta = 0.19;
  const FieldOrRefusal found =
      compute_field(samples::map_of(m, 1.0), vehicle, GoalMission{{30.5, 30.5}, {}}, options);
  const auto* refusal = std::get_if<MissionRefusal>(&found);
  ASSERT_NE(refusal, nullptr);
  EXPECT_EQ(refusal->reason, MissionRefusal::Reason::unreachable);
  EXPECT_FALSE(refusal->message.empty());
}

TEST(ComputeField, WalledOffPocketsAreCountedAndLeftWithoutACommand) {
  Mask m(90, 50);
  for (int iy = 0; iy < 50; ++iy) m.at(60, iy) = 1;
  const ObstacleMap map = samples::map_of(m, 1.0);
  const Field f = field_of(map, GoalMission{{30.0, 25.0}, {}}, modest());
  expect_field(f, map);
  EXPECT_EQ(f.unreachable_free_cells, 25U * 50U);  // from x = 65 on: four cells are buffer
}

TEST(ComputeField, RefusalsOfTheCompleteMapPassThrough) {
  const ObstacleMap map = samples::map_of(Mask(30, 30), 1.0);
  const FieldOrRefusal found = compute_field(map, vehicle, GoalMission{{31.0, 2.0}, {}}, modest());
  ASSERT_TRUE(std::holds_alternative<MissionRefusal>(found));
  EXPECT_EQ(std::get<MissionRefusal>(found).reason, MissionRefusal::Reason::outside_map);
}

TEST(ComputeField, TinyAndThinMapsGetAnAnswer) {
  for (const auto& [nx, ny] :
       std::vector<std::array<int, 2>>{{1, 1}, {2, 1}, {1, 2}, {1, 60}, {60, 1}, {2, 60}, {3, 3}}) {
    for (const bool blocked : {false, true}) {
      Mask m(nx, ny);
      m.cells.back() = blocked ? 1 : 0;
      const ObstacleMap map = samples::map_of(m, 1.0);
      for (const Metric metric : {Metric::euclidean, Metric::octile, Metric::paper}) {
        for (const Filter filter : {Filter::paper, Filter::free_space}) {
          FieldOptions options = modest();
          options.metric = metric;
          options.filter = filter;
          const Mission long_way = nx > ny ? PathMission{{{0.2, 0.5}, {1.2, 0.5}}}
                                           : PathMission{{{0.5, 0.2}, {0.5, ny > 1 ? 1.2 : 0.8}}};
          for (const Mission& mission : {Mission{GoalMission{{0.5, 0.5}, {}}}, long_way}) {
            const FieldOrRefusal found = compute_field(map, vehicle, mission, options);
            if (const auto* f = std::get_if<Field>(&found)) expect_field(*f, map);
            if (HasFatalFailure()) FAIL() << nx << " x " << ny;
          }
        }
      }
    }
  }
  const Field row =
      field_of(samples::map_of(Mask(60, 1), 1.0), GoalMission{{30.0, 0.5}, {}}, modest());
  EXPECT_NEAR(row.heading_rad[5], 0.0, 1e-6);
  EXPECT_NEAR(std::fabs(row.heading_rad[55]), pi, 1e-6);
}

TEST(ComputeField, WhereTheFiltersMeanVanishesTheCellKeepsItsDirectionAndIsCounted) {
  // One row with the goal in its middle, and a kernel so wide that east and west cancel.
  const ObstacleMap map = samples::map_of(Mask(60, 1), 1.0);
  FieldOptions options = modest();
  options.sigma_cells = 9000.0;
  const Field f = field_of(map, GoalMission{{30.0, 0.5}, {}}, options);
  expect_field(f, map);
  EXPECT_GT(f.vanished_cells, 0U);
  for (std::size_t i = 0; i < 60; ++i) {
    EXPECT_EQ(f.heading_rad[i], i < 30 ? 0.0F : Heading::stored(pi)) << "cell " << i;
  }
  options.sigma_cells = 2.0;
  EXPECT_EQ(field_of(map, GoalMission{{30.0, 0.5}, {}}, options).vanished_cells, 0U);
}

TEST(ComputeField, BetweenOppositeFlowsAPathCellKeepsItsTangent) {
  const ObstacleMap map = samples::map_of(Mask(61, 41), 1.0);
  const PathMission upward{{{30.5, 0.5}, {30.5, 40.5}}, false};
  FieldOptions options = modest();
  options.sigma_path = 0.0;
  options.sigma_cells = 2.0;
  const Field f = field_of(map, upward, options);
  expect_field(f, map);
  for (int iy = 0; iy < 41; ++iy) {
    EXPECT_NEAR(f.heading_rad[f.grid.index({30, iy})], pi / 2, 1e-4);
  }
}

TEST(ComputeField, CommandsNearAnAxisAreCapturedOnlyAsFarAsAsked) {
  Random random(134);
  const ObstacleMap map = blob_map(random);
  FieldOptions options = modest();
  options.axis_capture_rad = 0.0;
  const Field off = field_of(map, goal, options);
  options.axis_capture_rad = 0.05;
  const Field on = field_of(map, goal, options);
  std::size_t captured = 0;
  for (std::size_t i = 0; i < off.heading_rad.size(); ++i) {
    if (std::isnan(off.heading_rad[i])) continue;
    const double quarter = std::round(off.heading_rad[i] / (pi / 2)) * (pi / 2);
    const double distance = std::fabs(off.heading_rad[i] - quarter);
    if (std::fabs(distance - 0.05) < 1e-6) continue;
    if (distance < 0.05) {
      ASSERT_EQ(on.heading_rad[i], Heading::stored(quarter));
      captured += distance > 0.0 ? 1 : 0;
    } else {
      ASSERT_EQ(on.heading_rad[i], off.heading_rad[i]);
    }
  }
  EXPECT_GT(captured, 20U);
  options.metric = Metric::paper;
  const Field paper_on = field_of(map, goal, options);
  options.axis_capture_rad = 0.0;
  EXPECT_TRUE(same_bits(paper_on.heading_rad, field_of(map, goal, options).heading_rad));
}

// --- Preconditions -------------------------------------------------------------------------------

TEST(ComputeField, BrokenPreconditionsThrow) {
  const ObstacleMap map = samples::map_of(Mask(20, 20), 1.0);
  const Mission mission = GoalMission{{10.0, 10.0}, {}};
  const auto with_options = [&](auto change) {
    FieldOptions options = modest();
    change(options);
    return [=] { (void)compute_field(map, vehicle, mission, options); };
  };
  const auto with_map = [&](auto change) {
    ObstacleMap other = map;
    change(other);
    return [=] { (void)compute_field(other, vehicle, mission, modest()); };
  };
  EXPECT_NO_THROW(with_options([](FieldOptions&) {})());
  for (const double bad : {0.0, -1.0, inf, std::nan("")}) {
    EXPECT_THROW(with_options([=](auto& o) { o.alpha = bad; })(), PreconditionViolation) << bad;
    EXPECT_THROW(with_options([=](auto& o) { o.beta = bad; })(), PreconditionViolation) << bad;
    EXPECT_THROW(with_options([=](auto& o) { o.mu_path = bad; })(), PreconditionViolation) << bad;
    EXPECT_THROW(with_options([=](auto& o) { o.mu_border = bad; })(), PreconditionViolation) << bad;
    EXPECT_THROW(with_map([=](auto& m) { m.grid.cell_m = bad; })(), PreconditionViolation) << bad;
    EXPECT_THROW((void)compute_field(map, {bad, 4.0}, mission, modest()), PreconditionViolation);
    EXPECT_THROW((void)compute_field(map, {10.0, bad}, mission, modest()), PreconditionViolation);
  }
  for (const double bad : {-1e-9, inf, std::nan("")}) {
    EXPECT_THROW(with_options([=](auto& o) { o.sigma_cells = bad; })(), PreconditionViolation)
        << bad;
    EXPECT_THROW(with_options([=](auto& o) { o.sigma_path = bad; })(), PreconditionViolation)
        << bad;
    EXPECT_THROW(with_options([=](auto& o) { o.sigma_border = bad; })(), PreconditionViolation)
        << bad;
    EXPECT_THROW(with_options([=](auto& o) { o.axis_capture_rad = bad; })(), PreconditionViolation);
  }
  EXPECT_THROW(with_options([](auto& o) { o.mu_path = 1.01; })(), PreconditionViolation);
  EXPECT_THROW(with_options([](auto& o) { o.mu_border = 1.01; })(), PreconditionViolation);
  EXPECT_THROW(with_map([](auto& m) { m.obstacle.pop_back(); })(), PreconditionViolation);
  EXPECT_THROW(with_map([](auto& m) { m.grid.nx = 0; })(), PreconditionViolation);
  EXPECT_THROW(with_map([](auto& m) { m.grid.x0_m = inf; })(), PreconditionViolation);
  EXPECT_THROW((void)compute_field(map, {10.0, 1.0}, mission, modest()), PreconditionViolation)
      << "a turning radius not larger than the cell";
  EXPECT_THROW((void)compute_field(map, vehicle, GoalMission{{inf, 1.0}, {}}, modest()),
               PreconditionViolation);
  EXPECT_THROW((void)compute_field(map, vehicle, PathMission{{{1.0, 1.0}}}, modest()),
               PreconditionViolation);
  EXPECT_THROW(
      (void)compute_field(map, vehicle, PathMission{{{1.0, 1.0}, {2.0, std::nan("")}}}, modest()),
      PreconditionViolation);
}

}  // namespace
}  // namespace fairway
