// plan -> bitmap: paper 2's method, an estimate and a picture, not a proof.
#pragma once

#include <cstdint>
#include <string>

#include <nlohmann/json.hpp>

#include "fairway/bitmap/bitmap.hpp"
#include "fairway/plan/plan.hpp"
#include "fairway/verify/region_of_interest.hpp"

namespace fairway {

/// Default number of samples per border and its limits; must be a multiple of four.
inline constexpr int usual_border_samples = 200;
inline constexpr int least_border_samples = 4;
inline constexpr int most_border_samples = 4000;

struct BitmapVerification {
  Bitmap bitmap;
  double estimated_reach = 0.0;  ///< share of all states outside obstacles and target, by samples
  double standard_error = 0.0;   ///< of drawing these states alone
};

/// `seed`: of the states that measure estimated_reach. Throws InputError{where, ...} when the
/// plan's cells are not smaller than the turning radius.
[[nodiscard]] BitmapVerification draw_bitmap(const Plan& plan, const std::string& where,
                                             const RegionOfInterest& region, int samples_per_border,
                                             std::uint64_t seed);

/// docs/formats.md, summary.json of verify; without times.
[[nodiscard]] nlohmann::json verification_json(const BitmapVerification& verification);

/// The estimated share, with as many digits as its standard error justifies.
[[nodiscard]] std::string estimated_reach_text(const BitmapVerification& verification);

/// What was sampled and how far it can be trusted, in one paragraph.
[[nodiscard]] std::string verification_words(const BitmapVerification& verification);

}  // namespace fairway
