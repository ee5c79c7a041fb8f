#include "bench/proof_cases.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <stdexcept>
#include <utility>
#include <variant>

#include "bench/blob_map.hpp"
#include "bench/child_process.hpp"
#include "fairway/base/random.hpp"
#include "fairway/field/compute_field.hpp"
#include "fairway/plan/plan_of_field.hpp"

namespace fairway::bench {
namespace {

namespace fs = std::filesystem;

ObstacleMap open_map(int side, double cell_m) {
  ObstacleMap map;
  map.grid = {side, side, 0.0, 0.0, cell_m};
  map.obstacle.assign(map.grid.size(), 0);
  return map;
}

/// Four irregular obstacles: discs whose radius varies with the angle.
ObstacleMap four_obstacles(int side) {
  ObstacleMap map = open_map(side, 8.0);
  const double width = map.grid.width_m();
  Random random(5);
  for (const Vec2 at : {Vec2{0.25, 0.3}, Vec2{0.7, 0.25}, Vec2{0.3, 0.75}, Vec2{0.75, 0.7}}) {
    const double a = random.uniform(0.0, two_pi);
    const double b = random.uniform(0.0, two_pi);
    for (std::size_t i = 0; i < map.grid.size(); ++i) {
      const Vec2 from = map.grid.center(map.grid.cell_at(i)) - width * at;
      const double angle = std::atan2(from.y, from.x);
      const double radius =
          0.06 * width * (1.0 + 0.4 * std::sin(2.0 * angle + a) + 0.3 * std::sin(3.0 * angle + b));
      if (norm(from) < radius) map.obstacle[i] = 1;
    }
  }
  return map;
}

}  // namespace

Case open_case() {
  return {"20 x 20 cells, no obstacles", open_map(20, 8.0), {10.0, 20.0}, {80.0, 80.0}};
}

Case obstacles_case() {
  return {"60 x 60 cells, four obstacles", four_obstacles(60), {10.0, 20.0}, {240.0, 240.0}};
}

Case blobs_case() {
  Case blobs{"128 x 128 cells, blobs", blob_map(128, map_seed), {10.0, 4.5}, {}};
  blobs.goal_m = blobs.map.grid.center(open_place(blobs.map, 10));
  return blobs;
}

Case streets_case(int side) {
  Case streets{fmt::format("{0} x {0} cells, streets", side), open_map(side, 4.0), {10.0, 9.0}, {}};
  constexpr int block = 20;
  constexpr int street = 7;  // 28 m across, where a turn takes 18 m and room to come back
  const int middle = side / 2;
  for (std::size_t i = 0; i < streets.map.grid.size(); ++i) {
    const Cell c = streets.map.grid.cell_at(i);
    const bool is_built = c.ix % block >= street && c.iy % block >= street;
    const bool on_square = std::max(std::abs(c.ix - middle), std::abs(c.iy - middle)) < 8;
    streets.map.obstacle[i] = is_built && !on_square ? 1 : 0;
  }
  streets.goal_m = streets.map.grid.center({middle, middle});
  return streets;
}

Plan plan_of(const Case& c) {
  FieldOrRefusal answer = compute_field(c.map, c.vehicle, GoalMission{c.goal_m, {}}, {});
  if (const auto* refused = std::get_if<MissionRefusal>(&answer)) {
    throw std::runtime_error(c.name + " refuses its mission: " + refused->message);
  }
  return plan_of_field(std::move(std::get<Field>(answer)), c.vehicle);
}

void add_check_row(std::vector<Row>& rows, const Settings& settings, const fs::path& file,
                   const Took& proving, std::size_t samples, double limit) {
  const fs::path checker = fs::canonical(settings.program).parent_path() / "fairway-check";
  const std::string name = "  checking it again, times as long as proving";
  if (!fs::exists(checker)) {
    rows.push_back(without_peer(name, shown(proving), "fairway-check is not there",
                                fmt::format("{:g}", limit)));
    return;
  }
  std::string answer;
  const double before_s = ended_children_cpu_s();
  Took took = timed([&] {
    ChildProcess child({checker.string(), file.string(), "--quiet", "--threads",
                        std::to_string(settings.threads), "--samples", std::to_string(samples)});
    while (const auto line = child.read_line()) answer += *line + "\n";
  });
  took.cpu_s = ended_children_cpu_s() - before_s;
  if (answer.find("accepted") == std::string::npos) {
    throw std::runtime_error("fairway-check does not accept the certificate: " + answer);
  }
  Row row = at_most_row(name, shown(took), took.wall_s / proving.wall_s, limit);
  row.peer = shown(proving);
  row.ratio = fmt::format("{:.2f}", took.wall_s / proving.wall_s);
  rows.push_back(std::move(row));
}

}  // namespace fairway::bench
