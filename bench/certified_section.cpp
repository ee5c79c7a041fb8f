// Proved verdicts: how much is left undecided after how long, how long a query of a mapped file
// takes, and how long the independent checker takes compared with the prover.
#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "bench/blob_map.hpp"
#include "bench/child_process.hpp"
#include "bench/sections.hpp"
#include "fairway/base/mapped_file.hpp"
#include "fairway/base/random.hpp"
#include "fairway/certificate/certificate_file.hpp"
#include "fairway/field/compute_field.hpp"
#include "fairway/plan/plan_of_field.hpp"
#include "fairway/run/verification.hpp"
#include "fairway/runtime.hpp"

namespace fairway::bench {
namespace {

namespace fs = std::filesystem;

struct Case {
  std::string name;
  ObstacleMap map;
  Vehicle vehicle;
  Vec2 goal_m;
};

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

Plan plan_of(const Case& c) {
  FieldOrRefusal answer = compute_field(c.map, c.vehicle, GoalMission{c.goal_m, {}}, {});
  if (const auto* refused = std::get_if<MissionRefusal>(&answer)) {
    throw std::runtime_error(c.name + " refuses its mission: " + refused->message);
  }
  return plan_of_field(std::move(std::get<Field>(answer)), c.vehicle);
}

struct Proved {
  Verification verification;
  Took took;

  double undecided() const { return verification.outcome.volume.all[0]; }
};
Proved prove(const Plan& plan, const std::string& name, double undecided_max) {
  CertifyOptions options;
  options.undecided_max = undecided_max;
  Proved proved;
  proved.took = timed([&] { proved.verification = verify_plan(plan, name, {}, options); });
  return proved;
}

/// Nanoseconds per query on one core, over random states of the grid.
double query_ns(const fs::path& file, int repeats) {
  const MappedFile mapped(file);
  runtime::Certificate certificate;
  if (certificate.open(mapped.bytes().data(), mapped.bytes().size()) != runtime::Status::ok) {
    throw std::runtime_error("the certificate cannot be opened");
  }
  const Flow& flow = certificate.flow();
  constexpr std::size_t count = 200'000;
  std::vector<State> states(count);
  Random random(11);
  for (State& s : states) {
    s = {{flow.grid.x0_m + random.unit() * flow.grid.nx * flow.grid.cell_m,
          flow.grid.y0_m + random.unit() * flow.grid.ny * flow.grid.cell_m},
         Heading::from_rad(random.uniform(-pi, pi))};
  }
  std::vector<double> ns;
  std::size_t reached = 0;
  for (int i = 0; i < repeats; ++i) {
    const Took took = timed([&] {
      for (const State& s : states) {
        reached += certificate.query(s.position_m.x, s.position_m.y, s.heading.rad()).verdict ==
                   Verdict::reach;
      }
    });
    ns.push_back(1e9 * took.cpu_s / static_cast<double>(count));
  }
  if (reached == 0) throw std::runtime_error("no query answers reach");
  return median(ns);
}

void add_check_row(std::vector<Row>& rows, const Settings& settings, const fs::path& file,
                   const Took& proving) {
  const fs::path checker = fs::canonical(settings.program).parent_path() / "fairway-check";
  const std::string name = "  checking it again, times as long as proving";
  if (!fs::exists(checker)) {
    rows.push_back(without_peer(name, shown(proving), "fairway-check is not there", "3"));
    return;
  }
  std::string answer;
  const Took took = timed([&] {
    ChildProcess child({checker.string(), file.string(), "--quiet", "--threads",
                        std::to_string(settings.threads)});
    while (const auto line = child.read_line()) answer += *line + "\n";
  });
  if (answer.find("accepted") == std::string::npos) {
    throw std::runtime_error("fairway-check does not accept the certificate: " + answer);
  }
  Row row =
      at_most_row(name, fmt::format("{:.2f} s", took.wall_s), took.wall_s / proving.wall_s, 3.0);
  row.peer = shown(proving);
  row.ratio = fmt::format("{:.2f}", took.wall_s / proving.wall_s);
  rows.push_back(std::move(row));
}

void add_case(std::vector<Row>& rows, const Settings& settings, const Case& c, double share,
              double limit_s) {
  const Plan plan = plan_of(c);
  const Proved proved = prove(plan, c.name, share);
  const double undecided = proved.undecided();
  rows.push_back(
      at_most_row(fmt::format("certified, {}: to {:g} % undecided", c.name, 100.0 * share),
                  fmt::format("{}, {:.3f} % left", shown(proved.took), 100.0 * undecided),
                  undecided <= share ? proved.took.wall_s : INFINITY, limit_s));
  const fs::path file =
      fs::temp_directory_path() / fmt::format("fairway-bench-{}.safetensors", ::getpid());
  write_certificate(proved.verification.certificate, file, Existing::replace);
  rows.push_back({"  leaves, bytes on disk",
                  fmt::format("{}, {:.1f} MB", proved.verification.certificate.sections.leaves(),
                              1e-6 * static_cast<double>(fs::file_size(file)))});
  const double ns = query_ns(file, settings.repeats);
  rows.push_back(at_least_row("  queries a second and core (million)",
                              fmt::format("{:.2f} million ({:.0f} ns CPU each)", 1e3 / ns, ns),
                              1e3 / ns, 1.0));
  add_check_row(rows, settings, file, proved.took);
  fs::remove(file);
}

}  // namespace

std::vector<Row> certified_rows(const Settings& settings) {
  std::vector<Row> rows;
  const Case open{"20 x 20 cells, no obstacles", open_map(20, 8.0), {10.0, 20.0}, {80.0, 80.0}};
  add_case(rows, settings, open, 0.005, 20.0);
  add_case(rows, settings, open, 0.002, 60.0);
  if (settings.side < 1024) return rows;  // --quick
  add_case(rows, settings,
           {"60 x 60 cells, four obstacles", four_obstacles(60), {10.0, 20.0}, {240.0, 240.0}},
           0.01, 180.0);
  Case blobs{"128 x 128 cells, blobs", blob_map(128, map_seed), {10.0, 4.5}, {}};
  blobs.goal_m = blobs.map.grid.center(open_place(blobs.map, 10));
  add_case(rows, settings, blobs, 0.01, 300.0);
  return rows;
}

}  // namespace fairway::bench
