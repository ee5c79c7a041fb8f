#include "fairway/compare/read_compared_plan.hpp"

#include <algorithm>
#include <optional>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "fairway/base/error.hpp"
#include "fairway/certificate/certificate_file.hpp"
#include "fairway/certificate/contract_certificate_file.hpp"
#include "fairway/certificate/proof_identity.hpp"
#include "fairway/plan/plan_digests.hpp"
#include "fairway/plan/plan_file.hpp"
#include "fairway/run/contract_verification.hpp"
#include "fairway/run/contract_warning.hpp"
#include "fairway/run/path_follower.hpp"
#include "fairway/run/product_file.hpp"
#include "fairway/run/products.hpp"
#include "fairway/run/run.hpp"
#include "fairway/run/scenario.hpp"
#include "fairway/run/verification.hpp"
#include "fairway/run/verification_summary.hpp"
#include "fairway/run/verify_limits.hpp"
#include "fairway/run/verify_progress.hpp"

namespace fairway {
namespace {

namespace fs = std::filesystem;

const RegionOfInterest the_goal{};

Plan plan_of_scenario(const fs::path& file, StageClock& clock) {
  const Scenario scenario = read_scenario(file);
  auto answer = plan_scenario(scenario, clock);
  if (const auto* refusal = std::get_if<MissionRefusal>(&answer)) {
    throw InputError(file.string(), "has no plan to compare: " + refusal->message);
  }
  return std::move(std::get<Planned>(answer).plan);
}

/// The plan's file; empty for a scenario.
fs::path plan_file_of(const fs::path& from) {
  std::error_code error;
  if (fs::is_directory(from, error)) {
    if (fs::exists(from / product::plan, error)) return from / product::plan;
    throw InputError(from.string(),
                     fmt::format("is a folder without {}, expected that of a run", product::plan));
  }
  if (!fs::exists(from, error)) {
    throw InputError(from.string(),
                     "does not exist, expected a run's folder, a plan or a scenario");
  }
  return from.extension() == ".toml" ? fs::path{} : from;
}

std::vector<fs::path> certificates_beside(const fs::path& plan) {
  const fs::path folder = plan.parent_path();
  std::vector<fs::path> found;
  for (const fs::path& name :
       {fs::path(product::certificate), fs::path(product::contract_certificate),
        fs::path(plan.stem().string() + ".certificate.safetensors")}) {
    std::error_code error;
    if (fs::is_regular_file(folder / name, error)) found.push_back(folder / name);
  }
  return found;
}

bool is_of(const ContractCertificate& c, const Plan& plan, const VehicleContract& contract) {
  return c.plan == plan_digests(plan) && c.grid == plan.grid && c.vehicle == plan.vehicle &&
         c.region_of_interest == the_goal && c.contract == contract && c.frame == plan.record.frame;
}

/// Takes over the certificates beside the plan that are of it.
void look_beside(const fs::path& file, const std::optional<VehicleContract>& contract,
                 ComparedPlan& found) {
  for (const fs::path& beside : certificates_beside(file)) {
    bool fits = false;
    if (product_kind(beside) == ProductKind::certificate) {
      Certificate c = read_certificate(beside);
      fits = proof_identity(c) == proof_identity(found.plan, the_goal);
      if (fits) found.certificate = std::move(c);
    } else if (product_kind(beside) == ProductKind::contract_certificate) {
      ContractCertificate c = read_contract_certificate(beside);
      fits = contract && is_of(c, found.plan, *contract);
      if (fits) found.contract = std::move(c);
    }
    if (fits) {
      found.proofs.push_back(beside.string() + ", as it was found.");
    } else {
      found.warnings.push_back(
          fmt::format("{} is not about this plan, its mission and its contract, and is not used.",
                      beside.string()));
    }
  }
}

void prove_exactly(const ProveComparedOptions& options, StageClock& clock, ComparedPlan& found) {
  VerifyLimits limits;
  limits.time_limit_s = options.time_limit_s;
  const CertifyOptions certify = certify_options(limits, options.seed);
  Verification made = verify_plan(found.plan, found.from.string(), the_goal, certify, {},
                                  begin_verifying(clock, certify));
  found.proofs.push_back(
      fmt::format("Proved for this comparison, in at most {:g} s.", options.time_limit_s));
  if (auto warning = limit_warning(made)) found.warnings.push_back(std::move(*warning));
  found.certificate = std::move(made.certificate);
}

void prove_contract(const VehicleContract& contract, const ProveComparedOptions& options,
                    StageClock& clock, ComparedPlan& found) {
  if (is_wild_everywhere(found.plan, contract)) {
    found.warnings.push_back(
        "Nothing was proved under the contract: it is too wide for this plan at every cell.");
    return;
  }
  ContractVerifyOptions verify;
  verify.limits.time_limit_s = options.time_limit_s;
  verify.seed = options.seed;
  verify.samples = 1000;  // states are sampled again, by the comparison
  verify.or_touch = found.plan.record.contract.has_value();
  verify.find_witnesses = false;
  ContractVerification made =
      verify_contract(found.plan, found.from.string(), the_goal, contract, verify,
                      begin_verifying_contract(clock, verify.limits));
  if (made.no_tube && !verify.or_touch) {
    found.warnings.push_back("Nobody is proved to follow the path: " + no_tube_finding().what +
                             ".");
    return;
  }
  found.proofs.push_back(fmt::format(
      "Proved under the contract for this comparison, in at most {:g} s.", options.time_limit_s));
  if (auto warning = limit_warning(made)) found.warnings.push_back(std::move(*warning));
  found.contract = std::move(made.certificate);
}

}  // namespace

ComparedPlan read_compared_plan(const fs::path& from, StageClock& clock) {
  ComparedPlan found;
  found.from = from;
  const fs::path file = plan_file_of(from);
  clock.begin("reading " + from.string(), unknown_time);
  found.plan = file.empty() ? plan_of_scenario(from, clock) : read_plan(file);
  return found;
}

void prove_compared_plan(const ProveComparedOptions& options, StageClock& clock,
                         ComparedPlan& plan) {
  const fs::path file = plan_file_of(plan.from);
  const std::optional<VehicleContract> contract = contract_to_prove(plan.plan, the_goal);
  if (!file.empty()) look_beside(file, contract, plan);
  if (!plan.certificate) prove_exactly(options, clock, plan);
  if (contract && !plan.contract) prove_contract(*contract, options, clock, plan);
}

void name_apart(std::vector<ComparedPlan>& plans) {
  const auto short_name = [](const fs::path& from) {
    const fs::path whole = from.lexically_normal();
    const fs::path last = whole.has_filename() ? whole : whole.parent_path();
    // A run's plan is told by its folder.
    if (last.filename() == product::plan && last.has_parent_path()) {
      return last.parent_path().filename().string();
    }
    return fs::is_directory(last) ? last.filename().string() : last.stem().string();
  };
  const auto is_taken = [&](std::size_t i, const std::string& name) {
    return std::count_if(plans.begin(), plans.end(), [&](const ComparedPlan& other) {
             return &other != &plans[i] && short_name(other.from) == name;
           }) > 0;
  };
  for (std::size_t i = 0; i < plans.size(); ++i) {
    const std::string name = short_name(plans[i].from);
    plans[i].name = name.empty() || is_taken(i, name) ? plans[i].from.string() : name;
  }
  for (std::size_t i = 0; i < plans.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (plans[i].name == plans[j].name) plans[i].name += fmt::format(" ({})", i + 1);
    }
  }
}

}  // namespace fairway
