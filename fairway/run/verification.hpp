// plan -> verdicts -> certificate: what `fairway verify` and `fairway run` have in common.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "fairway/certificate/certificate.hpp"
#include "fairway/plan/plan.hpp"
#include "fairway/plan/plan_digests.hpp"
#include "fairway/run/resume.hpp"
#include "fairway/vehicle/vehicle.hpp"
#include "fairway/verify/certify.hpp"

namespace fairway {

/// A certificate of `plan`, and how it came about.
struct Verification {
  Certificate certificate;
  Certified outcome;               ///< but for its sections, which the certificate has
  std::optional<Resumed> resumed;  ///< when it went on from an earlier one
  CertifyOptions options = {};
};

/// Proves what flights under `plan` do. `earlier`: a certificate of the same proof
/// (proof_identity.hpp) to continue from, whose leaves are proved again before they count; throws
/// InputError{earlier->where, ...} when it is of another one. The time limit holds for both. Throws
/// InputError with the reason when the plan cannot be verified.
[[nodiscard]] Verification verify_plan(const Plan& plan, const std::string& where,
                                       const RegionOfInterest& region,
                                       const CertifyOptions& options,
                                       std::optional<EarlierProof> earlier = {},
                                       const CertifyProgress& progress = {});

}  // namespace fairway
