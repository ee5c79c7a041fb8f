// States inside cells, answered by a border bitmap: fly exactly to the first border and look at the
// samples there (paper 2, section V.B). Evidence, never a proof.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "fairway/bitmap/bitmap.hpp"
#include "fairway/bitmap/bitmap_samples.hpp"
#include "fairway/bitmap/border_bitmap.hpp"
#include "fairway/bitmap/sampled.hpp"
#include "fairway/plan/plan.hpp"
#include "fairway/vehicle/vehicle.hpp"

namespace fairway {

/// Keeps references to its arguments, which must outlive it.
class BitmapLookup {
 public:
  /// Throws PreconditionViolation when the parts do not fit together.
  explicit BitmapLookup(const Bitmap& bitmap);
  /// `target_cells` is [iy][ix], not 0 for the region; it is copied.
  BitmapLookup(const Plan& plan, const std::vector<std::uint8_t>& target_cells,
               const BorderBitmap& set);

  /// What the samples say about a state: the one whose square of place and heading contains the
  /// state in which its flight first meets a border, and the (up to) eight squares around it on
  /// that border. All must agree; else `undecided`. In the region: reach. In an obstacle, outside
  /// the closed grid, or out of the grid at the first border: other. A state on a border counts as
  /// in the cell above and to the right of it, which it leaves at once when it heads out of it.
  [[nodiscard]] Sampled answer(const State& state) const;

  /// Whether the single square that contains it reaches: the paper's method.
  [[nodiscard]] bool reaches(const State& state) const;

  const Grid& grid() const { return set_.grid; }
  CellKind kind_at(std::size_t cell) const {
    return owned_kind_.empty() ? flow_.kind[cell] : owned_kind_[cell];
  }

 private:
  /// A sample of an inner border.
  struct Sample {
    std::size_t border = 0;
    int heading = 0;
    int position = 0;
  };
  /// The answer if known without samples, or where to look.
  struct First {
    Sampled known = Sampled::other;
    std::optional<Sample> sample;
  };

  void require_fit() const;
  First first_border(const State& state) const;

  std::vector<CellKind> owned_kind_;
  Flow flow_;
  const BorderBitmap& set_;
  BitmapSamples samples_;
};

}  // namespace fairway
