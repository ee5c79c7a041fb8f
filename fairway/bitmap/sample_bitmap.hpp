// Bitmap -> its answers for many states: rows of states, every cell at one heading, a map of all.
//
// Properties that always hold: those of bitmap_lookup.hpp and reachability_map.hpp; the answers
// depend only on the arguments, not on threads. Cost: about a tenth of a microsecond a state.
#pragma once

#include <span>
#include <vector>

#include "fairway/base/heading.hpp"
#include "fairway/bitmap/bitmap.hpp"
#include "fairway/bitmap/reachability_map.hpp"
#include "fairway/bitmap/sampled.hpp"
#include "fairway/vehicle/vehicle.hpp"

namespace fairway {

/// Answer [i] belongs to state [i].
[[nodiscard]] std::vector<Sampled> sampled_answers(const Bitmap& bitmap,
                                                   std::span<const State> states);

struct ReachabilityMapOptions {
  int headings = 8;              ///< slices, evenly spaced, the first (all but) east; at least 1
  int headings_per_sample = 72;  ///< behind the shares, 0 to 65535
  int most_across = 256;         ///< samples along the longer side, at least 1
};

/// Throws PreconditionViolation when an option is out of range.
[[nodiscard]] ReachabilityMap reachability_map_of(const Bitmap& bitmap,
                                                  const ReachabilityMapOptions& options);

}  // namespace fairway
