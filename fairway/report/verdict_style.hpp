// How verdicts look: every one has a ground colour of its own lightness and a pattern of its own,
// so that they are told apart in grey print and by the colour-blind, and a sample of the legend.
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
[[nodiscard]] LegendEntry verdict_entry(std::string name, Verdict verdict);

}  // namespace fairway
