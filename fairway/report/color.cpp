#include "fairway/report/color.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "fairway/base/error.hpp"

namespace fairway {
namespace {

std::uint8_t srgb_byte(double linear) {
  const double c = std::clamp(linear, 0.0, 1.0);
  const double encoded = c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1.0 / 2.4) - 0.055;
  return static_cast<std::uint8_t>(std::lround(255.0 * encoded));
}

}  // namespace

Color color_of_oklch(double lightness, double chroma, double hue_deg) {
  const double hue = hue_deg * std::numbers::pi / 180.0;
  const double a = chroma * std::cos(hue);
  const double b = chroma * std::sin(hue);
  // Oklab to cone responses (cube roots undone), then to linear sRGB.
  const double l = std::pow(lightness + 0.3963377774 * a + 0.2158037573 * b, 3.0);
  const double m = std::pow(lightness - 0.1055613458 * a - 0.0638541728 * b, 3.0);
  const double s = std::pow(lightness - 0.0894841775 * a - 1.2914855480 * b, 3.0);
  return {srgb_byte(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
          srgb_byte(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
          srgb_byte(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s)};
}

Color cost_ramp(double share) {
  require(!std::isnan(share), "cost_ramp takes a number");
  const double t = std::clamp(share, 0.0, 1.0);
  // Yellow (105 degrees) to blue (260), by way of green-grey: chroma dips in the middle so that
  // the two hues at the ends carry the order together with lightness.
  const double chroma = 0.10 - 0.16 * t * (1.0 - t);
  return color_of_oklch(0.97 - 0.45 * t, chroma, 105.0 + 155.0 * t);
}

Color series_color(int place) {
  require(place >= 0, "a series has a place of 0 or more");
  // Even hues at two lightnesses, the order chosen so that neighbours differ in both.
  static constexpr std::array<std::array<double, 3>, 8> lch{{{0.45, 0.13, 255.0},
                                                             {0.63, 0.17, 45.0},
                                                             {0.45, 0.12, 150.0},
                                                             {0.55, 0.17, 345.0},
                                                             {0.70, 0.12, 220.0},
                                                             {0.40, 0.09, 80.0},
                                                             {0.40, 0.14, 300.0},
                                                             {0.30, 0.00, 0.0}}};
  const auto& c = lch[static_cast<std::size_t>(place) % lch.size()];
  return color_of_oklch(c[0], c[1], c[2]);
}

}  // namespace fairway
