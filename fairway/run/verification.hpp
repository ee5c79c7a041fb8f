// plan -> verdicts -> certificate: what `fairway verify` and `fairway run` have in common.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "fairway/base/atomic_file.hpp"
#include "fairway/certificate/certificate.hpp"
#include "fairway/plan/plan.hpp"
#include "fairway/run/stage_clock.hpp"
#include "fairway/vehicle/vehicle.hpp"
#include "fairway/verify/certify.hpp"

namespace fairway {

/// A certificate of `plan`, and how it came about.
struct Verification {
  Certificate certificate;
  Certified outcome;
  nlohmann::json summary;  ///< docs/formats.md, summary.json of verify; without times
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
                                       std::optional<EarlierProof> earlier, StageClock& clock);

/// What was proved and what was assumed, in one paragraph.
[[nodiscard]] std::string verification_words(const Verification& verification);

/// A state whose verdict is not `reach`.
struct FailingState {
  State start;
  Verdict verdict = Verdict::undecided;
};

/// At most so many of each verdict, sampled, in the order collide, leave, trapped, undecided.
[[nodiscard]] std::vector<FailingState> failing_states(const Certificate& certificate,
                                                       std::size_t of_each, std::uint64_t seed);

/// The same for `fairway simulate --states`: CSV x_m,y_m,heading_rad,verdict.
[[nodiscard]] std::string failing_states_csv(const std::vector<FailingState>& states);

/// The paper's method into a file: the bits of border samples from which the region is reached.
[[nodiscard]] nlohmann::json write_bitmap(const Plan& plan, const RegionOfInterest& region,
                                          int samples, std::uint64_t seed,
                                          const std::filesystem::path& file, Existing existing);

}  // namespace fairway
