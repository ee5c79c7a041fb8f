#include <optional>
#include <string>
#include <utility>

#include "fairway/app/verify_methods.hpp"
#include "fairway/base/error.hpp"
#include "fairway/base/file_kind.hpp"
#include "fairway/base/mapped_file.hpp"
#include "fairway/certificate/contract_certificate_file.hpp"
#include "fairway/run/contract_asked.hpp"
#include "fairway/run/contract_failure_pictures.hpp"
#include "fairway/run/contract_failures.hpp"
#include "fairway/run/contract_file.hpp"
#include "fairway/run/contract_verification.hpp"
#include "fairway/run/contract_warning.hpp"
#include "fairway/run/verdict_pictures.hpp"
#include "fairway/run/verify_progress.hpp"

namespace fairway {
namespace {

bool is_kind(const std::filesystem::path& file, FileKind kind) {
  const MappedFile mapped(file);
  return kind_of_bytes(mapped.bytes()) == kind;
}

ContractVerifyOptions options_of(const VerifyArguments& a) {
  ContractVerifyOptions options;
  options.parts_per_cell = a.parts_per_cell;
  options.limits = a.limits;
  if (a.volume_samples != CertifyOptions{}.samples) options.samples = a.volume_samples;
  options.seed = a.seed;
  return options;
}

void write_failures(const VerifyTask& task, const ContractCertificate& certificate) {
  const VerifyArguments& a = task.arguments;
  if (a.failures.empty() && task.pictures == nullptr) return;
  task.clock.begin("searching for failures", unknown_time);
  const std::vector<ContractFailure> failures = contract_failures(certificate, 100, a.seed);
  if (!a.failures.empty()) {
    write_whole(a.failures, task.session.existing(), contract_failures_csv(failures));
  }
  if (task.pictures == nullptr) return;
  task.clock.begin("drawing", unknown_time);
  const Plan flown = as_verified(task.plan, certificate.kind);
  write_contract_verdict_pictures(flown, certificate, failing_flights(certificate, flown, failures),
                                  a.seed, a.plan.stem().string(), task.pictures->temporary_path());
  task.pictures->commit();
}

}  // namespace

std::optional<ContractAsked> contract_asked(const VerifyTask& task) {
  const VerifyArguments& a = task.arguments;
  ContractAsked asked;
  if (!a.resume.empty() && is_kind(a.resume, FileKind::contract_certificate)) {
    if (a.method == "certified") {
      throw InputError(a.resume.string(),
                       "is a contract certificate: to continue it, leave out --method certified");
    }
    asked.earlier = EarlierContractProof{read_contract_certificate(a.resume), a.resume.string()};
  }
  ProofRequest request{a.method, {}, !a.resume.empty(), asked.earlier ? &*asked.earlier : nullptr};
  if (!a.contract.empty()) request.contract = read_contract(a.contract, task.plan.vehicle);
  const auto contract = fairway::contract_asked(task.plan, a.plan.string(), task.region, request);
  if (!contract) return std::nullopt;
  asked.contract = *contract;
  if (a.resume.empty() || asked.earlier) return asked;
  if (is_kind(a.resume, FileKind::certificate)) {
    throw InputError(a.resume.string(),
                     "is a certificate of the exact vehicle, which no proof under a contract "
                     "can continue: add --method certified to continue it");
  }
  asked.earlier = EarlierContractProof{read_contract_certificate(a.resume), a.resume.string()};
  return asked;
}

VerifyOutcome verify_under_contract(const VerifyTask& task, const ContractAsked& asked) {
  const VerifyArguments& a = task.arguments;
  const ContractVerification made = verify_asked(
      task.plan, a.plan.string(), task.region, asked.contract, options_of(a),
      begin_verifying_contract(task.clock, a.limits), asked.earlier ? &*asked.earlier : nullptr);
  if (is_for_exact_verdicts(made)) {
    VerifyOutcome outcome = verify_exactly(task);
    outcome.findings.insert(outcome.findings.begin(), no_tube_finding());
    return outcome;
  }
  task.clock.begin("writing the certificate", unknown_time);
  write_contract_certificate(made.certificate, a.output, task.session.existing());
  write_failures(task, made.certificate);
  task.clock.end();
  VerifyOutcome outcome{contract_verification_json(made.certificate),
                        findings(task.plan, made),
                        {},
                        contract_notes(made) + "\n"};
  if (made.resumed) {
    outcome.summary["resumed"] = resumed_json(*made.resumed);
    outcome.notes += resumed_words(*made.resumed) + "\n";
  }
  if (auto wide = contract_warning(task.plan, asked.contract)) {
    outcome.warnings.push_back(std::move(*wide));
  }
  if (auto limit = limit_warning(made)) outcome.warnings.push_back(std::move(*limit));
  if (const auto proved = proved_share(task.plan, made)) {
    add_ceiling(task, made.certificate.kind, *proved, outcome);
  } else if (a.ceiling) {
    outcome.warnings.emplace_back(no_ceiling_of_following);
  }
  return outcome;
}

}  // namespace fairway
