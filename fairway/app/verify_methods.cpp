#include "fairway/app/verify_methods.hpp"

#include <optional>
#include <utility>

#include "fairway/bitmap/bitmap_file.hpp"
#include "fairway/ceiling/find_ceiling.hpp"
#include "fairway/certificate/certificate_file.hpp"
#include "fairway/run/bitmap_pictures.hpp"
#include "fairway/run/bitmap_verification.hpp"
#include "fairway/run/failing_flights.hpp"
#include "fairway/run/failing_states.hpp"
#include "fairway/run/summary.hpp"
#include "fairway/run/verdict_pictures.hpp"
#include "fairway/run/verification.hpp"
#include "fairway/run/verification_summary.hpp"
#include "fairway/run/verify_progress.hpp"
#include "fairway/simulate/exact_flight.hpp"

namespace fairway {
namespace {

void write_failures(const VerifyTask& task, const Certificate& certificate) {
  const VerifyArguments& a = task.arguments;
  if (a.failures.empty() && task.pictures == nullptr) return;
  const std::vector<FailingState> failing = failing_states(certificate, 100, a.seed);
  if (!a.failures.empty()) {
    write_whole(a.failures, task.session.existing(), failing_states_csv(failing));
  }
  if (task.pictures == nullptr) return;
  task.clock.begin("drawing", unknown_time);
  const Plan flown = as_verified(task.plan, certificate);
  write_verdict_pictures(flown, certificate,
                         all_flights(failing_flights(ExactFlights(flown), failing, 1)), a.seed,
                         a.plan.stem().string(), task.pictures->temporary_path());
  task.pictures->commit();
}

}  // namespace

void add_ceiling(const VerifyTask& task, const std::vector<CellKind>& kind,
                 const ProvedShare& proved, VerifyOutcome& outcome) {
  if (!task.arguments.ceiling) return;
  task.clock.begin(ceiling_stage, unknown_time);
  const Plan asked = as_verified(task.plan, kind);
  const Ceiling ceiling =
      find_ceiling(asked.grid, asked.region, asked.vehicle, ceiling_options(task.arguments.limits));
  task.clock.end();
  add_ceiling(outcome.summary, outcome.findings, ceiling, proved);
  if (auto warning = limit_warning(ceiling)) outcome.warnings.push_back(std::move(*warning));
}

VerifyOutcome verify_exactly(const VerifyTask& task) {
  const VerifyArguments& a = task.arguments;
  std::optional<EarlierProof> earlier;
  if (!a.resume.empty()) earlier = EarlierProof{read_certificate(a.resume), a.resume.string()};
  const CertifyOptions options = certify_options(a.limits, a.seed, a.volume_samples);
  const Verification made = verify_plan(task.plan, a.plan.string(), task.region, options,
                                        std::move(earlier), begin_verifying(task.clock, options));
  task.clock.begin("writing the certificate", unknown_time);
  write_certificate(made.certificate, a.output, task.session.existing());
  write_failures(task, made.certificate);
  task.clock.end();
  VerifyOutcome outcome{
      verification_json(made), findings(task.plan, made), {}, proof_notes(made) + "\n"};
  if (made.resumed) {
    outcome.summary["resumed"] = resumed_json(*made.resumed);
    outcome.notes += resumed_words(*made.resumed) + "\n";
  }
  if (auto warning = limit_warning(made)) outcome.warnings.push_back(std::move(*warning));
  add_ceiling(task, made.certificate.kind, proved_share(task.plan, made), outcome);
  return outcome;
}

VerifyOutcome verify_by_bitmap(const VerifyTask& task) {
  const VerifyArguments& a = task.arguments;
  task.clock.begin("verifying", unknown_time);
  const BitmapVerification made =
      draw_bitmap(task.plan, a.plan.string(), task.region, a.samples_per_border, a.seed);
  task.clock.begin("writing the bitmap", unknown_time);
  write_bitmap(made.bitmap, a.output, task.session.existing());
  if (task.pictures != nullptr) {
    task.clock.begin("drawing", unknown_time);
    write_bitmap_pictures(made.bitmap, a.plan.stem().string(), task.pictures->temporary_path());
    task.pictures->commit();
  }
  task.clock.end();
  return {verification_json(made), findings(task.plan, made), {}, {}};
}

}  // namespace fairway
