#include "fairway/report/flight_path.hpp"

#include <cmath>

namespace fairway {
namespace {

void add_piece(DrawingPath& path, const FlightSegment& piece, const PlotFrame& frame) {
  // Looks straight; the centre of so flat an arc would be too far away for the digits written.
  constexpr double flat_rad = 1e-4;
  if (std::abs(piece.length_m * piece.curvature_per_m) < flat_rad) {
    path.line_to(frame.to_page(state_at(piece, piece.length_m).position_m));
    return;
  }
  const Vec2 along = piece.start.heading.unit();
  const double radius_m = 1.0 / piece.curvature_per_m;  // signed, positive to the left
  const Vec2 center_m = piece.start.position_m + radius_m * left_of(along);
  const Vec2 center = frame.to_page(center_m);
  const Vec2 from = frame.to_page(piece.start.position_m) - center;
  // y is turned over on the page, so a left turn sweeps from +y towards +x: negative.
  path.arc(center, norm(from), std::atan2(from.y, from.x), -piece.length_m * piece.curvature_per_m);
}

}  // namespace

DrawingPath segments_path(std::span<const FlightSegment> segments, const PlotFrame& frame) {
  DrawingPath path;
  if (segments.empty()) return path;
  path.move_to(frame.to_page(segments.front().start.position_m));
  FlightSegment piece = segments.front();
  for (std::size_t i = 1; i < segments.size(); ++i) {
    const FlightSegment& next = segments[i];
    const bool same_line =
        next.curvature_per_m == piece.curvature_per_m &&
        (piece.curvature_per_m != 0.0 || next.start.heading == piece.start.heading);
    if (same_line) {
      piece.length_m += next.length_m;
      continue;
    }
    add_piece(path, piece, frame);
    piece = next;
  }
  add_piece(path, piece, frame);
  return path;
}

}  // namespace fairway
