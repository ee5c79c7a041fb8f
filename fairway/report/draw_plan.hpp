// A plan as a picture: regions, cost to go, the field as streamlines or arrows.
//
// Free cells are shaded by their cost to go with contour lines at the colour bar's ticks; the
// buffer, the obstacles, the goal and unreachable pockets have a colour and, where colour alone
// might not distinguish them, a pattern. Big plans are averaged down to one colour a pixel; lines
// and text stay vectors.
#pragma once

#include <optional>
#include <string>

#include "fairway/plan/plan.hpp"
#include "fairway/report/picture.hpp"
#include "fairway/vehicle/mission.hpp"

namespace fairway {

struct PlanPictureOptions {
  std::string title = {};
  std::optional<Mission> mission = {};  ///< the goal point and heading, or the path, drawn on top
  bool cost = true;                     ///< shade the free cells by cost to go, with contours
  bool streamlines = true;              ///< evenly spaced lines along the field
  bool arrows = false;                  ///< the commanded heading, one for every few cells
  int streamlines_across = 40;  ///< lines that fit side by side along the longer side, 1..200
  int arrows_across = 40;       ///< arrows along the longer side, 1..200
  double frame_pt = 420.0;      ///< longer side of the map, points (1/72 inch), 100..2000
  double pixels_per_pt = 2.0;   ///< resolution of the PNG, 0.5..8
};

/// Any plan whose arrays have grid.size() entries, an empty grid too. Throws PreconditionViolation
/// when they have not, or when an option is out of range.
[[nodiscard]] Picture draw_plan(const Plan& plan, const PlanPictureOptions& options);

}  // namespace fairway
