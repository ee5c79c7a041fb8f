// plan -> verdicts -> certificate: what `fairway verify` and `fairway run` have in common.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "fairway/base/atomic_file.hpp"
#include "fairway/certificate/certificate.hpp"
#include "fairway/plan/plan.hpp"
#include "fairway/plan/plan_digests.hpp"
#include "fairway/vehicle/vehicle.hpp"
#include "fairway/verify/certify.hpp"

namespace fairway {

/// A certificate of `plan`, and how it came about.
struct Verification {
  Certificate certificate;
  Certified outcome;  ///< but for its sections, which the certificate has
  CertifyOptions options = {};
};

/// A certificate to go on from; `where` names it in errors.
struct EarlierProof {
  Certificate certificate;
  std::string where;
};

/// Proves what flights under `plan` do. `earlier`: a certificate of the same proof
/// (proof_identity.hpp) to go on from, whose leaves are proved again before they count; throws
/// InputError{earlier->where, ...} when it is of another one. Throws InputError when the plan
/// cannot be verified, in words.
[[nodiscard]] Verification verify_plan(const Plan& plan, const std::string& where,
                                       const RegionOfInterest& region,
                                       const CertifyOptions& options,
                                       std::optional<EarlierProof> earlier = {},
                                       const CertifyProgress& progress = {});

/// What the paper's method finds: an estimate, no proof.
struct BitmapVerification {
  Grid grid;
  PlanDigests plan;
  int samples_per_border = 0;
  std::uint64_t seed = 1;  ///< of the states behind estimated_reach
  std::size_t border_states = 0;
  double share_of_border_states = 0.0;  ///< that reach the region
  std::size_t stored_bytes = 0;
  double estimated_reach = 0.0;  ///< share of all states, by samples
  double standard_error = 0.0;   ///< of estimated_reach
};

/// The paper's method into a file: the bits of border samples from which the region is reached.
[[nodiscard]] BitmapVerification write_bitmap(const Plan& plan, const RegionOfInterest& region,
                                              int samples_per_border, std::uint64_t seed,
                                              const std::filesystem::path& file, Existing existing);

}  // namespace fairway
