#include "check/contract_displacements.hpp"

#include <cmath>

#include "check/contract_places.hpp"

namespace fairway_check {

Displacements::Displacements(int turn, double clock, double step, double least_radius,
                             double most_radius) {
  const double tangent = std::tan(0.5 * step);
  const Point first = tangent * unit(turn * clock);
  const Point last = tangent * unit(turn * (clock + step));
  const Point chord = first + last;
  const double spread = most_radius - least_radius;
  whole = least_radius * chord;
  // Tangents of half the step meet in front of and behind its middle.
  const double half = least_radius * std::tan(0.25 * step);
  const Point before = half * unit(turn * clock);
  const Point behind = whole - half * unit(turn * (clock + step));
  const Shape arc = turn > 0 ? Shape{{0.0, 0.0}, before, behind, whole}
                             : Shape{{0.0, 0.0}, whole, behind, before};
  const Point one = most_radius * first;
  const Point other = most_radius * last;
  begun = turn > 0 ? Shape{{0.0, 0.0}, one, one + other, other}
                   : Shape{{0.0, 0.0}, other, one + other, one};
  if (spread > 0.0) {
    const Point a = spread * first;
    const Point b = spread * last;
    slack = turn > 0 ? Shape{{0.0, 0.0}, a, a + b, b} : Shape{{0.0, 0.0}, b, a + b, a};
  } else {
    slack = Shape{{0.0, 0.0}};
  }
  partial = sum(arc, slack);
}

}  // namespace fairway_check
