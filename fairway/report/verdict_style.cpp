#include "fairway/report/verdict_style.hpp"

#include <array>
#include <cstddef>
#include <string>

namespace fairway {

/// Hues are those of the flights' outcomes.
VerdictStyle style_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::reach:
    case Verdict::follow:  // never beside reach: what a path mission proves in its place
      return {color_of_oklch(0.86, 0.06, 255.0), {}, false, false};
    case Verdict::hold:
      return {color_of_oklch(0.515, 0.09, 185.0), {palette::white, 0.5, {0.7, 1.8}}, true, true};
    case Verdict::collide:
      return {color_of_oklch(0.62, 0.19, 40.0), {palette::white, 0.5, {}}, true, false};
    case Verdict::leave:
      return {color_of_oklch(0.74, 0.14, 75.0), {palette::ink, 0.4, {}}, false, true};
    case Verdict::trapped:
      return {color_of_oklch(0.46, 0.18, 335.0), {palette::white, 0.5, {}}, true, true};
    case Verdict::undecided:
      return {color_of_oklch(0.98, 0.12, 105.0), {palette::ink, 0.7, {0.7, 1.8}}, false, true};
  }
  return {};
}

VerdictStyle at_risk_style() {
  return {color_of_oklch(0.78, 0.12, 5.0), {palette::ink, 0.6, {2.2, 1.2}}, true, false};
}

Color share_color(int share, int rank) {
  if (rank == 0) return palette::white;
  static constexpr std::array<double, 3> hue{255.0, 40.0, 105.0};
  const double depth = rank / (share_classes - 1.0);
  return color_of_oklch(0.98 - 0.46 * depth, 0.02 + 0.13 * depth,
                        hue[static_cast<std::size_t>(share)]);
}

LegendEntry verdict_entry(Verdict verdict) {
  const VerdictStyle style = style_of(verdict);
  const std::string proved = verdict == Verdict::undecided ? "" : "proved: ";
  return hatched_entry(proved + name_of(verdict), style.ground, style.pen, style.rising,
                       style.falling);
}

LegendEntry at_risk_entry() {
  const VerdictStyle style = at_risk_style();
  return hatched_entry("at risk", style.ground, style.pen, style.rising, style.falling);
}

}  // namespace fairway
