// The look of verdicts: each has a ground colour of its own lightness and its own pattern, so that
// they can be distinguished in grey print and by the colour-blind, and a sample for the legend.
#pragma once

#include "fairway/report/legend.hpp"
#include "fairway/verify/verdict.hpp"

namespace fairway {

struct VerdictStyle {
  Color ground;
  Pen pen;  ///< of the pattern
  bool rising = false;
  bool falling = false;  ///< neither: no pattern
};

[[nodiscard]] VerdictStyle style_of(Verdict verdict);

/// Of undecided states from which a behaviour within a contract is known to fail.
[[nodiscard]] VerdictStyle at_risk_style();

/// Of the shares proved to reach (0), proved to fail (1) and undecided (2), the colour of class
/// `rank`: none, up to an eighth, a half, seven eighths, not quite all, all (5). White to the deep
/// colour of the share, lightness falling evenly: it works in grey print.
inline constexpr int share_classes = 6;
[[nodiscard]] Color share_color(int share, int rank);

/// "proved: collide", "undecided", with a sample.
[[nodiscard]] LegendEntry verdict_entry(Verdict verdict);
[[nodiscard]] LegendEntry at_risk_entry();

}  // namespace fairway
