// What a proof is a proof of, in one digest: the vehicle, the grid and its frame, the region of
// interest, and the plan's arrays. Two proofs go together when theirs are the same: a certificate
// and the plan beside it, an earlier certificate and the work that goes on from it.
#pragma once

#include <string>

#include "fairway/certificate/certificate.hpp"
#include "fairway/plan/plan.hpp"

namespace fairway {

/// SHA-256 in lower-case hex. A plan without a frame lies where its own grid does.
[[nodiscard]] std::string proof_identity(const Certificate& certificate);

/// That of a certificate of `plan`.
[[nodiscard]] std::string proof_identity(const Plan& plan, const RegionOfInterest& region);

}  // namespace fairway
