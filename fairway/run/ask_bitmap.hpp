// Looks up every cell of a bitmap for some headings.
#pragma once

#include <span>
#include <vector>

#include "fairway/base/heading.hpp"
#include "fairway/bitmap/bitmap.hpp"
#include "fairway/bitmap/sampled.hpp"
#include "fairway/exchange/plan_rasters.hpp"

namespace fairway {

/// [iy][ix]: of the vehicle near each cell's middle with (nearly) this heading, in the same states
/// that verdicts_at() asks a certificate for. In an obstacle: other; in the region: reach.
[[nodiscard]] std::vector<Sampled> sampled_at(const Bitmap& bitmap, Heading heading);

/// sampled_at() each of the headings.
[[nodiscard]] std::vector<SampledLayer> sampled_layers(const Bitmap& bitmap,
                                                       std::span<const Heading> headings);

}  // namespace fairway
