// States inside cells, answered by a border bitmap: fly (exactly) to the border and read the bit
// there (paper 2, section V.B), and how much of the configuration volume reaches.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "fairway/bitmap/bitmap_samples.hpp"
#include "fairway/bitmap/border_bitmap.hpp"
#include "fairway/plan/plan.hpp"
#include "fairway/vehicle/cell_motion.hpp"

namespace fairway {

/// Keeps references to all three; they must outlive it.
class BitmapLookup {
 public:
  /// Throws PreconditionViolation when the three do not fit together.
  BitmapLookup(const Plan& plan, const std::vector<std::uint8_t>& target_cells,
               const BorderBitmap& set);

  /// Whether a state reaches the region, as the bitmap has it: evidence, not proof. `position_m`
  /// is within the closed grid, or the answer is false. A state on a border is looked at in the
  /// cell above and to the right of it.
  [[nodiscard]] bool reaches(const State& state) const;

 private:
  const Plan& plan_;
  const std::vector<std::uint8_t>& target_cells_;
  const BorderBitmap& set_;
  BitmapSamples samples_;
};

struct VolumeShare {
  double reached = 0.0;         ///< of the volume of all cells that are neither region nor obstacle
  double standard_error = 0.0;  ///< of sampling
  std::size_t draws = 0;
};

/// By `draws` random states, seeded; the same for any number of threads. 0 when there is no such
/// cell.
[[nodiscard]] VolumeShare volume_share_reached(const Plan& plan,
                                               const std::vector<std::uint8_t>& target_cells,
                                               const BorderBitmap& set, std::size_t draws,
                                               std::uint64_t seed = 1);

}  // namespace fairway
