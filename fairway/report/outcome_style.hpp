// The look of flights by outcome, in the hues of the verdicts' grounds (verdict_style.hpp).
#pragma once

#include <vector>

#include "fairway/report/canvas.hpp"
#include "fairway/simulate/flight.hpp"

namespace fairway {

struct OutcomeStyle {
  Pen pen;                      ///< of the pictures
  Color on_screen;              ///< of the page: deeper, since its lines lie on top of the verdicts
  std::vector<double> dash_px;  ///< of the page; empty: solid
};

[[nodiscard]] OutcomeStyle style_of(Outcome outcome);

}  // namespace fairway
