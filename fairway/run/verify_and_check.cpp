#include "fairway/run/verify_and_check.hpp"

#include <optional>
#include <stdexcept>
#include <variant>

#include "fairway/base/atomic_file.hpp"
#include "fairway/bitmap/bitmap_file.hpp"
#include "fairway/ceiling/find_ceiling.hpp"
#include "fairway/certificate/certificate_file.hpp"
#include "fairway/run/bitmap_pictures.hpp"
#include "fairway/run/bitmap_verification.hpp"
#include "fairway/run/ceiling_summary.hpp"
#include "fairway/run/checker.hpp"
#include "fairway/run/failing_flights.hpp"
#include "fairway/run/products.hpp"
#include "fairway/run/verdict_pictures.hpp"
#include "fairway/run/verification.hpp"
#include "fairway/run/verify_progress.hpp"

namespace fairway {
namespace {

namespace fs = std::filesystem;

/// The verdicts into a certificate, re-proved by the independent program.
Proved prove_and_check(const Plan& plan, const Scenario& scenario, const RegionOfInterest& region,
                       const ScenarioFlights& flown, const fs::path& place, StageClock& clock,
                       double after_s) {
  const fs::path file = place / product::certificate;
  const CertifyOptions options = certify_options(scenario.verify.limits, scenario.simulate.seed);
  Proved proved;
  proved.verification = verify_plan(plan, scenario.file.string(), region, options, std::nullopt,
                                    begin_verifying(clock, options, after_s));
  const Certificate& certificate = proved.verification.certificate;
  write_certificate(certificate, file, Existing::keep);
  proved.failing =
      failing_states(certificate, 100, options.seed, failing_starts(flown.starts, flown.results));
  write_whole(place / product::failures, Existing::keep, failing_states_csv(proved.failing));

  clock.begin("checking the certificate", unknown_time);
  const CheckRun check = run_checker({file.string(), "--quiet"}, true);
  if (check.exit_code == 1) {
    throw std::runtime_error("the certificate was refused by fairway-check: " + check.output);
  }
  proved.checked = check.exit_code == 0;
  return proved;
}

}  // namespace

Verified verify_and_check(const Plan& plan, const Scenario& scenario,
                          const RegionOfInterest& region, const ScenarioFlights& flown,
                          const fs::path& place, StageClock& clock, double after_s) {
  switch (scenario.verify.method) {
    case VerifyMethod::none:
      break;
    case VerifyMethod::certified:
      return prove_and_check(plan, scenario, region, flown, place, clock, after_s);
    case VerifyMethod::bitmap: {
      clock.begin("verifying", unknown_time);
      BitmapVerification drawn =
          draw_bitmap(plan, scenario.file.string(), region,
                      static_cast<int>(scenario.verify.border_samples), scenario.simulate.seed);
      write_bitmap(drawn.bitmap, place / product::bitmap, Existing::keep);
      return drawn;
    }
  }
  return NotVerified{};
}

std::optional<Ceiling> ceiling_asked(const Scenario& scenario, const Plan& as_asked,
                                     const Verified& verified, StageClock& clock) {
  if (!scenario.verify.ceiling || !std::holds_alternative<Proved>(verified)) return std::nullopt;
  clock.begin(ceiling_stage, unknown_time);
  return find_ceiling(as_asked.grid, as_asked.region, as_asked.vehicle,
                      ceiling_options(scenario.verify.limits));
}

Plan as_verified(const Plan& plan, const Verified& verified) {
  const auto* proved = std::get_if<Proved>(&verified);
  return proved != nullptr ? as_verified(plan, proved->verification.certificate) : plan;
}

void write_verified_pictures(const Plan& plan, const ExactFlights& flights,
                             const Verified& verified, std::uint64_t seed, const std::string& title,
                             const fs::path& place) {
  if (const auto* drawn = std::get_if<BitmapVerification>(&verified)) {
    write_bitmap_pictures(drawn->bitmap, title, place);
  } else if (const auto* proved = std::get_if<Proved>(&verified)) {
    write_verdict_pictures(plan, proved->verification.certificate,
                           all_flights(failing_flights(flights, proved->failing, 1)), seed, title,
                           place);
  }
}

}  // namespace fairway
