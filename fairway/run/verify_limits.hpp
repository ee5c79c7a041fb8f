// How far a proof is to go, as scenarios, the command and Python ask for it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "fairway/verify/certify.hpp"

namespace fairway {

struct VerifyLimits {
  double undecided_max = CertifyOptions{}.undecided_max;  ///< stop at this share of the volume
  double time_limit_s = CertifyOptions{}.time_limit_s;    ///< 0: none
  std::optional<double> memory_limit_mb;
};

/// Of `fairway run`, unless its scenario says otherwise: a run ends soon enough, on any map.
inline constexpr VerifyLimits limits_of_a_run{.time_limit_s = 120.0, .memory_limit_mb = {}};

[[nodiscard]] inline CertifyOptions certify_options(
    const VerifyLimits& limits, std::uint64_t seed,
    std::size_t samples = CertifyOptions{}.samples) {
  CertifyOptions options;
  options.undecided_max = limits.undecided_max;
  options.time_limit_s = limits.time_limit_s;
  options.memory_limit_bytes = static_cast<std::size_t>(limits.memory_limit_mb.value_or(0.0) * 1e6);
  options.seed = seed;
  options.samples = samples;
  return options;
}

}  // namespace fairway
