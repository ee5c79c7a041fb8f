// How far the vehicle comes while its heading turns by a step.
#pragma once

#include "check/shape.hpp"

namespace fairway_check {

/// All displacements in a step of the clock. With the radius r between r1 and r2 the displacement
/// is the integral of r e over the headings, so that of r1, an arc within the tangents at its ends
/// and in its middle, and (r2 - r1) times something in the parallelogram of the same tangents.
struct Displacements {
  Displacements(int turn, double clock, double step, double least_radius, double most_radius);
  Point whole{};  ///< of the whole step, to which `slack` is added
  Shape slack{};
  Shape partial{};  ///< of a part of the step from its beginning
  Shape begun{};    ///< of any part of the step: a sum of headings within it
};

}  // namespace fairway_check
