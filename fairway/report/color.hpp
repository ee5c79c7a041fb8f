// Colours of the pictures, chosen to be distinguishable to the colour-blind.
//
// The ramp runs from pale yellow to deep blue with lightness falling evenly: it is computed in
// Oklab (Bjorn Ottosson 2020, a space of equal perceived steps), so that equal steps of value look
// equal, also in grey print and to eyes without red or green receptors.
#pragma once

#include <cstdint>

namespace fairway {

/// sRGB, not premultiplied.
struct Color {
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;
  double opacity = 1.0;  ///< 0..1
  friend constexpr bool operator==(const Color&, const Color&) = default;
};

/// Oklab lightness 0..1, chroma 0..0.4, hue in degrees; each channel is cut to what sRGB can show.
[[nodiscard]] Color color_of_oklch(double lightness, double chroma, double hue_deg);

/// `share` 0 (pale yellow) to 1 (deep blue); values outside are cut to the ends, NaN is an error.
[[nodiscard]] Color cost_ramp(double share);

/// Dark line colours for up to eight series, after which they repeat.
[[nodiscard]] Color series_color(int place);

namespace palette {
inline constexpr Color white{255, 255, 255};
inline constexpr Color ink{34, 34, 34};
inline constexpr Color faint_ink{120, 120, 120};
inline constexpr Color obstacle{58, 58, 62};
inline constexpr Color buffer{226, 219, 205};
inline constexpr Color buffer_pattern{176, 164, 140};
inline constexpr Color free{255, 255, 255};
inline constexpr Color goal{255, 255, 255};
inline constexpr Color goal_pattern{0, 158, 115};
inline constexpr Color unreachable{255, 255, 255};
inline constexpr Color unreachable_pattern{170, 51, 119};
}  // namespace palette

}  // namespace fairway
