// The field stage's nouns: its options, and its product, a commanded heading for every cell.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "fairway/base/grid.hpp"
#include "fairway/base/vec2.hpp"
#include "fairway/map/region.hpp"
#include "fairway/vehicle/holding_place.hpp"

namespace fairway {

/// How distances are measured.
enum class Metric {
  euclidean,  ///< exact distances for the buffer, an eikonal cost-to-go: directions are not
              ///< quantised
  octile,     ///< exact shortest 8-connected paths, steps 1 and sqrt(2)
  paper       ///< Algorithms 1 and 2 of paper 1 to the letter: synchronous sweeps, steps 1 and 1.41
};

/// What the Gaussian filter averages (paper 1, Eq. 21).
enum class Filter {
  paper,      ///< every cell, obstacles too
  free_space  ///< only cells with a command, never through an obstacle
};

/// How the field turns near a path or a buffer border (paper 1, Eqs. 13-17).
enum class Blend {
  paper,      ///< Eq. 16 as printed: jumps at the outer rim of the transition region
  continuous  ///< the rotation falls to zero at the rim
};

/// The field near the path of a path mission.
enum class PathField {
  follow,  ///< commands approach the line on circles and run along it (follow_field.hpp)
  paper    ///< commands point at the line, but for the transition next to it (paper 1)
};

/// What cells get from which the mission is out of reach.
enum class FallbackRule {
  hold,  ///< holding places, and commands to them (fallback_field.hpp)
  none   ///< no command, as in the paper
};

/// The paper's parameters, by the paper's names, with their ranges; readers refuse values outside.
struct FieldOptions {
  double alpha = 2.0;  ///< buffer width / turn radius, > 0 (the paper: >= 2)
  double beta = 2.0;   ///< goal radius / turn radius, > 0 (the paper: >= 2)
  Metric metric = Metric::euclidean;
  double sigma_cells = 1.0;   ///< standard deviation of the Gaussian filter, >= 0; 0: no filter
  double mu_path = 0.5;       ///< speed of the rotation near a path, (0, 1]
  double sigma_path = 1.5;    ///< width of the transition at a path / turn radius, >= 0; 0: none
  double mu_border = 0.5;     ///< the same at the buffer's border
  double sigma_border = 0.5;  ///< the same at the buffer's border
  Filter filter = Filter::free_space;
  Blend blend = Blend::continuous;
  /// Commands this close to a grid axis are set to it, [0, 0.1]; never with Metric::paper. Where
  /// commands on both sides of a border oppose each other at an angle d to it, the vehicle weaves
  /// along the border in hops of 2 r sin d: without this, in millions of them.
  double axis_capture_rad = 0.02;
  PathField path_field = PathField::follow;  ///< path missions only
  FallbackRule fallback = FallbackRule::hold;
};

/// The product. Arrays are [iy][ix] over `grid`.
struct Field {
  Grid grid;
  std::vector<Region> region;
  std::vector<float> cost_m;       ///< cost to go, metres; +inf where the goal cannot be reached
  std::vector<float> heading_rad;  ///< commanded heading, (-pi, pi]; NaN: none
  std::vector<HoldingPlace> holding_places;  ///< in cells of infinite cost
  std::size_t unreachable_free_cells = 0;    ///< free cells of infinite cost (walled-off pockets)
  std::size_t vanished_cells =
      0;  ///< cells whose filtered vector was too short to have a direction
};

/// Formats a place as the user writes it, with a number of decimals for metres: "[x, y]".
using PlaceText = std::function<std::string(Vec2 place_m, int decimals)>;

/// Why there is no field for this mission on this map. `message` is one sentence for the user.
struct MissionRefusal {
  enum class Reason { outside_map, in_obstacle, in_buffer, goal_too_small, unreachable };
  Reason reason;
  std::string message;
  double lacks_m = 0.0;               ///< in_buffer: the clearance that is missing (Assumption 1)
  std::vector<std::string> warnings;  ///< of the map: they may explain the refusal
  /// The message with its places as the user writes them; empty: it names none.
  std::function<std::string(const PlaceText&)> words = {};
};

using FieldOrRefusal = std::variant<Field, MissionRefusal>;

}  // namespace fairway
