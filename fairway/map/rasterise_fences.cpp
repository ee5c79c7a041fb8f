#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "fairway/base/error.hpp"
#include "fairway/base/parallel.hpp"
#include "fairway/map/keep_in_union.hpp"
#include "fairway/map/rasterise.hpp"
#include "fairway/map/world_frame.hpp"

namespace fairway {

namespace {

struct Bounds {
  double x_low = std::numeric_limits<double>::infinity();
  double x_high = -std::numeric_limits<double>::infinity();
  double y_low = std::numeric_limits<double>::infinity();
  double y_high = -std::numeric_limits<double>::infinity();

  void hold(Vec2 p, double radius_m = 0.0) {
    x_low = std::min(x_low, p.x - radius_m);
    x_high = std::max(x_high, p.x + radius_m);
    y_low = std::min(y_low, p.y - radius_m);
    y_high = std::max(y_high, p.y + radius_m);
  }
  void hold(const FencePolygon& polygon) {
    for (const auto& ring : polygon.rings_m)
      for (const Vec2 p : ring) hold(p);
  }
  void meet(const Bounds& other) {
    x_low = std::max(x_low, other.x_low);
    x_high = std::min(x_high, other.x_high);
    y_low = std::max(y_low, other.y_low);
    y_high = std::min(y_high, other.y_high);
  }
  bool holds_nothing() const { return !(x_low <= x_high && y_low <= y_high); }
  MapExtent extent() const { return {{x_low, y_low}, x_high - x_low, y_high - y_low}; }
};

std::string name_of_map(const FenceSet& fences) {
  return fences.inputs.empty() ? std::string("map") : fences.inputs.front().path;
}

// The box around the keep-in set; without one, around everything in the file, plus a margin.
MapExtent world_of(const FenceSet& fences, const RasteriseOptions& options, Inclusion inclusion,
                   std::optional<double> world_margin_m) {
  std::vector<Bounds> keep_in;
  for (const auto& polygon : fences.keep_in) keep_in.emplace_back().hold(polygon);
  for (const auto& circle : fences.keep_in_circles)
    keep_in.emplace_back().hold(circle.center_m, circle.radius_m);
  Bounds world;
  if (!keep_in.empty()) {
    world = keep_in.front();
    for (const Bounds& next : keep_in) {
      if (inclusion == Inclusion::all) {
        world.meet(next);
      } else {
        world.hold({next.x_low, next.y_low});
        world.hold({next.x_high, next.y_high});
      }
    }
    if (world.holds_nothing())
      throw InputError(name_of_map(fences), "the keep-in fences have no point in common");
    return world.extent();
  }
  for (const auto& polygon : fences.keep_out) world.hold(polygon);
  for (const auto& circle : fences.keep_out_circles) world.hold(circle.center_m, circle.radius_m);
  for (const Vec2 p : fences.places_m) world.hold(p);
  if (world.holds_nothing())
    throw InputError(name_of_map(fences), "has no fence, obstacle or mission item");
  const double longer_m = std::max(world.x_high - world.x_low, world.y_high - world.y_low);
  const double margin_m =
      options.growth_m + world_margin_m.value_or(std::max({0.1 * longer_m, 10.0 * options.cell_m,
                                                           options.least_world_margin_m}));
  world.hold({world.x_low - margin_m, world.y_low - margin_m});
  world.hold({world.x_high + margin_m, world.y_high + margin_m});
  return world.extent();
}

// A growing interval of x, empty at first.
struct Span {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  void hold(double x) {
    low = std::min(low, x);
    high = std::max(high, x);
  }
};

class FenceRasteriser {
 public:
  FenceRasteriser(const Grid& grid, double growth_m)
      : grid_(grid),
        cell_m_(grid.cell_m),
        origin_{grid.x0_m, grid.y0_m},
        radius_m_(growth_m + cell_slack * grid.cell_m),
        covered_(static_cast<std::size_t>(grid.ny) * row_length()) {}

  void keep_out(const FencePolygon& polygon) {
    near_edges(polygon);
    fill(polygon, true);
  }

  void keep_in(const FencePolygon& polygon) {
    near_edges(polygon);
    fill(polygon, false);
  }

