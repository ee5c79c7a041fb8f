// The line that a vehicle of bounded curvature can fly instead of a path: the path itself where it
// bends no more sharply than a radius, an arc of that radius inside its corners.
#pragma once

#include "fairway/vehicle/mission.hpp"

namespace fairway {

/// The path with its corners cut. Vertices are moved only where the path bends more sharply than
/// `radius_m` > 0, towards the inside of the bend, and never by more than `radius_m`: a corner that
/// would need more, such as a turn back between legs less than two radii apart, stays sharper.
/// Ends of open paths stay; of vertices nearer to one another than radius / 16 one stays. The
/// result's arcs are polylines with a vertex every eighth of a radius. The tolerances of Eq. 5 are
/// kept. Throws PreconditionViolation when the path has fewer than two vertices.
[[nodiscard]] PathMission flyable_path(const PathMission& path, double radius_m);

/// The line that the field of a path mission follows: flyable_path, and of its bends those made
/// gentler, up to a radius of 1.5 turn_radius_m, that have room for it. A vehicle that turns hardly
/// as sharply as it should, or obeys late, keeps nearer to a line that asks less of it.
[[nodiscard]] PathMission followed_line(const PathMission& path, double turn_radius_m);

}  // namespace fairway
