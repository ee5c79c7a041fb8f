#include "fairway/bitmap/bitmap_samples.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fairway/base/error.hpp"
#include "fairway/base/heading.hpp"

namespace fairway {

BitmapSamples::BitmapSamples(int m) : m_(m), step_(1.0 / m), slots_per_one_(8.0 * m) {
  require(m >= least && m <= most && m % 4 == 0,
          "samples per border: a multiple of 4 in 4 .. 8192");
  const double sector_rad = two_pi / m;
  const int quarter_count = m / 4;
  // Sines of one quadrant serve all four: turned and mirrored samples are the same bits.
  std::vector<double> sine(static_cast<std::size_t>(quarter_count));
  for (int k = 0; k < quarter_count; ++k)
    sine[static_cast<std::size_t>(k)] = std::sin((k + 0.5) * sector_rad);
  units_.resize(static_cast<std::size_t>(m));
  for (int k = 0; k < quarter_count; ++k) {
    Vec2 u{sine[static_cast<std::size_t>(quarter_count - 1 - k)],
           sine[static_cast<std::size_t>(k)]};
    for (int q = 0; q < 4; ++q, u = left_of(u))
      units_[static_cast<std::size_t>(q * quarter_count + k)] = u;
  }

  const int half = m / 2;
  sines_.resize(static_cast<std::size_t>(half) + 1);
  for (int j = 0; j < quarter_count; ++j) {
    const double s = std::sin(j * sector_rad);
    sines_[static_cast<std::size_t>(quarter_count + j)] = s;
    sines_[static_cast<std::size_t>(quarter_count - j)] = -s;
  }
  sines_.front() = -1.0;
  sines_.back() = std::numeric_limits<double>::infinity();

  first_bins_.resize(static_cast<std::size_t>(16 * m) + 1);
  for (std::size_t slot = 0; slot < first_bins_.size(); ++slot) {
    // Slightly below the slot's lower end, so that rounding of the slot cannot skip a sector.
    const double lowest = static_cast<double>(slot) / slots_per_one_ - 1.0 - 1e-12;
    const auto above = std::upper_bound(sines_.begin(), sines_.end(), lowest);
    first_bins_[slot] =
        static_cast<std::uint16_t>(std::max<std::ptrdiff_t>(0, above - sines_.begin() - 1));
  }
}

}  // namespace fairway
