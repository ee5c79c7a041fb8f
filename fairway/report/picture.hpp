// A finished picture in both formats, drawn by the same code. The bytes depend only on what is
// drawn and on the installed DejaVu Sans font: no dates, no counters.
#pragma once

#include <string>

namespace fairway {

struct Picture {
  std::string svg;  ///< SVG 1.1, UTF-8; layers are named groups (`<g id="streamlines">`)
  std::string png;  ///< PNG, 24-bit colour on white
};

}  // namespace fairway
