// Proved verdicts: how much is left undecided after how long, how long a query of a mapped file
// takes, and how long the independent checker takes compared with the prover.
#include <fmt/core.h>
#include <unistd.h>

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench/proof_cases.hpp"
#include "bench/sections.hpp"
#include "fairway/base/mapped_file.hpp"
#include "fairway/base/random.hpp"
#include "fairway/certificate/certificate_file.hpp"
#include "fairway/run/verification.hpp"
#include "fairway/runtime.hpp"

namespace fairway::bench {
namespace {

namespace fs = std::filesystem;

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
  add_check_row(rows, settings, file, proved.took, 20'000, 3.0);
  fs::remove(file);
}

}  // namespace

std::vector<Row> certified_rows(const Settings& settings) {
  std::vector<Row> rows;
  const Case open = open_case();
  add_case(rows, settings, open, 0.005, 20.0);
  add_case(rows, settings, open, 0.002, 60.0);
  if (settings.side < 1024) return rows;  // --quick
  add_case(rows, settings, obstacles_case(), 0.01, 180.0);
  add_case(rows, settings, blobs_case(), 0.01, 300.0);
  return rows;
}

}  // namespace fairway::bench
