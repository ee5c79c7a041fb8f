// Proves the further modes of a plan, in order: each may hand over to those before it
// (hand_over.hpp).
#pragma once

#include <functional>
#include <span>

#include "fairway/verify/certify.hpp"
#include "fairway/verify/volume_meter.hpp"

namespace fairway {

/// Adds to `answer`, which has the first mode's sections, those of the further modes and the
/// volumes with them. Where a limit stops the work, `stopped_by` says so, and nothing is claimed of
/// the modes that were not begun.
void prove_modes(const Flow& flow, std::span<const float* const> further_rad,
                 const CertifyOptions& options, const std::function<bool()>& go_on,
                 VolumeMeter& meter, Certified& answer);

}  // namespace fairway
