// Plans with modes: what the proof of sixteen further ones takes compared with that of the plan's
// own field, what they bring, and how long checking takes.
#include <fmt/core.h>
#include <unistd.h>

#include <cstddef>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench/proof_cases.hpp"
#include "bench/sections.hpp"
#include "fairway/certificate/certificate_file.hpp"
#include "fairway/field/direction_field.hpp"
#include "fairway/run/verification.hpp"

namespace fairway::bench {
namespace {

namespace fs = std::filesystem;

constexpr int directions = 16;

Plan with_directions(Plan plan) {
  const double bends_within_m = 1.2 * plan.vehicle.turn_radius_m;
  for (int k = 0; k < directions; ++k) {
    const double rad = Heading::from_rad(two_pi * k / directions).rad();
    const auto field = direction_field(plan.grid, plan.region, rad, bends_within_m);
    plan.mode_heading_rad.insert(plan.mode_heading_rad.end(), field.begin(), field.end());
    plan.record.modes.push_back({"direction", rad});
  }
  return plan;
}

double reach_of(const Verification& proof) {
  return proof.outcome.volume.all[static_cast<std::size_t>(Verdict::reach)];
}

}  // namespace

std::vector<Row> modes_rows(const Settings& settings) {
  const bool quick = settings.side < 1024;
  const Case streets = streets_case(quick ? 40 : 120);
  const Plan alone = plan_of(streets);
  const Plan modal = with_directions(alone);
  CertifyOptions options;
  options.undecided_max = quick ? 0.2 : 0.01;
  Verification of_one;
  Verification of_all;
  const auto took = interleaved(
      settings.repeats,
      [&] { return timed([&] { of_all = verify_plan(modal, streets.name, {}, options); }); },
      [&] { return timed([&] { of_one = verify_plan(alone, streets.name, {}, options); }); });
  if (reach_of(of_all) < reach_of(of_one)) {
    throw std::runtime_error("further modes prove less than the first alone");
  }
  std::vector<Row> rows;
  rows.push_back(
      ratio_row(fmt::format("modes, {}: proving with {} further ones", streets.name, directions),
                fmt::format("{}, {:.1f} % reach", shown(took.ours), 100.0 * reach_of(of_all)),
                fmt::format("{}, {:.1f} %", shown(took.peer), 100.0 * reach_of(of_one)),
                took.ours.wall_s / took.peer.wall_s, 6.0, "6"));
  const fs::path file =
      fs::temp_directory_path() / fmt::format("fairway-bench-modes-{}.safetensors", ::getpid());
  write_certificate(of_all.certificate, file, Existing::replace);
  add_check_row(rows, settings, file, took.ours, 20'000, 3.0);
  fs::remove(file);
  return rows;
}

}  // namespace fairway::bench
