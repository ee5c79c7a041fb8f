#include "fairway/tune/sharp_proof.hpp"

#include <stdexcept>

#include "fairway/base/atomic_file.hpp"
#include "fairway/certificate/certificate_file.hpp"
#include "fairway/certificate/contract_certificate_file.hpp"
#include "fairway/run/checker.hpp"
#include "fairway/run/products.hpp"
#include "fairway/run/region_request.hpp"
#include "fairway/run/verification_summary.hpp"

namespace fairway {

namespace {

constexpr auto reach = static_cast<std::size_t>(Verdict::reach);

}  // namespace

double SharpProof::share() const {
  if (exact) return exact->outcome.volume.all[reach];
  return under_contract->no_tube ? 0.0 : under_contract->survey.shares.all[reach];
}

double SharpProof::safe_share() const {
  if (exact) return exact->outcome.volume.free[reach];
  return under_contract->no_tube ? 0.0 : under_contract->survey.shares.free[reach];
}

nlohmann::json SharpProof::json() const {
  return exact ? verification_json(*exact)
               : contract_verification_json(under_contract->certificate);
}

bool SharpProof::write_and_check(const std::filesystem::path& folder) const {
  const std::filesystem::path file =
      folder / (exact ? product::certificate : product::contract_certificate);
  if (exact) {
    write_certificate(exact->certificate, file, Existing::keep);
  } else {
    write_contract_certificate(under_contract->certificate, file, Existing::keep);
  }
  const CheckRun check = run_checker({file.string(), "--quiet"}, true);
  if (check.exit_code == 1) {
    throw std::runtime_error("the certificate was refused by fairway-check: " + check.output);
  }
  return check.exit_code == 0;
}

SharpProof prove_sharply(const Plan& plan, const Scenario& scenario) {
  SharpProof made;
  const RegionOfInterest region = region_on_plan({}, plan);
  const std::string where = scenario.file.string();
  if (const auto contract = contract_to_prove(plan, region)) {
    ContractVerifyOptions options;
    options.limits = scenario.verify.limits;
    options.seed = scenario.simulate.seed;
    options.find_witnesses = false;
    made.under_contract =
        verify_contract(plan, where, region, *contract, options, [](const std::string&) {});
  } else {
    made.exact = verify_plan(plan, where, region,
                             certify_options(scenario.verify.limits, scenario.simulate.seed));
  }
  return made;
}

}  // namespace fairway
