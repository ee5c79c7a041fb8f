// Proofs under a vehicle contract: how long they take and how much they prove, how long a query
// takes, and how long the independent checker takes compared with the prover.
#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench/proof_cases.hpp"
#include "bench/sections.hpp"
#include "fairway/base/random.hpp"
#include "fairway/certificate/contract_certificate_file.hpp"
#include "fairway/inclusion/quick_lookup.hpp"
#include "fairway/run/contract_verification.hpp"

namespace fairway::bench {
namespace {

namespace fs = std::filesystem;

/// A slow autopilot in still air: 0.3 turning radii, two degrees, ten per cent.
VehicleContract contract_for(const Vehicle& vehicle) {
  VehicleContract contract;
  contract.command_error_m = 0.3 * vehicle.turn_radius_m;
  contract.heading_error_rad = 0.035;
  contract.turn_radius_m = {0.9 * vehicle.turn_radius_m, 1.1 * vehicle.turn_radius_m};
  contract.speed_mps = {0.9 * vehicle.speed_mps, 1.1 * vehicle.speed_mps};
  return contract;
}

/// Nanoseconds for one state and core, over random states of the grid, obstacles included.
double query_ns(const ContractCertificate& c, int repeats) {
  const Parts parts = c.parts();
  const QuickLookup lookup(parts, c.verdicts, c.least_speed_mps());
  constexpr std::size_t count = 40000;
  std::vector<double> ns;
  std::size_t reached = 0;
  for (int i = 0; i < repeats; ++i) {
    Random random(11);
    const Took took = timed([&] {
      for (std::size_t k = 0; k < count; ++k) {
        const Vec2 place{random.unit() * c.grid.nx * c.parts_per_cell,
                         random.unit() * c.grid.ny * c.parts_per_cell};
        reached += lookup.answer(place, random.uniform(-pi, pi)).verdict == Verdict::reach;
      }
    });
    ns.push_back(1e9 * took.cpu_s / static_cast<double>(count));
  }
  if (reached == 0) throw std::runtime_error("no query answers reach");
  return median(ns);
}

/// `limit_s`: for the proof and its measured shares, without a search for witnesses.
void add_case(std::vector<Row>& rows, const Settings& settings, const Case& c, double limit_s) {
  const Plan plan = plan_of(c);
  ContractVerifyOptions options;
  options.samples = std::max<std::size_t>(plan.grid.size(), 1000);
  options.find_witnesses = false;
  ContractVerification made;
  std::vector<Took> runs;
  for (int i = 0; i < settings.repeats; ++i) {
    runs.push_back(timed([&] {
      made = verify_contract(plan, c.name, {}, contract_for(plan.vehicle), options,
                             [](const std::string&) {});
    }));
  }
  const Took took = median(runs);
  const auto& all = made.survey.shares.all;
  rows.push_back(at_most_row(
      fmt::format("under a contract, {}", c.name),
      fmt::format("{}, {:.0f} % undecided or at risk, {:.0f} % reach", shown(took), 100.0 * all[0],
                  100.0 * all[static_cast<std::size_t>(Verdict::reach)]),
      took.wall_s, limit_s));
  const fs::path file =
      fs::temp_directory_path() / fmt::format("fairway-bench-{}.safetensors", ::getpid());
  write_contract_certificate(made.certificate, file, Existing::replace);
  rows.push_back(
      {"  leaves, bytes on disk", fmt::format("{}, {:.1f} MB", made.certificate.verdicts.leaves(),
                                              1e-6 * static_cast<double>(fs::file_size(file)))});
  const double ns = query_ns(made.certificate, settings.repeats);
  rows.push_back(at_least_row(
      "  queries a second and core (million)",
      fmt::format("{:.3f} million ({:.1f} us CPU each)", 1e3 / ns, 1e-3 * ns), 1e3 / ns, 1.0));
  add_check_row(rows, settings, file, took, options.samples, 1.0);
  fs::remove(file);
}

}  // namespace

std::vector<Row> contract_rows(const Settings& settings) {
  std::vector<Row> rows;
  add_case(rows, settings, open_case(), 10.0);
  if (settings.side < 1024) return rows;  // --quick
  add_case(rows, settings, obstacles_case(), 10.0);
  add_case(rows, settings, blobs_case(), 10.0);
  return rows;
}

}  // namespace fairway::bench
