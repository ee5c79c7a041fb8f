// Shares of the configuration volume by verdict, measured by proved queries of sampled states.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "fairway/verify/certify.hpp"
#include "fairway/verify/images.hpp"
#include "fairway/verify/prover.hpp"

namespace fairway {

/// Begins with the plan's first mode. Keeps references to `flow` and `is_free`.
class VolumeMeter {
 public:
  /// `has_modes`: begin_mode will be called, for which the states are kept.
  VolumeMeter(const Flow& flow, const std::vector<bool>& is_free, const CertifyOptions& options,
              bool has_modes);

  /// Queries the states again that were not decided before.
  VolumeFractions measure(const Prover& prover);

  /// From now on, measures what a further mode adds: of the states that no mode before is proved to
  /// bring. The others keep their verdict.
  void begin_mode(const Flow& flow);

  VolumeFractions fractions() const;
  std::size_t bytes() const {
    return images_.bytes() + found_.size() * 21 + states_.size() * sizeof(Place);
  }

 private:
  const Flow& flow_;
  const std::vector<bool>& is_free_;
  int most_crossings_;
  std::vector<Place> states_;         // if they are kept
  std::vector<std::uint32_t> asked_;  // numbers of states, those of the images
  ImageStore images_;
  std::vector<VerdictSet> found_;   // [states]
  std::vector<std::uint8_t> mode_;  // [states], the one that decides
  std::uint8_t now_ = 0;            // mode
};

}  // namespace fairway
