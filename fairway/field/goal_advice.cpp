#include "fairway/field/goal_advice.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "fairway/base/number_text.hpp"
#include "fairway/field/buffer_rule.hpp"
#include "fairway/field/connected_parts.hpp"
#include "fairway/field/distance_transform.hpp"
#include "fairway/field/mission_cells.hpp"

namespace fairway {
namespace {

/// Decimals with which a rounded place moves by less than a quarter of a cell.
int decimals_for(const Grid& grid) {
  return std::max(2, static_cast<int>(std::ceil(std::log10(2.0 / grid.cell_m))));
}
/// How far rounding moves a place: half a step in x and in y, and a little more in degrees.
double moved_m(int decimals) { return 0.8 * std::pow(10.0, -decimals); }

Vec2 rounded(Vec2 p, int decimals) {
  const double steps = std::pow(10.0, decimals);
  return {std::round(steps * p.x) / steps, std::round(steps * p.y) / steps};
}

/// Answers quickly whether the disc around a cell's centre is free.
class FreeDiscs {
 public:
  FreeDiscs(const Grid& grid, const std::vector<Region>& region, double radius_m)
      : grid_(grid), radius_m_(radius_m), radius2_(std::pow(radius_m / grid.cell_m, 2.0)) {
    taken_.resize(grid.size());
    for (std::size_t i = 0; i < taken_.size(); ++i) taken_[i] = region[i] != Region::free ? 1 : 0;
    d2_.resize(grid.size());
    distance_transform(taken_, grid.nx, grid.ny, {d2_, {}});
  }
  [[nodiscard]] bool about(std::size_t i) const {
    // A taken cell at (dx, dy) lies in the disc if (|dx| + 1/2)^2 + (|dy| + 1/2)^2 <= R^2; the
    // left side is d^2 + |dx| + |dy| + 1/2, and |dx| + |dy| is between d and sqrt(2) d.
    const double d = std::sqrt(static_cast<double>(d2_[i]));
    if (d2_[i] == 0 || d * d + std::numbers::sqrt2 * d + 0.5 <= radius2_) return false;
    if (d * d + d + 0.5 > radius2_) return true;
    const auto cells = cells_inside_disc(grid_, grid_.center(grid_.cell_at(i)), radius_m_);
    return std::all_of(cells.begin(), cells.end(), [&](std::uint32_t c) { return taken_[c] == 0; });
  }

 private:
  const Grid& grid_;
  double radius_m_;
  double radius2_;
  std::vector<std::uint8_t> taken_;
  std::vector<std::int32_t> d2_;
};

ConnectedParts free_parts(const Grid& grid, const std::vector<Region>& region) {
  std::vector<std::uint8_t> free(grid.size());
  for (std::size_t i = 0; i < free.size(); ++i) free[i] = region[i] == Region::free ? 1 : 0;
  return connected_parts(free, grid.nx, grid.ny);
}

/// For each part the cell, best by `is_better`, around which a goal fits; grid.size() where none
/// does.
template <typename IsBetter>
std::vector<std::size_t> best_of_parts(const Grid& grid, const ConnectedParts& parts,
                                       const FreeDiscs& discs, const IsBetter& is_better) {
  std::vector<std::size_t> best(parts.cells.size(), grid.size());
  for (std::size_t i = 0; i < grid.size(); ++i) {
    if (parts.part[i] == no_part) continue;
    std::size_t& best_here = best[parts.part[i]];
    if ((best_here == grid.size() || is_better(i, best_here)) && discs.about(i)) best_here = i;
  }
  return best;
}

GoalPlace place_of(const Grid& grid, const ConnectedParts& parts, std::size_t i, int decimals) {
  std::size_t free_cells = 0;
  for (const std::size_t n : parts.cells) free_cells += n;
  return {rounded(grid.center(grid.cell_at(i)), decimals), decimals,
          static_cast<double>(parts.cells[parts.part[i]]) / static_cast<double>(free_cells)};
}

/// A disc of this radius contains the cell at its centre.
bool holds_a_cell(const Grid& grid, double radius_m) {
  return radius_m >= std::numbers::sqrt2 / 2.0 * grid.cell_m;
}

/// The best cell of the largest part that a goal fits in; grid.size(): none fits.
std::size_t in_largest_part(const Grid& grid, const ConnectedParts& parts,
                            const std::vector<std::size_t>& best) {
  std::size_t largest = grid.size();
  for (const std::size_t i : best) {
    if (i == grid.size()) continue;
    if (largest == grid.size() || parts.cells[parts.part[i]] > parts.cells[parts.part[largest]])
      largest = i;
  }
  return largest;
}

// With room for rounding; where no place has that, the exact places, in all their digits.
template <typename Take>
void for_places(const Grid& grid, const std::vector<Region>& region, double radius_m,
                const Take& take) {
  const int decimals = decimals_for(grid);
  if (!holds_a_cell(grid, radius_m - moved_m(decimals))) return;
  if (take(FreeDiscs(grid, region, radius_m + moved_m(decimals)), decimals)) return;
  constexpr int exact = 9;
  take(FreeDiscs(grid, region, radius_m + moved_m(exact)), exact);
}

/// What fits around one place: the clearances of the cells in a disc around it.
class Room {
 public:
  Room(const Clearances& clearances, Vec2 place_m, int decimals)
      : clearances_(clearances), place_m_(place_m), moved_m_(moved_m(decimals)) {}

