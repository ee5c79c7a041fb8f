#include "fairway/field/passages.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <queue>
#include <utility>

#include "fairway/base/number_text.hpp"
#include "fairway/field/buffer_rule.hpp"
#include "fairway/field/connected_parts.hpp"
#include "fairway/field/mission_cells.hpp"

namespace fairway {
namespace {

bool is_cut_off(std::span<const Region> region, std::span<const float> cost_m, std::size_t i) {
  return region[i] == Region::free && std::isinf(cost_m[i]);
}

template <typename Inside>
ConnectedParts parts_where(const Grid& grid, const Inside& inside) {
  std::vector<std::uint8_t> mask(grid.size());
  for (std::size_t i = 0; i < mask.size(); ++i) mask[i] = inside(i) ? 1 : 0;
  return connected_parts(mask, grid.nx, grid.ny);
}

/// The cells of a way from the mission to `part`, from its end to its beginning.
std::vector<std::uint32_t> widest_way(const Clearances& room, std::span<const Region> region,
                                      const ConnectedParts& parts, std::uint32_t part) {
  const Grid& grid = room.grid;
  constexpr std::uint32_t unseen = no_part;
  std::vector<std::uint32_t> from(grid.size(), unseen);
  std::priority_queue<std::pair<std::int32_t, std::uint32_t>> waiting;  // the widest first
  for (std::uint32_t i = 0; i < grid.size(); ++i) {
    if (region[i] != Region::goal) continue;
    from[i] = i;
    waiting.emplace(room.measure[i], i);
  }
  while (!waiting.empty()) {
    const auto [width, here] = waiting.top();
    waiting.pop();
    if (parts.part[here] == part) {
      std::vector<std::uint32_t> way{here};
      while (from[way.back()] != way.back()) way.push_back(from[way.back()]);
      return way;
    }
    const Cell c = grid.cell_at(here);
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const Cell n{c.ix + dx, c.iy + dy};
        if (!grid.contains(n)) continue;
        const auto i = static_cast<std::uint32_t>(grid.index(n));
        if (from[i] != unseen || room.free_width_m(i) <= 0.0) continue;
        // Reached first by the widest way: a later one is not wider.
        from[i] = here;
        waiting.emplace(std::min(width, room.measure[i]), i);
      }
    }
  }
  return {};
}

/// Where a way is narrowest; of several such cells the middle one.
std::uint32_t narrowest(const Clearances& room, const std::vector<std::uint32_t>& way) {
  const auto narrower = [&](std::uint32_t a, std::uint32_t b) {
    return room.measure[a] < room.measure[b];
  };
  const std::uint32_t least = *std::min_element(way.begin(), way.end(), narrower);
  std::vector<std::uint32_t> all;
  std::copy_if(way.begin(), way.end(), std::back_inserter(all),
               [&](std::uint32_t i) { return room.measure[i] == room.measure[least]; });
  return all[all.size() / 2];
}

/// The largest alpha, or radius, in four digits whose product with `other` is a buffer that leaves
/// a cell of this measure free.
double opening(const Clearances& room, std::size_t cell, double other) {
  const auto is_open = [&](double value) {
    return room.measure[cell] > buffer_limit(room.grid, room.metric, value * other);
  };
  const double most = room.free_width_m(cell) / other;
  const double told = rounded_down(most, 4);
  return is_open(told) ? told : rounded_down(most * (1.0 - 1e-6), 4);
}

bool mission_fits(const Grid& grid, const Mission& mission, const FieldOptions& options,
                  double turn_radius_m) {
  if (turn_radius_m <= grid.cell_m) return false;
  const auto* goal = std::get_if<GoalMission>(&mission);
  return goal == nullptr ||
         !cells_inside_disc(grid, goal->goal_m, options.beta * turn_radius_m).empty();
}

std::size_t opened_cells(const Clearances& room, std::span<const Region> region,
                         std::span<const float> cost_m, std::uint32_t cell) {
  const auto parts = parts_where(room.grid, [&](std::size_t i) {
    return region[i] == Region::goal || room.measure[i] >= room.measure[cell];
  });
  std::size_t count = 0;
  for (std::size_t i = 0; i < room.grid.size(); ++i) {
    if (is_cut_off(region, cost_m, i) && parts.part[i] == parts.part[cell]) ++count;
  }
  return count;
}

}  // namespace

CutOff cut_off(const ObstacleMap& map, const Vehicle& vehicle, const Mission& mission,
               const FieldOptions& options, std::span<const Region> region,
               std::span<const float> cost_m) {
  const Grid& grid = map.grid;
  CutOff out;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    out.free_cells += region[i] == Region::free ? 1 : 0;
    out.cut_off_cells += is_cut_off(region, cost_m, i) ? 1 : 0;
  }
  if (out.cut_off_cells == 0) return out;

  const Clearances room = clearances(map, options.metric);
  const auto cut = parts_where(grid, [&](auto i) { return is_cut_off(region, cost_m, i); });
  const auto open = parts_where(grid, [&](auto i) { return room.free_width_m(i) > 0.0; });
  std::vector<std::uint8_t> joined(open.cells.size());
  for (std::size_t i = 0; i < grid.size(); ++i) {
    if (region[i] == Region::goal) joined[open.part[i]] = 1;
  }
  std::uint32_t largest = no_part;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const std::uint32_t part = cut.part[i];
    if (part == no_part) continue;
    if (joined[open.part[i]] == 0) {
      ++out.walled_off_cells;
    } else if (largest == no_part || cut.cells[part] > cut.cells[largest]) {
      largest = part;
    }
  }
  if (largest == no_part) return out;

  const std::uint32_t cell = narrowest(room, widest_way(room, region, cut, largest));
  Passage passage;
  passage.place_m = grid.center(grid.cell_at(cell));
  passage.width_m = 2.0 * room.clearance_m(cell);
  passage.needed_m = 2.0 * options.alpha * vehicle.turn_radius_m;
  passage.alpha = opening(room, cell, vehicle.turn_radius_m);
  const double radius_m = opening(room, cell, options.alpha);
  if (mission_fits(grid, mission, options, radius_m)) passage.turn_radius_m = radius_m;
  passage.opens_cells = opened_cells(room, region, cost_m, cell);
  out.passage = passage;
  return out;
}

}  // namespace fairway
