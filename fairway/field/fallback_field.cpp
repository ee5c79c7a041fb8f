#include "fairway/field/fallback_field.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

#include "fairway/base/parallel.hpp"
#include "fairway/field/buffer_border.hpp"
#include "fairway/field/complete_map.hpp"
#include "fairway/field/connected_parts.hpp"
#include "fairway/field/descent.hpp"
#include "fairway/field/distance_transform.hpp"
#include "fairway/field/eikonal.hpp"
#include "fairway/field/gaussian_filter.hpp"
#include "fairway/field/holding_circle.hpp"
#include "fairway/field/raw_field.hpp"
#include "fairway/field/stored_command.hpp"
#include "fairway/field/transition.hpp"

namespace fairway {
namespace {

constexpr double apart_radii = 50.0;  // circles of one part
constexpr std::size_t most_in_part = 16;
constexpr std::size_t always_led = 20'000;  // cells; more only if the mission has more

using Mask = std::vector<std::uint8_t>;

/// Calls visit(flat index, distance of its centre in metres) for the cells of a disc on the grid.
template <typename Visit>
void for_disc(const Grid& grid, Vec2 center_m, double radius_m, const Visit& visit) {
  const Cell low = grid.cell_of(center_m - Vec2{radius_m, radius_m});
  const Cell high = grid.cell_of(center_m + Vec2{radius_m, radius_m});
  for (int iy = std::max(0, low.iy); iy <= std::min(grid.ny - 1, high.iy); ++iy) {
    for (int ix = std::max(0, low.ix); ix <= std::min(grid.nx - 1, high.ix); ++ix) {
      const double distance_m = norm(grid.center({ix, iy}) - center_m);
      if (distance_m <= radius_m) visit(grid.index({ix, iy}), distance_m);
    }
  }
}

class Fallback {
 public:
  Fallback(const Vehicle& vehicle, const FieldOptions& options, Field& field)
      : vehicle_(vehicle), options_(options), field_(field), grid_(field.grid) {}

  std::vector<HoldingPlace> add() {
    wall_.resize(grid_.size());
    bool any = false;
    for (std::size_t i = 0; i < wall_.size(); ++i) {
      const bool open = field_.region[i] != Region::obstacle && std::isnan(field_.heading_rad[i]);
      wall_[i] = open ? 0 : 1;
      any = any || open;
    }
    if (!any) return {};
    place_circles();
    if (!places_.empty()) command();
    return std::move(places_);
  }

 private:
  /// Squared distance to the nearest cell that is not of these, those beyond the grid included.
  std::int64_t clearance2(std::size_t i) const {
    const Cell c = grid_.cell_at(i);
    const std::int64_t edge =
        std::min(std::min(c.ix, grid_.nx - 1 - c.ix), std::min(c.iy, grid_.ny - 1 - c.iy)) + 1;
    return std::min<std::int64_t>(clearance_cells2_[i], edge * edge);
  }

  /// First in the safe starts of each part, then in parts that got none.
  void place_circles() {
    clearance_cells2_.resize(grid_.size());
    distance_transform(wall_, grid_.nx, grid_.ny, {clearance_cells2_, {}});
    Mask safe(grid_.size());
    Mask rest(grid_.size());
    for (std::size_t i = 0; i < safe.size(); ++i) {
      rest[i] = wall_[i] == 0 ? 1 : 0;
      safe[i] = wall_[i] == 0 && field_.region[i] == Region::free ? 1 : 0;
    }
    place_in_parts(safe);
    const ConnectedParts parts = connected_parts(rest, grid_.nx, grid_.ny);
    Mask served(parts.cells.size());
    for (const HoldingPlace& place : places_) {
      served[parts.part[grid_.index(grid_.cell_of(place.center_m))]] = 1;
    }
    for (std::size_t i = 0; i < rest.size(); ++i) {
      if (rest[i] != 0 && served[parts.part[i]] != 0) rest[i] = 0;
    }
    place_in_parts(rest);
  }

  /// In each connected part of `inside`, greedily where there is most room.
  void place_in_parts(const Mask& inside) {
    const double room_cells = holding_room_m(grid_, vehicle_) / grid_.cell_m;
    std::vector<std::size_t> fitting;
    for (std::size_t i = 0; i < inside.size(); ++i) {
      if (inside[i] != 0 && static_cast<double>(clearance2(i)) > room_cells * room_cells) {
        fitting.push_back(i);
      }
    }
    if (fitting.empty()) return;
    std::stable_sort(fitting.begin(), fitting.end(),
                     [&](std::size_t a, std::size_t b) { return clearance2(a) > clearance2(b); });
    const ConnectedParts parts = connected_parts(inside, grid_.nx, grid_.ny);
    std::vector<std::vector<Vec2>> centers(parts.cells.size());
    const double apart_m = apart_radii * vehicle_.turn_radius_m;
    for (const std::size_t i : fitting) {
      std::vector<Vec2>& there = centers[parts.part[i]];
      const Vec2 center = grid_.center(grid_.cell_at(i));
      const bool far = std::all_of(there.begin(), there.end(),
                                   [&](Vec2 other) { return norm(center - other) >= apart_m; });
      if (!far || there.size() == most_in_part) continue;
      there.push_back(center);
      places_.push_back({center, holding_radius_m(grid_, vehicle_), Rotation::left});
    }
  }