  void keep_out(const FenceCircle& circle) {
    const Vec2 center = circle.center_m - origin_;
    const double reach_m = circle.radius_m + radius_m_;
    for_touched_rows(center.y - reach_m, center.y + reach_m, [&](int iy, double low, double high) {
      Span span;
      hold_disc(span, center, reach_m, low, high);
      cover_touched(iy, span);
    });
  }

  // A cell stays free when its farthest corner is closer than r - R.
  void keep_in(const FenceCircle& circle) {
    const Vec2 center = circle.center_m - origin_;
    const double reach_m = circle.radius_m - radius_m_;
    for (int iy = 0; iy < grid_.ny; ++iy) {
      const double away_m =
          std::max(std::abs(iy * cell_m_ - center.y), std::abs((iy + 1) * cell_m_ - center.y));
      if (away_m >= reach_m) {
        cover(iy, 0, grid_.nx);
        continue;
      }
      const double half_m = std::sqrt(reach_m * reach_m - away_m * away_m);
      const int first = column(std::floor((center.x - half_m) / cell_m_) + 1.0);
      const int last = column(std::ceil((center.x + half_m) / cell_m_) - 1.0);
      cover(iy, 0, first);
      cover(iy, std::max(first, last), grid_.nx);
    }
  }

  std::vector<std::uint8_t> cells() const {
    std::vector<std::uint8_t> result(grid_.size());
    for_rows(grid_.ny, [&](int begin, int end) {
      for (int iy = begin; iy < end; ++iy) {
        const int* steps = covered_.data() + static_cast<std::size_t>(iy) * row_length();
        std::uint8_t* out = result.data() + grid_.index({0, iy});
        int depth = 0;
        for (int ix = 0; ix < grid_.nx; ++ix) {
          depth += steps[ix];
          out[ix] = static_cast<std::uint8_t>(depth > 0);
        }
      }
    });
    return result;
  }

 private:
  std::size_t row_length() const { return static_cast<std::size_t>(grid_.nx) + 1; }

  int column(double x) const { return static_cast<int>(std::clamp(x, 0.0, double(grid_.nx))); }

  // Cells first .. last - 1 of a row; the rows are difference arrays.
  void cover(int iy, int first, int last) {
    if (first >= last) return;
    int* steps = covered_.data() + static_cast<std::size_t>(iy) * row_length();
    ++steps[first];
    --steps[last];
  }

  // The cells whose closed squares meet the closed interval.
  void cover_touched(int iy, const Span& span) {
    if (span.low > span.high) return;
    cover(iy, column(std::ceil(span.low / cell_m_) - 1.0),
          column(std::floor(span.high / cell_m_) + 1.0));
  }

  template <typename Visit>
  void for_touched_rows(double y_low, double y_high, const Visit& visit) {
    const double limit = grid_.ny;
    const int first = static_cast<int>(std::clamp(std::ceil(y_low / cell_m_) - 1.0, 0.0, limit));
    const int last = static_cast<int>(std::clamp(std::floor(y_high / cell_m_) + 1.0, 0.0, limit));
    for (int iy = first; iy < last; ++iy) visit(iy, iy * cell_m_, (iy + 1) * cell_m_);
  }

  static void hold_disc(Span& span, Vec2 center, double radius_m, double low, double high) {
    const double away_m = std::max({0.0, low - center.y, center.y - high});
    if (away_m > radius_m) return;
    const double half_m = std::sqrt(radius_m * radius_m - away_m * away_m);
    span.hold(center.x - half_m);
    span.hold(center.x + half_m);
  }

  static void hold_segment(Span& span, Vec2 a, Vec2 b, double low, double high) {
    if (a.y > b.y) std::swap(a, b);
    if (b.y < low || a.y > high) return;
    const double rise = b.y - a.y;
    const auto x_at = [&](double y) {
      return rise > 0.0 ? a.x + (y - a.y) / rise * (b.x - a.x) : a.x;
    };
    span.hold(a.y >= low ? a.x : x_at(low));
    span.hold(b.y <= high ? b.x : x_at(high));
  }

