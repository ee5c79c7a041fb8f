// How flights look by their outcome: of the hues of the verdicts' grounds (verdict_style.hpp).
#pragma once

#include <vector>

#include "fairway/report/canvas.hpp"
#include "fairway/simulate/flight.hpp"

namespace fairway {

struct OutcomeStyle {
  Pen pen;                      ///< of the pictures
  Color on_screen;              ///< of the page: deeper, since its lines lie on the verdicts
  std::vector<double> dash_px;  ///< of the page; empty: solid
};

[[nodiscard]] OutcomeStyle style_of(Outcome outcome);

}  // namespace fairway
