// What a run knows of all states: a proof, the paper's estimate, or nothing.
#pragma once

#include <variant>
#include <vector>

#include "fairway/run/bitmap_verification.hpp"
#include "fairway/run/failing_states.hpp"
#include "fairway/run/verification.hpp"

namespace fairway {

/// A proof, and whether another program made it again.
struct Proved {
  Verification verification;
  std::vector<FailingState> failing;
  bool checked = false;
};

struct NotVerified {};

/// Nothing, the paper's method, which proves nothing, or a proof.
using Verified = std::variant<NotVerified, BitmapVerification, Proved>;

}  // namespace fairway
