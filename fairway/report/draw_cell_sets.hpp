// Paper 2's cellular sets of one cell, as a picture.
#pragma once

#include <string>

#include "fairway/cellular/cell_sets.hpp"
#include "fairway/report/picture.hpp"

namespace fairway {

/// Two rows of four panels, a border each, place along it by heading. Above, Theta: where a vehicle
/// that enters there leaves, by colour. Below, Phi: where a vehicle that leaves there may have come
/// in; where several borders are possible their colours are mixed.
[[nodiscard]] Picture draw_cell_sets(const CellSets& sets, const std::string& title);

}  // namespace fairway
