// From where an adversary can make a vehicle within a contract fail, roughly, and in how many
// steps: what a search for a witness follows. Nothing depends on it for truth.
//
// The section of places and headings is divided into bins. Steps are flown backwards from the edges
// of obstacles (and of the grid), against what the contract allows (vehicle/contract.hpp, without a
// memory of sides); each bin that is reached for the first time goes on from the very state that
// reached it, so that errors do not add up. A bin reached may also hold states that cannot fail,
// and one not reached may hold some that can.
// Cost: one byte a bin, per_cell^2 * 64 bins a cell; time in proportion to the bins that are
// reached.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "fairway/behaviour/behaviour_choices.hpp"

namespace fairway {

struct FailureGuideOptions {
  int per_cell = 0;  ///< bins along the side of a cell, 1 to 8; 0: 4, fewer on large plans
};

class FailureGuide {
 public:
  static constexpr int headings = 64;
  static constexpr std::uint8_t never = 255;

  /// Keeps a reference to nothing.
  explicit FailureGuide(const BehaviourChoices& choices, const FailureGuideOptions& options = {});

  /// How far failure is: more is farther, not in proportion. `never`: no way was found.
  std::uint8_t level(Vec2 place, double heading_rad) const {
    const std::size_t bin = bin_of(place, heading_rad);
    return bin < level_.size() ? level_[bin] : never;
  }

  std::size_t bin_of(Vec2 place, double heading_rad) const {
    const double x = (place.x - x0_m_) * bins_per_m_;
    const double y = (place.y - y0_m_) * bins_per_m_;
    if (!(x >= 0.0 && y >= 0.0 && x < nx_ && y < ny_)) return level_.size();
    const auto h = static_cast<std::size_t>((heading_rad + pi) * (headings / two_pi));
    return (static_cast<std::size_t>(y) * static_cast<std::size_t>(nx_) +
            static_cast<std::size_t>(x)) *
               headings +
           std::min<std::size_t>(h, headings - 1);
  }
  double bins_per_m() const { return bins_per_m_; }

 private:
  int nx_;
  int ny_;
  double x0_m_;
  double y0_m_;
  double bins_per_m_;
  std::vector<std::uint8_t> level_;
};

}  // namespace fairway
