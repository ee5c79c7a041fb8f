// From where an adversary can make a vehicle within a contract fail, roughly, and in how many
// steps: what a search for a witness follows. Nothing depends on it for truth.
//
// The section of places and headings is divided into bins. Steps are flown backwards from the edges
// of obstacles (and of the grid), against what the contract allows (vehicle/contract.hpp, without a
// memory of sides); each bin that is reached for the first time goes on from the very state that
// reached it, so that errors do not add up. A bin reached may also hold states that cannot fail,
// and one not reached may hold some that can.
// Cost: 64 bytes for each place from which some heading is reached, and 4 for each of the
// per_cell^2 places of a cell; time in proportion to the bins that are reached.
#pragma once

#include <algorithm>
#include <array>
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
    const std::size_t at = place_number(place);
    return at < row_of_.size() ? levels_at(at)[heading_number(heading_rad)] : never;
  }
  double bins_per_m() const { return bins_per_m_; }

 private:
  using Levels = std::array<std::uint8_t, headings>;
  static constexpr std::size_t rows_together = 1024;

  /// That of no place: as many as there are.
  std::size_t place_number(Vec2 place) const {
    const double x = (place.x - x0_m_) * bins_per_m_;
    const double y = (place.y - y0_m_) * bins_per_m_;
    if (!(x >= 0.0 && y >= 0.0 && x < nx_ && y < ny_)) return row_of_.size();
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(nx_) +
           static_cast<std::size_t>(x);
  }
  static std::size_t heading_number(double heading_rad) {
    const auto h = static_cast<std::size_t>((heading_rad + pi) * (headings / two_pi));
    return std::min<std::size_t>(h, headings - 1);
  }
  const Levels& levels_at(std::size_t place) const {
    const std::uint32_t row = row_of_[place];
    return rows_[row / rows_together][row % rows_together];
  }
  bool add(Vec2 place, double heading_rad, std::uint8_t level);

  int nx_;
  int ny_;
  double x0_m_;
  double y0_m_;
  double bins_per_m_;
  std::vector<std::uint32_t> row_of_;  ///< [places]; 0: that of places that nothing reaches
  std::vector<std::vector<Levels>> rows_;
};

}  // namespace fairway
