#include <optional>
#include <string>
#include <utility>

#include "fairway/app/verify_methods.hpp"
#include "fairway/base/error.hpp"
#include "fairway/base/file_kind.hpp"
#include "fairway/base/mapped_file.hpp"
#include "fairway/certificate/contract_certificate_file.hpp"
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
  const Plan& plan = task.plan;
  if (!a.method.empty() && a.method != "contract") {
    if (a.method == "certified" && !a.resume.empty() &&
        is_kind(a.resume, FileKind::contract_certificate)) {
      throw InputError(a.resume.string(),
                       "is a contract certificate: to continue it, leave out --method certified");
    }
    return std::nullopt;
  }
  std::optional<EarlierContractProof> earlier;
  if (!a.resume.empty() && is_kind(a.resume, FileKind::contract_certificate)) {
    earlier = EarlierContractProof{read_contract_certificate(a.resume), a.resume.string()};
  }
  // Without a method asked for, a path is followed, by the exact vehicle if there is no contract.
  std::optional<VehicleContract> contract = a.method.empty() && a.resume.empty()
                                                ? contract_to_prove(plan, task.region)
                                                : plan.record.contract;
  if (!a.contract.empty()) contract = read_contract(a.contract, plan.vehicle);
  if (!contract && earlier) contract = earlier->certificate.contract;
  if (!contract && a.method == "contract") {
    throw InputError(a.plan.string(),
                     "carries no contract: name one with --contract FILE.toml, or plan from a "
                     "scenario with [vehicle.contract]");
  }
  if (!contract) return std::nullopt;
  if (!a.resume.empty() && !earlier) {
    if (is_kind(a.resume, FileKind::certificate)) {
      throw InputError(a.resume.string(),
                       "is a certificate of the exact vehicle, which no proof under a contract "
                       "can continue: add --method certified to continue it");
    }
    earlier = EarlierContractProof{read_contract_certificate(a.resume), a.resume.string()};
  }
  return ContractAsked{*contract, std::move(earlier)};
}

VerifyOutcome verify_under_contract(const VerifyTask& task, const ContractAsked& asked) {
  const VerifyArguments& a = task.arguments;
  std::optional<std::string> warning = contract_warning(task.plan, asked.contract);
  if (warning && is_wild_everywhere(task.plan, asked.contract)) {
    throw InputError(a.plan.string(), "nothing was proved: " + *warning);
  }
  ContractVerifyOptions options = options_of(a);
  options.or_touch = asked.contract != nearly_exact(task.plan.vehicle);
  const ContractVerification made = verify_contract(
      task.plan, a.plan.string(), task.region, asked.contract, options,
      begin_verifying_contract(task.clock, a.limits), asked.earlier ? &*asked.earlier : nullptr);
  if (made.no_tube && !options.or_touch) {  // what the exact prover can say
    VerifyOutcome outcome = verify_exactly(task);
    outcome.findings.insert(outcome.findings.begin(), no_tube_finding());
    return outcome;
  }
  task.clock.begin("writing the certificate", unknown_time);
  write_contract_certificate(made.certificate, a.output, task.session.existing());
  write_failures(task, made.certificate);
  task.clock.end();
  VerifyOutcome outcome{
      contract_verification_json(made), findings(task.plan, made), {}, contract_notes(made) + "\n"};
  if (made.resumed) {
    outcome.summary["resumed"] = resumed_json(*made.resumed);
    outcome.notes += resumed_words(*made.resumed) + "\n";
  }
  if (warning) outcome.warnings.push_back(std::move(*warning));
  if (auto limit = limit_warning(made)) outcome.warnings.push_back(std::move(*limit));
  return outcome;
}

}  // namespace fairway
