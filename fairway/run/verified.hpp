// What a run knows of all states: a proof, or the paper's estimate.
#pragma once

#include <variant>
#include <vector>

#include "fairway/run/failing_states.hpp"
#include "fairway/run/verification.hpp"

namespace fairway {

/// A proof, and whether another program made it again.
struct Proved {
  Verification verification;
  std::vector<FailingState> failing;
  bool checked = false;
};

/// The paper's method, which proves nothing, or a proof.
using Verified = std::variant<BitmapVerification, Proved>;

}  // namespace fairway