  [[nodiscard]] bool fits(const Vehicle& vehicle, double alpha, double beta) const {
    const double limit =
        buffer_limit(clearances_.grid, clearances_.metric, alpha * vehicle.turn_radius_m);
    const double radius_m = beta * vehicle.turn_radius_m;
    if (vehicle.turn_radius_m <= clearances_.grid.cell_m ||
        !holds_a_cell(clearances_.grid, radius_m - 2.0 * moved_m_))
      return false;
    const auto cells = cells_inside_disc(clearances_.grid, place_m_, radius_m + moved_m_);
    return std::all_of(cells.begin(), cells.end(),
                       [&](std::uint32_t c) { return clearances_.measure[c] > limit; });
  }

  /// About the largest value below `above` that `fits`, rounded to three digits that also fit.
  template <typename Fits>
  [[nodiscard]] static std::optional<double> largest(double above, const Fits& fits) {
    // The values that fit form an interval that need not begin at 0: search from above, then
    // refine.
    double high = above;
    double low = 0.9 * above;
    for (int steps = 0; !fits(low); ++steps) {
      if (steps == 80) return std::nullopt;
      high = std::exchange(low, 0.9 * low);
    }
    for (int halvings = 0; halvings < 30; ++halvings) {
      const double middle = (low + high) / 2.0;
      (fits(middle) ? low : high) = middle;
    }
    const double told = rounded_down(low, 3);
    return fits(told) ? std::optional(told) : std::nullopt;
  }

