// The samples of a border: m positions by m headings (paper 2, section V.B).
//
// Position i is the middle of the i-th of m equal pieces of the side, along +x or +y. Heading k is
// the middle of the k-th of m equal sectors of the circle, counter-clockwise from east.
// Properties that always hold, for m a multiple of 4:
//   1. The axes are ends of sectors: no sample heads along a border, so every sample state enters
//      exactly one cell, and a heading and the sample it is snapped to cross the same borders.
//   2. Samples of one quadrant are those of any other turned by 90 degrees, and mirrored ones are
//      samples too, the same bits.
// A heading exactly between two sectors belongs to the one counter-clockwise of it; a position
// exactly between two pieces to the upper one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "fairway/base/vec2.hpp"

namespace fairway {

class BitmapSamples {
 public:
  static constexpr int least = 4;
  static constexpr int most = 8192;

  /// Throws PreconditionViolation unless m is a multiple of 4 in least .. most.
  explicit BitmapSamples(int m);

  int count() const { return m_; }
  int quarter() const { return m_ / 4; }
  Vec2 unit(int k) const { return units_[static_cast<std::size_t>(k)]; }
  /// In shares of the side, (0, 1).
  double position(int i) const { return (i + 0.5) * step_; }
  int wrapped(int k) const { return k < 0 ? k + m_ : k < m_ ? k : k - m_; }

  /// The piece that contains a position in shares of the side; outside values belong to the end.
  int position_bin(double share) const {
    const int i = static_cast<int>(share * m_);
    return i < 0 ? 0 : i < m_ ? i : m_ - 1;
  }
  /// The sector, counted from the one that begins at -90 degrees, of the heading in [-90, 90)
  /// degrees with this sine; values outside [-1, 1] belong to the end.
  int sine_bin(double sine) const {
    const double slot = (sine + 1.0) * slots_per_one_;
    const int last = static_cast<int>(first_bins_.size()) - 1;
    const int place = slot < 0.0 ? 0 : slot < last ? static_cast<int>(slot) : last;
    int q = first_bins_[static_cast<std::size_t>(place)];
    while (sine >= sines_[static_cast<std::size_t>(q) + 1]) ++q;  // the last one is +inf
    return q;
  }
  /// The sector of a unit vector.
  int heading_bin(Vec2 u) const {
    const bool upper = u.y > 0.0 || (u.y == 0.0 && u.x > 0.0);
    return upper ? sine_bin(-u.x) : m_ / 2 + sine_bin(u.x);
  }

 private:
  int m_;
  double step_;
  double slots_per_one_;
  std::vector<Vec2> units_;                // [m]
  std::vector<double> sines_;              // [m / 2 + 1], of the sectors' ends from -90 degrees on
  std::vector<std::uint16_t> first_bins_;  // by slot: no sine in it lies below this sector
};

}  // namespace fairway