  // A segment grown by R is convex, so in each row of cells it meets one interval of x: two discs
  // and a rectangle between them.
  void near_edges(const FencePolygon& polygon) {
    for (const auto& ring : polygon.rings_m) {
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const Vec2 a = ring[i] - origin_;
        const Vec2 b = ring[(i + 1) % ring.size()] - origin_;
        const double length = norm(b - a);
        const Vec2 side = length > 0.0 ? (radius_m_ / length) * left_of(b - a) : Vec2{};
        for_touched_rows(std::min(a.y, b.y) - radius_m_, std::max(a.y, b.y) + radius_m_,
                         [&](int iy, double low, double high) {
                           Span span;
                           hold_disc(span, a, radius_m_, low, high);
                           hold_disc(span, b, radius_m_, low, high);
                           hold_segment(span, a + side, b + side, low, high);
                           hold_segment(span, a - side, b - side, low, high);
                           cover_touched(iy, span);
                         });
      }
    }
  }

  // Cells away from every edge are entirely inside or outside, as their centre shows.
  void fill(const FencePolygon& polygon, bool inside) {
    std::vector<std::vector<double>> crossings(static_cast<std::size_t>(grid_.ny));
    for (const auto& ring : polygon.rings_m)
      for (std::size_t i = 0; i < ring.size(); ++i)
        add_crossings(ring[i] - origin_, ring[(i + 1) % ring.size()] - origin_, crossings);
    for (int iy = 0; iy < grid_.ny; ++iy) {
      auto& xs = crossings[static_cast<std::size_t>(iy)];
      std::sort(xs.begin(), xs.end());
      int outside_from = 0;
      for (std::size_t i = 0; i + 1 < xs.size(); i += 2) {
        const int first = column(std::ceil(xs[i] / cell_m_ - 0.5));
        const int last = column(std::floor(xs[i + 1] / cell_m_ - 0.5) + 1.0);
        if (inside) {
          cover(iy, first, last);
        } else {
          cover(iy, outside_from, first);
          outside_from = std::max(outside_from, last);
        }
      }
      if (!inside) cover(iy, outside_from, grid_.nx);
    }
  }

  void add_crossings(Vec2 a, Vec2 b, std::vector<std::vector<double>>& crossings) const {
    if (a.y == b.y) return;
    if (a.y > b.y) std::swap(a, b);
    // Rows whose centre y satisfies a.y <= y < b.y.
    const double limit = grid_.ny;
    const auto from = static_cast<int>(std::clamp(std::ceil(a.y / cell_m_ - 0.5), 0.0, limit));
    const auto to = static_cast<int>(std::clamp(std::ceil(b.y / cell_m_ - 0.5), 0.0, limit));
    for (int iy = from; iy < to; ++iy) {
      const double y = (iy + 0.5) * cell_m_;
      crossings[static_cast<std::size_t>(iy)].push_back(a.x +
                                                        (y - a.y) / (b.y - a.y) * (b.x - a.x));
    }
  }

  const Grid& grid_;
  double cell_m_;
  Vec2 origin_;
  double radius_m_;
  std::vector<int> covered_;
};

}  // namespace

ObstacleMap rasterise(const FenceSet& fences, const RasteriseOptions& options, Inclusion inclusion,
                      std::optional<double> world_margin_m) {
  const MapExtent extent = world_of(fences, options, inclusion, world_margin_m);
  const Grid inner = grid_over(extent, options);
  FenceRasteriser rasteriser(inner, options.growth_m);
  for (const auto& polygon : fences.keep_out) rasteriser.keep_out(polygon);
  for (const auto& circle : fences.keep_out_circles) rasteriser.keep_out(circle);
  const std::size_t keep_ins = fences.keep_in.size() + fences.keep_in_circles.size();
  if (inclusion == Inclusion::any && keep_ins > 1) {
    rasteriser.keep_in(
        keep_in_union(fences.keep_in, fences.keep_in_circles, 1e-3 * options.cell_m));
  } else {
    for (const auto& polygon : fences.keep_in) rasteriser.keep_in(polygon);
    for (const auto& circle : fences.keep_in_circles) rasteriser.keep_in(circle);
  }
  ObstacleMap map;
  map.obstacle = rasteriser.cells();
  map.grid = close_world(inner, extent, options, map.obstacle);
  map.frame.geo = fences.geo;
  map.inputs = fences.inputs;
  map.warnings = fences.warnings;
  return map;
}

}  // namespace fairway
