// Transition regions at a path and at the buffer's border (paper 1, Eqs. 11 to 18).
#pragma once

#include "fairway/base/grid.hpp"
#include "fairway/field/buffer_border.hpp"
#include "fairway/field/complete_map.hpp"
#include "fairway/field/field.hpp"
#include "fairway/field/vector_field.hpp"
#include "fairway/vehicle/vehicle.hpp"

namespace fairway {

/// How far the field at a cell turns towards the field at its nearest edge, as a share of the angle
/// between the two: 1 - a of Eq. 16. `ratio` = distance / (sigma r), 0..1; `angle_rad` 0..pi.
///   Blend::paper       a = mu * ratio * angle / pi   (not 1 at the rim: the field jumps there)
///   Blend::continuous  the same a inside, brought to 1 at the rim: a + (1 - a) ratio^(1/mu)
[[nodiscard]] float transition_share(float ratio, float angle_rad, float mu, Blend blend);

/// The factor for that share where the nearest path cell lies `to_end_m` before the end of
/// an open path: 1 along the path, falling to 0 over half a turning radius, 0 within a cell of the
/// end. There the raw field points back at the end and the path on past it: a field turned to the
/// path would lead away from its end, and flights would circle beyond it for ever. Not in the
/// paper, whose paths have no end; Blend::paper omits it.
[[nodiscard]] float share_near_open_end(double to_end_m, double cell_m, double turn_radius_m);

/// Eq. 13: near an edge the raw field turns towards the field at the nearest edge cell, the shorter
/// way round (Eq. 15 in its corrected form: towards F(p_e) on either side); elsewhere it stays.
/// Edges are the border cells of the buffer and, in path missions, the path's cells; the nearest
/// edge counts. At the end of an open path the turn fades out (Blend::continuous). Obstacles and
/// cells without a direction are unchanged.
[[nodiscard]] VectorField transition_field(const Grid& grid, const CompleteMap& complete,
                                           const BufferBorder& border, const VectorField& raw,
                                           const Vehicle& vehicle, const FieldOptions& options);

}  // namespace fairway
