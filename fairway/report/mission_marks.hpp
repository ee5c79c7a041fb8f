// The vehicle's mission, drawn on the map.
#pragma once

#include "fairway/report/legend.hpp"
#include "fairway/report/plot_frame.hpp"
#include "fairway/vehicle/mission.hpp"

namespace fairway {

/// The layer "mission": a cross at the goal, with an arrow when it has a heading; or the path with
/// arrow heads along it.
void draw_mission(Canvas& canvas, const PlotFrame& frame, const Mission& mission);

[[nodiscard]] LegendEntry mission_entry(const Mission& mission);

/// A filled arrow head with its tip at `tip`, pointing along the unit vector `along` (page).
void add_arrow_head(DrawingPath& path, Vec2 tip, Vec2 along, double length_pt);

}  // namespace fairway