  /// The map as if the circles were the mission, and all that has its commands already a wall.
  void command() {
    CompleteMap complete;
    complete.region = field_.region;
    for (std::size_t i = 0; i < wall_.size(); ++i) {
      if (wall_[i] != 0) complete.region[i] = Region::obstacle;
    }
    std::vector<EikonalSource> sources;
    for (const HoldingPlace& place : places_) {
      for_disc(grid_, place.center_m, holding_room_m(grid_, vehicle_),
               [&](std::size_t i, double from_center_m) {
                 if (wall_[i] != 0) return;
                 complete.region[i] = Region::goal;
                 const double away_m = std::abs(from_center_m - place.radius_m);
                 sources.push_back(
                     {static_cast<std::uint32_t>(i), static_cast<float>(away_m / grid_.cell_m)});
               });
    }
    complete.clearance_cells2 = std::move(clearance_cells2_);
    Mask inside(grid_.size());
    for (std::size_t i = 0; i < inside.size(); ++i) {
      inside[i] = complete.region[i] == Region::free || complete.region[i] == Region::goal ? 1 : 0;
    }
    std::vector<float> cost = eikonal_distance(inside, grid_.nx, grid_.ny, sources);
    BufferBorder border = buffer_border(grid_, complete.region, cost);
    const Mission circles = PathMission{};
    VectorField raw = raw_field(grid_, complete, circles, Metric::euclidean, cost, border);
    raw = transition_field(grid_, complete, border, raw, vehicle_, options_);
    lead_the_rest(cost, raw);
    VectorField smoothed = raw;
    if (options_.sigma_cells > 0.0) {
      gaussian_filter_between_walls(smoothed, wall_, grid_.nx, grid_.ny, options_.sigma_cells);
    }
    for (const HoldingPlace& place : places_) {
      follow_circle(grid_, complete.region, place, cost, vehicle_, smoothed);
    }
    const float farthest = farthest_led(cost);
    for (std::size_t i = 0; i < wall_.size(); ++i) {
      if (wall_[i] != 0 || !std::isfinite(cost[i]) || cost[i] > farthest) continue;
      const VectorField& by = has_vanished(smoothed.x[i], smoothed.y[i]) ? raw : smoothed;
      field_.heading_rad[i] = stored_command(by.x[i], by.y[i], options_.axis_capture_rad);
    }
  }

  /// Outside the walls of a race track there may be ten times as many cells as inside, and to prove
  /// what commands do there would cost ten times as much: only the nearest cells are led.
  float farthest_led(const std::vector<float>& cost) const {
    std::vector<float> ways;
    std::size_t of_mission = 0;
    for (std::size_t i = 0; i < cost.size(); ++i) {
      of_mission += std::isnan(field_.heading_rad[i]) ? 0 : 1;
      if (wall_[i] == 0 && std::isfinite(cost[i])) ways.push_back(cost[i]);
    }
    const std::size_t most = std::max(always_led, of_mission);
    if (ways.size() <= most) return std::numeric_limits<float>::infinity();
    const auto last = ways.begin() + static_cast<std::ptrdiff_t>(most);
    std::nth_element(ways.begin(), last, ways.end());
    return *last;
  }

  /// Cells that are joined to a circle through the buffer alone: by the shortest way.
  void lead_the_rest(std::vector<float>& cost, VectorField& field) const {
    Mask inside(grid_.size());
    std::vector<EikonalSource> sources;
    bool any = false;
    for (std::size_t i = 0; i < inside.size(); ++i) {
      if (wall_[i] != 0) continue;
      inside[i] = 1;
      any = any || !std::isfinite(cost[i]);
      if (std::isfinite(cost[i])) sources.push_back({static_cast<std::uint32_t>(i), cost[i]});
    }
    if (!any) return;
    const std::vector<float> way = eikonal_distance(inside, grid_.nx, grid_.ny, sources);
    for_rows(grid_.ny, [&](int first, int last) {
      for (int iy = first; iy < last; ++iy) {
        const DescentRows rows(way, grid_.nx, grid_.ny, iy);
        for (int ix = 0; ix < grid_.nx; ++ix) {
          const std::size_t i = grid_.index({ix, iy});
          if (!std::isfinite(way[i]) || std::isfinite(cost[i])) continue;
          const Descent down = descent_continuous(rows, ix);
          field.x[i] = down.x;
          field.y[i] = down.y;
        }
      }
    });
    for (std::size_t i = 0; i < cost.size(); ++i) {
      if (!std::isfinite(cost[i])) cost[i] = way[i];
    }
  }

  const Vehicle& vehicle_;
  const FieldOptions& options_;
  Field& field_;
  const Grid& grid_;
  Mask wall_;  ///< 1: not one of the cells without a command
  std::vector<std::int32_t> clearance_cells2_;
  std::vector<HoldingPlace> places_;
};

}  // namespace

std::vector<HoldingPlace> add_fallback(const Vehicle& vehicle, const FieldOptions& options,
                                       Field& field) {
  return Fallback(vehicle, options, field).add();
}

}  // namespace fairway