 private:
  const Clearances& clearances_;
  Vec2 place_m_;
  double moved_m_;
};

std::optional<GoalRoom> room_on(const ObstacleMap& map, const Vehicle& vehicle,
                                const FieldOptions& options) {
  const Clearances all = clearances(map, options.metric);
  const auto widest = std::max_element(all.measure.begin(), all.measure.end());
  if (*widest == 0) return std::nullopt;
  const auto index = static_cast<std::size_t>(widest - all.measure.begin());
  GoalRoom room;
  room.decimals = decimals_for(map.grid);
  room.place_m = rounded(map.grid.center(map.grid.cell_at(index)), room.decimals);
  room.clearance_m = all.clearance_m(index);
  const Room about(all, room.place_m, room.decimals);
  const Vehicle v = vehicle;
  room.turn_radius_m = Room::largest(v.turn_radius_m, [&](double r) {
    return about.fits({v.speed_mps, r}, options.alpha, options.beta);
  });
  room.alpha = Room::largest(options.alpha,
                             [&](double alpha) { return about.fits(v, alpha, options.beta); });
  room.beta =
      Room::largest(options.beta, [&](double beta) { return about.fits(v, options.alpha, beta); });
  return room;
}

std::string served(const GoalPlace& goal) {
  return fmt::format("serves {} of the free cells", whole_percent_text(goal.serves));
}

std::string words_of(const GoalRoom& room, const PlaceText& place) {
  std::string would_do;
  const auto add = [&](const char* key, const std::optional<double>& value) {
    if (value)
      would_do += fmt::format("{}{} = {:.3g}", would_do.empty() ? "" : ", or ", key, *value);
  };
  add("turn_radius_m", room.turn_radius_m);
  add("alpha", room.alpha);
  add("beta", room.beta);
  return fmt::format(
      "no such goal fits on this map: the widest place is {}, {} m from the nearest "
      "obstacle, {}",
      place(room.place_m, room.decimals), length_text(room.clearance_m),
      would_do.empty()
          ? "and changing turn_radius_m, alpha or beta alone would not make one fit there: reduce "
            "cell_m too"
          : "where one would fit with " + would_do);
}

}  // namespace

GoalAdvice goal_advice(const ObstacleMap& map, const std::vector<Region>& region, Vec2 goal_m,
                       const Vehicle& vehicle, const FieldOptions& options) {
  const Grid& grid = map.grid;
  const ConnectedParts parts = free_parts(grid, region);
  const auto distance2 = [&](std::size_t i) {
    return norm2(grid.center(grid.cell_at(i)) - goal_m);
  };
  GoalAdvice advice;
  for_places(grid, region, options.beta * vehicle.turn_radius_m,
             [&](const FreeDiscs& discs, int decimals) {
               const auto best = best_of_parts(
                   grid, parts, discs,
                   [&](std::size_t a, std::size_t b) { return distance2(a) < distance2(b); });
               std::size_t nearest = grid.size();
               for (const std::size_t i : best) {
                 if (i == grid.size()) continue;
                 if (nearest == grid.size() || distance2(i) < distance2(nearest)) nearest = i;
               }
               if (nearest == grid.size()) return false;
               advice.nearest = place_of(grid, parts, nearest, decimals);
               advice.in_largest_part =
                   place_of(grid, parts, in_largest_part(grid, parts, best), decimals);
               return true;
             });
  if (!advice.nearest) advice.room = room_on(map, vehicle, options);
  return advice;
}

std::optional<GoalPlace> roomiest_goal(const ObstacleMap& map, const std::vector<Region>& region,
                                       const Vehicle& vehicle, const FieldOptions& options) {
  const Grid& grid = map.grid;
  const ConnectedParts parts = free_parts(grid, region);
  const Clearances all = clearances(map, options.metric);
  std::optional<GoalPlace> found;
  for_places(grid, region, options.beta * vehicle.turn_radius_m,
             [&](const FreeDiscs& discs, int decimals) {
               const auto best = best_of_parts(
                   grid, parts, discs,
                   [&](std::size_t a, std::size_t b) { return all.measure[a] > all.measure[b]; });
               const std::size_t i = in_largest_part(grid, parts, best);
               if (i != grid.size()) found = place_of(grid, parts, i, decimals);
               return found.has_value();
             });
  return found;
}

std::string metres_text(Vec2 place_m, int decimals) {
  return fmt::format("[{}, {}]", decimal_text(place_m.x, decimals),
                     decimal_text(place_m.y, decimals));
}

std::string words(const GoalAdvice& advice, const PlaceText& place) {
  if (!advice.nearest) {
    return advice.room ? words_of(*advice.room, place)
                       : "no cell of this map is free, whatever alpha, beta or turn_radius_m";
  }
  const GoalPlace& nearest = *advice.nearest;
  const GoalPlace& other = *advice.in_largest_part;
  std::string text = fmt::format("the nearest goal that fits is {}; it {}",
                                 place(nearest.place_m, nearest.decimals), served(nearest));
  if (!(other.place_m == nearest.place_m)) {
    text += fmt::format("; in the largest part of them the nearest is {}; it {}",
                        place(other.place_m, other.decimals), served(other));
  }
  return text;
}

}  // namespace fairway
