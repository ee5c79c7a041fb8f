// What a proof is about, in one digest: the vehicle, the grid and its frame, the region of
// interest, and the plan's arrays. Two things belong together when their digests agree: a
// certificate and the plan next to it, an earlier certificate and the work that resumes from it.
#pragma once

#include <string>

#include "fairway/certificate/certificate.hpp"
#include "fairway/plan/plan.hpp"

namespace fairway {

/// SHA-256 in lower-case hex. A plan without a frame is placed by its own grid.
[[nodiscard]] std::string proof_identity(const Certificate& certificate);

/// The identity of a certificate for `plan`.
[[nodiscard]] std::string proof_identity(const Plan& plan, const RegionOfInterest& region);

}  // namespace fairway
