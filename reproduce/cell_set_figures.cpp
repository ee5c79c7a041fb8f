#include "reproduce/cell_set_figures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "fairway/cellular/border_backward_set.hpp"
#include "fairway/cellular/border_forward_set.hpp"
#include "fairway/report/canvas.hpp"
#include "fairway/report/legend.hpp"
#include "fairway/report/plot_frame.hpp"
#include "reproduce/solid_view.hpp"

namespace fairway::reproduce {
namespace {

// d and r of paper 1's figures; paper 2 gives no numbers for its own.
constexpr double cell_m = 8.0;
constexpr double wide_radius_m = 20.0;
constexpr double tight_radius_m = 8.1;  // "close to the cell size": Fig. 8b
constexpr double deg = pi / 180.0;

Direction direction(double rad) { return Direction::of(Heading::from_rad(rad)); }

/// Ends of Theta of the top border in degrees, unwrapped about straight up.
struct Ends {
  double low_deg;
  double high_deg;
};
std::optional<Ends> ends_at(Vec2 p, const Direction& command, const CellShape& shape) {
  const HeadingSet set = backward_headings(p, command, shape, Side::top);
  if (set.empty()) return std::nullopt;
  const HeadingRange& range = set.ranges[0];
  const double middle = pi / 2 + std::remainder(range.middle_rad() - pi / 2, two_pi);
  return Ends{(middle - range.width_rad / 2) / deg, (middle + range.width_rad / 2) / deg};
}

/// Frame, ticks and names of the axes of a box of cell by cell by low .. high degrees.
void draw_box(Canvas& canvas, const SolidView& view, double low_deg, double high_deg) {
  const auto layer = canvas.layer("axes");
  const Pen pale{palette::faint_ink, 0.5, {}};
  const auto edge = [&](Vec3 a, Vec3 b) {
    canvas.stroke(DrawingPath::polyline({view.at(a), view.at(b)}), pale);
  };
  for (const double z : {0.0, 1.0}) {
    edge({0, 1, z}, {1, 1, z});
    edge({0, 0, z}, {0, 1, z});
  }
  edge({0, 0, 0}, {1, 0, 0});
  edge({1, 0, 0}, {1, 1, 0});
  for (const Vec2 p : {Vec2{0, 0}, Vec2{0, 1}, Vec2{1, 1}}) edge({p.x, p.y, 0}, {p.x, p.y, 1});
  for (int k = 0; k <= 4; ++k) {
    const double s = k / 4.0;
    canvas.text(fmt::format("{:g}", s * cell_m), view.at({s, 0, 0}) + Vec2{-2, 12},
                {.size_pt = 7.5, .anchor = Anchor::middle});
    canvas.text(fmt::format("{:g}", s * cell_m), view.at({1, s, 0}) + Vec2{6, 6}, {.size_pt = 7.5});
    canvas.text(fmt::format("{:.0f}°", low_deg + s * (high_deg - low_deg)),
                view.at({0, 0, s}) + Vec2{-5, 3}, {.size_pt = 7.5, .anchor = Anchor::end});
  }
  canvas.text("x (m)", view.at({0.5, 0, 0}) + Vec2{-14, 26}, {.anchor = Anchor::middle});
  canvas.text("y (m)", view.at({1, 0.5, 0}) + Vec2{26, 16});
  canvas.text("heading", view.at({0, 0, 0.5}) + Vec2{-34, 0},
              {.anchor = Anchor::middle, .upwards = true});
}

/// Both surfaces over the cell, seen from below the top border's far side.
Picture draw_surfaces(const std::string& title, double command_deg, const CellShape& shape,
                      double* unreachable) {
  constexpr int steps = 32;
  constexpr double low_deg = -90.0;
  constexpr double high_deg = 270.0;
  const Direction command = direction(command_deg * deg);
  const SolidView view{{60.0, 362.0}, {250.0, 60.0}, {150.0, -80.0}, {0.0, -240.0}};
  Canvas canvas(500.0, 472.0, 2.0, title);
  draw_box(canvas, view, low_deg, high_deg);
  SolidScene scene(view);
  const Color lower = color_of_oklch(0.62, 0.13, 250.0);
  const Color upper = color_of_oklch(0.74, 0.13, 60.0);
  int missing = 0;
  const auto inside = [&](int i) { return cell_m * (i + 1e-6) / (steps + 2e-6); };
  for (int i = 0; i < steps; ++i) {
    for (int j = 0; j < steps; ++j) {
      std::vector<Vec3> low;
      std::vector<Vec3> high;
      for (const auto& [di, dj] : {std::array{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
        const Vec2 p{inside(i + di), inside(j + dj)};
        const auto ends = ends_at(p, command, shape);
        if (!ends) break;
        const auto z = [&](double value) { return (value - low_deg) / (high_deg - low_deg); };
        low.push_back({p.x / cell_m, p.y / cell_m, z(ends->low_deg)});
        high.push_back({p.x / cell_m, p.y / cell_m, z(ends->high_deg)});
      }
      const Vec2 middle{cell_m * (i + 0.5) / steps, cell_m * (j + 0.5) / steps};
      missing += ends_at(middle, command, shape) ? 0 : 1;
      if (low.size() < 4) continue;
      const auto shaded = [](Color c) { return Color{c.red, c.green, c.blue, 0.85}; };
      scene.add_face(low, shaded(lower), Pen{palette::white, 0.3, {}});
      scene.add_face(high, shaded(upper), Pen{palette::white, 0.3, {}});
    }
  }
  {
    const auto layer = canvas.layer("surfaces");
    scene.draw(canvas);
  }
  if (unreachable != nullptr) *unreachable = missing / static_cast<double>(steps * steps);
  draw_legend(canvas, {390.0, 34.0}, {area_entry("Θ max", upper), area_entry("Θ min", lower)});
  canvas.text(title, {14.0, 20.0}, {.size_pt = 11.0, .bold = true});
  return canvas.finish();
}

/// A left or right arc that ends at `q` with `heading_rad`, flown back to the bottom.
std::vector<Vec2> arc_to(Vec2 q, double heading_rad, int turn, double r) {
  const double start_cosine = std::cos(heading_rad) + turn * q.y / r;
  const double start = std::acos(std::clamp(start_cosine, -1.0, 1.0));
  std::vector<Vec2> points;
  for (int k = 0; k <= 24; ++k) {
    const double h = heading_rad + (start - heading_rad) * k / 24.0;
    points.push_back({q.x + turn * r * (std::sin(h) - std::sin(heading_rad)),
                      q.y - turn * r * (std::cos(h) - std::cos(heading_rad))});
  }
  return points;
}

constexpr double opposite_rad = 20.0 * deg;  // theta_cp of Fig. 20: a left command

/// Fig. 20a: the paths that leave by one point of the right border, two sets of them.
Picture draw_two_sets(double y_m) {
  const CellShape shape{cell_m, wide_radius_m};
  const Direction command = direction(opposite_rad + pi);
  const Color left_color = series_color(0);
  const Color right_color = series_color(1);
  const PlotFrame frame{
      {50.0, 34.0, 300.0, 300.0}, {0.0, cell_m, "x (m)", 5}, {0.0, cell_m, "y (m)", 5}};
  Canvas canvas(520.0, 380.0, 2.0, "Two disjoint forward sets at one point");
  draw_axes(canvas, frame, false);
  const auto sets = forward_headings(Side::bottom, Side::right, y_m, command, shape);
  {
    const auto layer = canvas.layer("paths", frame.rect);
    for (const HeadingRange& range : sets) {
      // Right turns arrive heading further to the right than they began.
      const int turn = range.from_rad < 0.0 || &range != sets.begin() ? -1 : 1;
      for (int k = 0; k <= 8; ++k) {
        const double heading = range.from_rad + range.width_rad * k / 8.0;
        std::vector<Vec2> points = arc_to({cell_m, y_m}, heading, turn, wide_radius_m);
        for (Vec2& p : points) p = frame.to_page(p);
        canvas.stroke(DrawingPath::polyline(points),
                      {turn > 0 ? left_color : right_color, 0.9, {}});
      }
    }
    canvas.fill(DrawingPath::circle(frame.to_page({cell_m, y_m}), 3.0), palette::ink);
  }
  draw_legend(canvas, {364.0, 40.0},
              {line_entry("left turns", {left_color, 1.2, {}}),
               line_entry("right turns", {right_color, 1.2, {}})});
  canvas.text(
      fmt::format("Paths that leave at y = {:.2f} m, command {:.0f}°", y_m, command.rad / deg),
      {14.0, 20.0}, {.size_pt = 11.0, .bold = true});
  return canvas.finish();
}

/// Fig. 20b: Phi over the whole right border.
Picture draw_forward_set(double y_max_m, double y_shown_m) {
  const CellShape shape{cell_m, wide_radius_m};
  const Direction command = direction(opposite_rad + pi);
  const PlotFrame frame{{60.0, 34.0, 380.0, 300.0},
                        {0.0, cell_m, "y along the right border (m)", 6},
                        {-30.0, 90.0, "heading (degrees)", 6}};
  Canvas canvas(600.0, 380.0, 2.0, "Forward reachable set at the right border");
  const Color area = color_of_oklch(0.78, 0.09, 250.0);
  {
    const auto layer = canvas.layer("set", frame.rect);
    constexpr int columns = 760;
    constexpr int rows = 600;
    Raster raster{columns, rows, std::vector<Color>(columns * rows, palette::white)};
    for (int column = 0; column < columns; ++column) {
      const double y = cell_m * (column + 0.5) / columns;
      const HeadingSet set = forward_headings(Side::bottom, Side::right, y, command, shape);
      for (int row = 0; row < rows; ++row) {
        if (set.holds((90.0 - 120.0 * (row + 0.5) / rows) * deg))
          raster.pixels[static_cast<std::size_t>(row * columns + column)] = area;
      }
    }
    canvas.image(raster, frame.rect);
  }
  draw_axes(canvas, frame, true);
  const auto mark = [&](double y, const Pen& pen) {
    canvas.stroke(DrawingPath::polyline({frame.to_page({y, -30.0}), frame.to_page({y, 90.0})}),
                  pen);
  };
  const Pen limit{palette::ink, 0.9, {4.0, 2.0}};
  const Pen shown{series_color(1), 0.9, {1.5, 1.8}};
  {
    const auto layer = canvas.layer("marks", frame.rect);
    mark(y_max_m, limit);
    mark(y_shown_m, shown);
  }
  draw_legend(canvas, {452.0, 40.0},
              {area_entry("Φ, bottom to right", area), line_entry("y max, Eq. 16", limit),
               line_entry("point of (a)", shown)});
  canvas.text(fmt::format("Forward reachable set, command {:.0f}°", command.rad / deg),
              {14.0, 20.0}, {.size_pt = 11.0, .bold = true});
  return canvas.finish();
}

}  // namespace

CellSetFigures draw_cell_sets() {
  CellSetFigures out;
  const CellShape wide{cell_m, wide_radius_m};
  out.pictures["paper2-fig6"] =
      draw_surfaces("Forward command 60°, d = 8 m, r = 20 m", 60.0, wide, nullptr);
  out.pictures["paper2-fig8a"] =
      draw_surfaces("Backward command -80°, d = 8 m, r = 20 m", -80.0, wide, &out.unreachable_8a);
  out.pictures["paper2-fig8b"] = draw_surfaces("Backward command -80°, d = 8 m, r = 8.1 m", -80.0,
                                               {cell_m, tight_radius_m}, &out.unreachable_8b);
  out.y_max_m = wide_radius_m * (1.0 + std::sin(opposite_rad - pi / 2));  // Eq. 16
  const double shown_m = 0.75 * out.y_max_m;
  out.pictures["paper2-fig20a"] = draw_two_sets(shown_m);
  out.pictures["paper2-fig20b"] = draw_forward_set(out.y_max_m, shown_m);
  return out;
}

}  // namespace fairway::reproduce
