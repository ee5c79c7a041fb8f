// Progress reports of a proof.
#pragma once

#include <functional>
#include <string>

#include "fairway/run/stage_clock.hpp"
#include "fairway/run/verify_limits.hpp"
#include "fairway/verify/certify.hpp"

namespace fairway {

/// Begins the stage "verifying", and reports its levels with the time left; what comes after the
/// proof takes another `after_s`, seconds. `clock` must outlive it.
[[nodiscard]] CertifyProgress begin_verifying(StageClock& clock, const CertifyOptions& options,
                                              double after_s = 0.0);

/// Begins the stage "verifying under the contract", and reports what is done in it.
[[nodiscard]] std::function<void(const std::string& doing)> begin_verifying_contract(
    StageClock& clock, const VerifyLimits& limits);

}  // namespace fairway
