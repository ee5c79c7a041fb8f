// Places a grid in a frame of a page, and sets its scale.
#pragma once

#include "fairway/base/grid.hpp"
#include "fairway/report/plot_frame.hpp"

namespace fairway {

/// The world that a frame shows: the grid, or more where the grid is thin or empty. Sets both axes.
void frame_world(PlotFrame& frame, const Grid& grid);

/// Width and height of the frame's world in points when its longer side has `longer_pt`.
[[nodiscard]] Vec2 size_of_world_pt(const PlotFrame& frame, double longer_pt);

/// Room that a scale bar takes below its corner, points.
inline constexpr double scale_bar_room_pt = 34.0;

/// A bar of a round length, at most 70 points, with its metres below; the layer "scale-bar".
void draw_scale_bar(Canvas& canvas, Vec2 corner, double pt_per_m);

}  // namespace fairway
