#include "fairway/report/outcome_style.hpp"

namespace fairway {

OutcomeStyle style_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::reach:
      return {{color_of_oklch(0.48, 0.13, 255.0), 0.9, {}}, {0x1d, 0x4f, 0x96}, {}};
    case Outcome::collide:
      return {{color_of_oklch(0.58, 0.20, 40.0), 1.5, {4.0, 1.5}}, {0xb8, 0x42, 0x0f}, {7.0, 3.0}};
    case Outcome::leave:
      return {{color_of_oklch(0.62, 0.13, 80.0), 1.5, {1.5, 1.5}}, {0x8a, 0x5c, 0x00}, {2.0, 2.5}};
    case Outcome::trapped:
      return {{color_of_oklch(0.50, 0.17, 340.0), 1.3, {6.0, 1.5, 1.5, 1.5}},
              {0x86, 0x16, 0x6f},
              {8.0, 2.5, 2.0, 2.5}};
    case Outcome::hold:
      return {{color_of_oklch(0.55, 0.10, 200.0), 1.1, {3.0, 1.5}}, {0x0f, 0x6b, 0x78}, {5.0, 2.5}};
  }
  return {};
}

}  // namespace fairway
