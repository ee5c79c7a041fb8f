#include "reproduce/expansion_figures.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "fairway/bitmap/bitmap_backward.hpp"
#include "fairway/bitmap/bitmap_expansion.hpp"
#include "fairway/bitmap/bitmap_row.hpp"
#include "fairway/bitmap/bitmap_volume.hpp"
#include "fairway/cellular/border_backward_set.hpp"
#include "fairway/cellular/border_forward_set.hpp"
#include "fairway/field/compute_field.hpp"
#include "fairway/plan/plan_of_field.hpp"
#include "fairway/report/canvas.hpp"
#include "fairway/report/legend.hpp"
#include "fairway/report/plot_frame.hpp"
#include "fairway/verify/region_of_interest.hpp"
#include "reproduce/solid_view.hpp"

namespace fairway::reproduce {
namespace {

constexpr double cell_m = 8.0;  // paper 1's numbers; paper 2 gives none but n and m
constexpr double radius_m = 20.0;
constexpr int cells_per_side = 20;
constexpr int samples_per_border = 200;
constexpr double deg = pi / 180.0;
/// Of cells (4,4), (3,4), (2,4) of Fig. 21: forward commands.
constexpr std::array<double, 3> commands_deg{115.0, 65.0, 100.0};

Direction direction(double rad) { return Direction::of(Heading::from_rad(rad)); }

/// One border's samples, [heading][position].
using BorderSet = std::vector<std::uint8_t>;

double share_of(const BorderSet& set) {
  return static_cast<double>(std::count(set.begin(), set.end(), 1)) /
         static_cast<double>(set.size());
}

/// The samples of a cell's bottom that leave by its top within `top` (paper 2, section V.A).
BorderSet below(const BitmapSamples& samples, const BorderSet& top, double command_rad) {
  const int m = samples.count();
  const BitmapCommand command = BitmapCommand::of(direction(command_rad), samples);
  BorderSet set(top.size());
  for (int k = 0; k < m / 2; ++k) {
    const BitmapRow row(samples, command, radius_m / cell_m, Side::bottom, k);
    for (int i = 0; i < m; ++i) {
      const BitmapExit exit = row.exit(samples, i);
      if (exit.side != Side::top) continue;
      set[static_cast<std::size_t>(k * m + i)] =
          top[static_cast<std::size_t>(exit.heading * m + exit.position)];
    }
  }
  return set;
}

std::vector<BorderSet> expand_downwards(const BitmapSamples& samples) {
  const auto m = static_cast<std::size_t>(samples.count());
  std::vector<BorderSet> sets{BorderSet(m * m, 1)};
  for (const double command : commands_deg)
    sets.push_back(below(samples, sets.back(), command * deg));
  return sets;
}

const Color blue = color_of_oklch(0.72, 0.12, 250.0);

/// Fig. 21b: the four borders one behind the other, position by heading.
Picture draw_panels(const BitmapSamples& samples, const std::vector<BorderSet>& sets) {
  const int m = samples.count();
  const SolidView view{{60.0, 470.0}, {170.0, 40.0}, {270.0, -130.0}, {0.0, -300.0}};
  Canvas canvas(560.0, 540.0, 2.0, "Backward expansion in one direction");
  for (std::size_t s = 0; s < sets.size(); ++s) {  // from far to near
    const auto layer = canvas.layer(fmt::format("border-{}", s + 1));
    const double y = 1.0 - static_cast<double>(s) / 3.0;
    SolidScene scene(view);
    scene.add_face({{0, y, 0}, {1, y, 0}, {1, y, 1}, {0, y, 1}}, {255, 255, 255, 0.5},
                   Pen{palette::faint_ink, 0.6, {}});
    scene.draw(canvas);
    for (int k = 0; k < m; k += 2) {  // runs of two rows of samples
      for (int begin = 0; begin < m;) {
        const auto on = [&](int i) { return sets[s][static_cast<std::size_t>(k * m + i)] != 0; };
        int end = begin + 1;
        while (end < m && on(end) == on(begin)) ++end;
        if (on(begin)) {
          const double x0 = begin / static_cast<double>(m);
          const double x1 = end / static_cast<double>(m);
          const double z0 = k / static_cast<double>(m);
          const double z1 = (k + 2) / static_cast<double>(m);
          scene.add_face({{x0, y, z0}, {x1, y, z0}, {x1, y, z1}, {x0, y, z1}},
                         {blue.red, blue.green, blue.blue, 0.9});
        }
        begin = end;
      }
    }
    scene.draw(canvas);
  }
  for (std::size_t s = 0; s < sets.size(); ++s) {
    const double y = 1.0 - static_cast<double>(s) / 3.0;
    canvas.text(fmt::format("S{}", s + 1), view.at({1, y, 0}) + Vec2{5, 3}, {.bold = true});
  }
  for (const int degrees : {0, 90, 180, 270, 360})
    canvas.text(fmt::format("{}°", degrees), view.at({0, 0, degrees / 360.0}) + Vec2{-5, 3},
                {.size_pt = 7.5, .anchor = Anchor::end});
  canvas.text("heading", view.at({0, 0, 0.5}) + Vec2{-34, 0},
              {.anchor = Anchor::middle, .upwards = true});
  canvas.text("x (0 to 8 m)", view.at({0.5, 0, 0}) + Vec2{-10, 18}, {.anchor = Anchor::middle});
  canvas.text("y", view.at({1, 0.5, 0}) + Vec2{26, 14});
  canvas.text("Backward expansion downwards, one border per cell", {14.0, 20.0},
              {.size_pt = 11.0, .bold = true});
  return canvas.finish();
}

struct Curve {
  std::string name;
  Color color;
  std::vector<HeadingSet> sets;  ///< evenly spaced along x
};

/// A border's samples that enter upwards as an area, and the ends of sets of headings as curves.
Picture draw_border(const std::string& title, const BitmapSamples& samples, const BorderSet& set,
                    const std::string& set_name, const Curve& curve, const BorderSet* parts,
                    const std::string& parts_name) {
  const int m = samples.count();
  const PlotFrame frame{
      {60.0, 34.0, 340.0, 300.0}, {0.0, cell_m, "x (m)", 5}, {0.0, 180.0, "heading (degrees)", 7}};
  Canvas canvas(600.0, 380.0, 2.0, title);
  const Color strong = color_of_oklch(0.62, 0.14, 250.0);
  {
    const auto layer = canvas.layer("set", frame.rect);
    Raster raster{m, m / 2, {}};
    for (int k = m / 2 - 1; k >= 0; --k) {
      for (int i = 0; i < m; ++i) {
        const auto at = static_cast<std::size_t>(k * m + i);
        const bool part = parts != nullptr && (*parts)[at] != 0;
        raster.pixels.push_back(part ? strong : set[at] != 0 ? blue : palette::white);
      }
    }
    canvas.image(raster, frame.rect);
  }
  draw_axes(canvas, frame, false);
  const Pen pen{curve.color, 1.4, {}};
  {
    const auto layer = canvas.layer("limits", frame.rect);
    for (const bool upper : {false, true}) {
      std::vector<Vec2> points;
      for (std::size_t k = 0; k < curve.sets.size(); ++k) {
        const double x =
            cell_m * (static_cast<double>(k) + 0.5) / static_cast<double>(curve.sets.size());
        double low = INFINITY;
        double high = -INFINITY;
        for (const HeadingRange& range : curve.sets[k]) {
          low = std::min(low, range.from_rad / deg);
          high = std::max(high, range.to_rad() / deg);
        }
        if (low <= high) points.push_back(frame.to_page({x, upper ? high : low}));
      }
      canvas.stroke(DrawingPath::polyline(points), pen);
    }
  }
  std::vector<LegendEntry> entries{area_entry(set_name, blue)};
  if (parts != nullptr) entries.push_back(area_entry(parts_name, strong));
  entries.push_back(line_entry(curve.name, pen));
  draw_legend(canvas, {412.0, 40.0}, entries);
  canvas.text(title, {14.0, 20.0}, {.size_pt = 11.0, .bold = true});
  return canvas.finish();
}

void draw_column(ExpansionFigures& out) {
  const BitmapSamples samples(samples_per_border);
  const auto sets = expand_downwards(samples);
  for (std::size_t s = 0; s < 4; ++s) out.border_shares[s] = share_of(sets[s]);
  out.pictures["paper2-fig21b"] = draw_panels(samples, sets);

  // Cell (3,4): S2 on its top, S3 on its bottom.
  const Direction command = direction(commands_deg[1] * deg);
  const CellShape shape{cell_m, radius_m};
  Curve forward{"Φ, bottom to top", color_of_oklch(0.55, 0.2, 27.0), {}};
  Curve backward{"Θ, bottom to top", color_of_oklch(0.6, 0.17, 145.0), {}};
  constexpr int points = 400;
  for (int k = 0; k < points; ++k) {
    const double x = cell_m * (k + 0.5) / points;
    forward.sets.push_back(forward_headings(Side::bottom, Side::top, x, command, shape));
    backward.sets.push_back(
        backward_headings_on_border(Side::bottom, x, command, shape, Side::top));
  }
  const std::size_t m = static_cast<std::size_t>(samples.count());
  BorderSet met(m * m);  // S2 between the red curves
  for (std::size_t k = 0; k < m; ++k) {
    for (std::size_t i = 0; i < m; ++i) {
      const double x = cell_m * samples.position(static_cast<int>(i));
      const double h = (static_cast<double>(k) + 0.5) * two_pi / static_cast<double>(m);
      met[k * m + i] = sets[1][k * m + i] != 0 &&
                               forward_headings(Side::bottom, Side::top, x, command, shape).holds(h)
                           ? 1
                           : 0;
    }
  }
  out.pictures["paper2-fig22a"] =
      draw_border("Top of cell (3,4)", samples, sets[1], "S2, reaches the region", forward, &met,
                  "S2 met by Φ");
  out.pictures["paper2-fig22b"] = draw_border("Bottom of cell (3,4)", samples, sets[2],
                                              "S3, reaches S2", backward, nullptr, "");
}

/// Towards a goal off the centre of 20 by 20 free cells.
Plan plan_of_figure_23() {
  ObstacleMap map;
  map.grid = {cells_per_side, cells_per_side, 0.0, 0.0, cell_m};
  map.obstacle.assign(map.grid.size(), 0);
  const Vehicle vehicle{10.0, radius_m};
  FieldOrRefusal answer = compute_field(map, vehicle, GoalMission{{64.0, 88.0}, {}}, {});
  if (const auto* refused = std::get_if<MissionRefusal>(&answer))
    throw std::runtime_error(refused->message);
  return plan_of_field(std::move(std::get<Field>(answer)), vehicle);
}

/// Fig. 23a: layers of equal heading over the workspace, lifted apart.
Picture draw_layers(const Plan& plan, const BitmapLookup& lookup) {
  constexpr int layers = 6;
  constexpr int steps = 120;
  const SolidView view{{52.0, 800.0}, {250.0, 55.0}, {170.0, -105.0}, {0.0, -650.0}};
  Canvas canvas(560.0, 890.0, 2.0, "Global backward reachable set");
  const Color goal = color_of_oklch(0.6, 0.2, 27.0);
  for (int layer_number = 0; layer_number < layers; ++layer_number) {
    const double heading = layer_number * two_pi / layers;
    const double z = layer_number / static_cast<double>(layers - 1);
    const auto layer = canvas.layer(fmt::format("heading-{}", layer_number * 360 / layers));
    SolidScene scene(view);
    scene.add_face({{0, 0, z}, {1, 0, z}, {1, 1, z}, {0, 1, z}}, {255, 255, 255, 0.75});
    scene.draw(canvas);
    for (int row = 0; row < steps; ++row) {
      const auto kind = [&](int i) {
        const Vec2 p{plan.grid.width_m() * (i + 0.5) / steps,
                     plan.grid.height_m() * (row + 0.5) / steps};
        if (plan.region[plan.grid.index(plan.grid.cell_of(p))] == Region::goal) return 2;
        return lookup.reaches({p, Heading::from_rad(heading)}) ? 1 : 0;
      };
      for (int begin = 0; begin < steps;) {
        int end = begin + 1;
        while (end < steps && kind(end) == kind(begin)) ++end;
        if (kind(begin) != 0) {
          const double x0 = begin / static_cast<double>(steps);
          const double x1 = end / static_cast<double>(steps);
          const double y0 = row / static_cast<double>(steps) - 1e-6;
          const double y1 = (row + 1.02) / steps - 1e-6;  // no hairlines between rows
          const Color c = kind(begin) == 2 ? goal : blue;
          scene.add_face({{x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z}}, c);
        }
        begin = end;
      }
    }
    scene.draw(canvas);
    canvas.stroke(DrawingPath::polyline({view.at({0, 0, z}), view.at({1, 0, z}), view.at({1, 1, z}),
                                         view.at({0, 1, z}), view.at({0, 0, z})}),
                  {palette::faint_ink, 0.6, {}});
    canvas.text(fmt::format("{}°", layer_number * 360 / layers), view.at({0, 0, z}) + Vec2{-5, 3},
                {.anchor = Anchor::end});
  }
  canvas.text("x (0 to 160 m)", view.at({0.5, 0, 0}) + Vec2{-20, 20}, {.anchor = Anchor::middle});
  canvas.text("y (0 to 160 m)", view.at({1, 0.5, 0}) + Vec2{16, 14});
  canvas.text("heading", view.at({0, 0, 0.5}) + Vec2{-34, 0},
              {.anchor = Anchor::middle, .upwards = true});
  draw_legend(canvas, {420.0, 34.0},
              {area_entry("region of interest", goal), area_entry("reaches it", blue)});
  canvas.text("Global backward reachable set", {14.0, 20.0}, {.size_pt = 11.0, .bold = true});
  return canvas.finish();
}

/// Fig. 23b, with the two neighbours it leaves out: the border itself, through either cell.
Picture draw_neighbours() {
  const PlotFrame frame{{20.0, 40.0, 360.0, 200.0}, {-0.1, 2.1, "", 2}, {-0.1, 1.1, "", 2}};
  Canvas canvas(560.0, 260.0, 2.0, "Neighbours of a border");
  const Pen itself{palette::ink, 3.0, {}};
  const Pen six{series_color(0), 3.0, {}};
  const Pen hop{series_color(1), 1.6, {}};
  const auto line = [&](Vec2 a, Vec2 b, const Pen& pen) {
    canvas.stroke(DrawingPath::polyline({frame.to_page(a), frame.to_page(b)}), pen);
  };
  for (const double x : {0.0, 1.0}) {
    line({x + 0.03, 0}, {x + 0.97, 0}, six);
    line({x + 0.03, 1}, {x + 0.97, 1}, six);
    line({2 * x, 0.03}, {2 * x, 0.97}, six);
  }
  line({1, 0.03}, {1, 0.97}, itself);
  for (const double side : {-1.0, 1.0}) {
    std::vector<Vec2> points;
    for (int k = 0; k <= 20; ++k) {
      const double a = -pi / 3 + 2 * pi / 3 * k / 20.0;
      points.push_back(
          frame.to_page({1 + side * (std::cos(a) - 0.5) * 0.5, 0.5 + 0.5 * std::sin(a) * 0.8}));
    }
    canvas.stroke(DrawingPath::polyline(points), hop);
  }
  draw_legend(canvas, {392.0, 50.0},
              {line_entry("a border", itself), line_entry("the paper's six", six),
               line_entry("itself, through either cell", hop)});
  canvas.text("The eight neighbours of a border", {14.0, 20.0}, {.size_pt = 11.0, .bold = true});
  return canvas.finish();
}

}  // namespace

ExpansionFigures draw_expansion() {
  ExpansionFigures out;
  draw_column(out);
  const Plan plan = plan_of_figure_23();
  const auto target = target_cells(plan.grid, plan.region, {});
  const BorderBitmap set = backward_reachable_set(plan, target, {samples_per_border});
  out.states = set.borders().count() * set.states_per_border();
  out.stored_bytes = set.bytes();
  out.border_share = set.share_reached();
  out.volume_share = volume_share_reached(plan, target, set, 1'000'000).reached;
  const BitmapExpansion reference = expand_borders(plan, target, {samples_per_border});
  out.sweeps = reference.sweeps;
  out.algorithm_1_agrees = reference.set == set;
  out.pictures["paper2-fig23a"] = draw_layers(plan, BitmapLookup(plan, target, set));
  out.pictures["paper2-fig23b"] = draw_neighbours();
  return out;
}

}  // namespace fairway::reproduce
