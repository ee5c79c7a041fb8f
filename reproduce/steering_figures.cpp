#include "reproduce/steering_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "fairway/base/parallel.hpp"
#include "fairway/report/canvas.hpp"
#include "fairway/report/draw_chart.hpp"
#include "fairway/report/legend.hpp"
#include "fairway/report/plot_frame.hpp"

namespace fairway::reproduce {
namespace {

const State goal{{0.0, 0.0}, Heading::from_rad(pi / 2)};
constexpr double reach = 6.0;         // of the study and its maps, radii
constexpr double same_length = 0.05;  // a flight ends within 0.02 of the goal, a step at a time

struct Outcome {
  bool converged;
  double length;
  double shortest;
};

Outcome outcome_of(const State& start, Repulsion repulsion) {
  ClfLaw law({16, repulsion});
  const SteeringFlight flight = fly(law, start, goal, 1.0, steering_options(start, goal, 1.0));
  return {flight.converged, flight.length_m, shortest_length_m(start, goal, 1.0)};
}

/// Starts off the lines where paths tie.
State start_at(int ix, int iy, int k, int per_side, int headings) {
  const auto at = [&](int i) { return reach * (2.0 * (i + 0.5) / per_side - 1.0); };
  return {{at(ix), at(iy)}, Heading::from_rad(two_pi * (k + 0.5) / headings)};
}

const char* name_of(Repulsion repulsion) {
  switch (repulsion) {
    case Repulsion::none:
      return "attraction alone";
    case Repulsion::overlap:
      return "repulsion where circles overlap";
    case Repulsion::overlap_behind:
      return "repulsion where they overlap behind the goal";
  }
  return "";
}

/// The shortest is white, then the deeper the longer; grey where it does not converge.
Color color_of(const Outcome& outcome) {
  if (!outcome.converged) return palette::faint_ink;
  if (outcome.length <= outcome.shortest + same_length) return palette::white;
  return cost_ramp(std::clamp(0.15 + 0.85 * (outcome.length / outcome.shortest - 1.0), 0.0, 1.0));
}

void draw_pose(Canvas& canvas, const PlotFrame& frame, const State& s, const Color& color) {
  const Vec2 u = s.heading.unit();
  const Pen pen{color, 1.4, {}};
  const Vec2 tip = s.position_m + 0.5 * u;
  canvas.stroke(DrawingPath::polyline({frame.to_page(s.position_m), frame.to_page(tip)}), pen);
  const Vec2 back = tip - 0.16 * u;
  canvas.stroke(DrawingPath::polyline({frame.to_page(back + 0.1 * left_of(u)), frame.to_page(tip),
                                       frame.to_page(back - 0.1 * left_of(u))}),
                pen);
}

void draw_circles(Canvas& canvas, const PlotFrame& frame, const State& s, const Color& color) {
  const AccommodationCircles circles = accommodation_circles(s, 1.0);
  const double radius_pt = frame.rect.width / (frame.x.high - frame.x.low);
  for (const Vec2 c : {circles.left_m, circles.right_m}) {
    canvas.stroke(DrawingPath::circle(frame.to_page(c), radius_pt), {color, 0.6, {3.0, 2.0}});
  }
}

/// A flight in a square frame that holds all of it.
void draw_flight(Canvas& canvas, const Rect& rect, const SteeringExample& example) {
  Vec2 low{-1.4, -1.4};
  Vec2 high{1.4, 1.4};
  for (const State& s : example.flight.track) {
    low = {std::min(low.x, s.position_m.x - 0.6), std::min(low.y, s.position_m.y - 0.6)};
    high = {std::max(high.x, s.position_m.x + 0.6), std::max(high.y, s.position_m.y + 0.6)};
  }
  const double half = 0.5 * std::max(high.x - low.x, high.y - low.y);
  const Vec2 middle = 0.5 * (low + high);
  const PlotFrame frame{rect,
                        {middle.x - half, middle.x + half, "x / r", 5},
                        {middle.y - half, middle.y + half, "y / r", 5}};
  draw_axes(canvas, frame, true);
  const auto layer = canvas.layer("flight " + example.figure, rect);
  draw_circles(canvas, frame, goal, series_color(1));
  draw_circles(canvas, frame, example.start, palette::faint_ink);
  std::vector<Vec2> points;
  for (const State& s : example.flight.track) points.push_back(frame.to_page(s.position_m));
  canvas.stroke(DrawingPath::polyline(points), {series_color(0), 1.8, {}});
  draw_pose(canvas, frame, example.start, palette::ink);
  draw_pose(canvas, frame, goal, series_color(1));
}

std::string title_of(const SteeringExample& e) {
  return fmt::format("{}: {}, {:.2f} r (shortest {} {:.2f} r)", e.figure, e.flight.word,
                     e.flight.length_m, fairway::name_of(e.shortest.word), e.shortest.length_m());
}

Picture draw_example(const SteeringExample& example) {
  const std::string title = title_of(example);
  Canvas canvas(380.0, 380.0, 2.0, title);
  canvas.text(title, {14.0, 20.0}, {.size_pt = 11.0, .bold = true});
  draw_flight(canvas, {52.0, 34.0, 300.0, 300.0}, example);
  return canvas.finish();
}

Picture draw_four(const std::vector<SteeringExample>& examples) {
  Canvas canvas(740.0, 760.0, 2.0, "Fig. 7: four types of path");
  for (std::size_t i = 0; i < 4; ++i) {
    const double x = 52.0 + 360.0 * static_cast<double>(i % 2);
    const double y = 34.0 + 374.0 * static_cast<double>(i / 2);
    canvas.text(title_of(examples[i]), {x, y - 10.0}, {.size_pt = 9.5, .bold = true});
    draw_flight(canvas, {x, y, 300.0, 300.0}, examples[i]);
  }
  return canvas.finish();
}

/// V and its parts along a flight, flown again with the law that has a memory.
Picture draw_values(const SteeringExample& example) {
  ClfLaw law;
  ChartSeries v{"V (Eq. 20)", {}, {}, {}};
  ChartSeries attract{"V_A (Eq. 9)", {}, {}, {}};
  ChartSeries repel{"V_R (Eq. 17)", {}, {}, {}};
  for (std::size_t i = 0; i < example.flight.track.size(); ++i) {
    const State& s = example.flight.track[i];
    const double t = 0.01 * static_cast<double>(i);
    const ClfValue value = law.value(s, goal, 1.0);
    const bool repels = value.repels_left || value.repels_right;
    for (const auto& [series, y] : {std::pair{&v, value.v}, std::pair{&attract, value.v_attract},
                                    std::pair{&repel, repels ? value.v_repel : std::nan("")}}) {
      series->x.push_back(t);
      series->y.push_back(y);
    }
    static_cast<void>(law.curvature_per_m(s, goal, 1.0, 0.01));
  }
  std::vector<ChartSeries> series{v, attract};
  if (example.repelled) series.push_back(repel);
  return draw_chart(series, {.title = example.figure + ": V(t), n = 16",
                             .x_label = "driven / r",
                             .y_label = "V",
                             .y_from_zero = true});
}

/// Four headings, a map over (x, y) for each.
Picture draw_map(Repulsion repulsion) {
  constexpr int side = 120;
  Canvas canvas(760.0, 800.0, 2.0, "Length under the law over the shortest");
  canvas.text(fmt::format("Paper 3's law, {}", name_of(repulsion)), {52.0, 18.0},
              {.size_pt = 11.0, .bold = true});
  for (int k = 0; k < 4; ++k) {
    const double heading_deg = 90.0 * k;
    Raster raster{side, side, std::vector<Color>(side * side)};
    for_rows(side, [&](int begin, int end) {
      for (int iy = begin; iy < end; ++iy) {
        for (int ix = 0; ix < side; ++ix) {
          State start = start_at(ix, iy, 0, side, 1);
          start.heading = Heading::from_rad(heading_deg * pi / 180.0 + 1e-3);
          raster.pixels[static_cast<std::size_t>((side - 1 - iy) * side + ix)] =
              color_of(outcome_of(start, repulsion));
        }
      }
    });
    const PlotFrame frame{{52.0 + 360.0 * (k % 2), 44.0 + 370.0 * (k / 2), 300.0, 300.0},
                          {-reach, reach, "x / r", 6},
                          {-reach, reach, "y / r", 6}};
    canvas.image(raster, frame.rect);
    draw_axes(canvas, frame, false);
    canvas.text(fmt::format("start heading {:.0f}°", heading_deg),
                {frame.rect.x, frame.rect.y - 6.0}, {.size_pt = 9.0});
    draw_circles(canvas, frame, goal, palette::ink);
    draw_pose(canvas, frame, goal, palette::ink);
  }
  const auto sample = [](double ratio) { return color_of({true, ratio, 1.0 - same_length}); };
  double x = 52.0;
  for (const auto& [name, color] :
       {std::pair{"shortest", palette::white}, std::pair{"1.1 times the shortest", sample(1.1)},
        std::pair{"1.5 times", sample(1.5)}, std::pair{"twice and more", sample(2.0)}}) {
    draw_legend(canvas, {x, 782.0}, {area_entry(name, color)});
    x += 165.0;
  }
  return canvas.finish();
}

}  // namespace

std::vector<SteeringExample> steering_examples() {
  const std::array<std::pair<const char*, State>, 6> starts{
      {{"Fig. 5", {{-4.0, -4.0}, Heading::from_rad(0.0)}},
       {"Fig. 6", {{-0.65, -0.25}, Heading::from_rad(-92.5 * pi / 180.0)}},
       {"Fig. 7.1", {{1.0, -4.0}, Heading::from_rad(pi)}},
       {"Fig. 7.2", {{-3.0, -4.0}, Heading::from_rad(-0.5)}},
       {"Fig. 7.3", {{3.0, -1.0}, Heading::from_rad(0.0)}},
       {"Fig. 7.4", {{2.0, -4.0}, Heading::from_rad(0.0)}}}};
  std::vector<SteeringExample> examples;
  for (const auto& [figure, start] : starts) {
    ClfLaw law;
    const ClfValue value = law.value(start, goal, 1.0);
    examples.push_back({figure, start,
                        fly(law, start, goal, 1.0, steering_options(start, goal, 1.0), Track::all),
                        shortest_path(start, goal, 1.0), value.repels_left || value.repels_right});
  }
  return examples;
}

SteeringStudy study_of(Repulsion repulsion, int per_side, int headings) {
  const auto per_heading = static_cast<std::size_t>(per_side) * static_cast<std::size_t>(per_side);
  std::vector<Outcome> outcomes(per_heading * static_cast<std::size_t>(headings));
  const auto start_of = [&](std::size_t i) {
    const auto place = static_cast<int>(i % per_heading);
    return start_at(place % per_side, place / per_side, static_cast<int>(i / per_heading), per_side,
                    headings);
  };
  for_ranges(outcomes.size(), 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) outcomes[i] = outcome_of(start_of(i), repulsion);
  });
  SteeringStudy study;
  study.name = name_of(repulsion);
  study.repulsion = repulsion;
  study.starts = static_cast<int>(outcomes.size());
  int converged = 0;
  int shortest = 0;
  double ratios = 0.0;
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    const Outcome& o = outcomes[i];
    if (!o.converged) continue;
    ++converged;
    shortest += o.length <= o.shortest + same_length ? 1 : 0;
    const double ratio = o.length / o.shortest;
    ratios += ratio;
    // Next to the goal a ratio is meaningless: both lengths are within the tolerance.
    if (ratio > study.worst_ratio && o.shortest > 0.5) {
      study.worst_ratio = ratio;
      study.worst_start = start_of(i);
    }
  }
  study.converged = converged / static_cast<double>(study.starts);
  study.shortest = shortest / static_cast<double>(study.starts);
  study.mean_ratio = ratios / std::max(1, converged);
  return study;
}

SteeringFigures draw_steering() {
  SteeringFigures figures;
  figures.examples = steering_examples();
  const auto& e = figures.examples;
  figures.pictures["paper3-fig5a"] = draw_example(e[0]);
  figures.pictures["paper3-fig5b"] = draw_values(e[0]);
  figures.pictures["paper3-fig6a"] = draw_example(e[1]);
  figures.pictures["paper3-fig6bc"] = draw_values(e[1]);
  figures.pictures["paper3-fig7"] = draw_four({e.begin() + 2, e.end()});
  for (const auto& [repulsion, name] :
       {std::pair{Repulsion::none, "none"}, std::pair{Repulsion::overlap, "overlap"},
        std::pair{Repulsion::overlap_behind, "behind"}}) {
    figures.studies.push_back(study_of(repulsion, 48, 32));
    figures.pictures[fmt::format("steering-map-{}", name)] = draw_map(repulsion);
  }
  return figures;
}

std::string tables_of(const SteeringFigures& figures) {
  std::string text =
      "| figure | start (x, y, heading) | word | length | shortest | length |\n"
      "|---|---|---|---|---|---|\n";
  for (const SteeringExample& e : figures.examples) {
    text += fmt::format("| {} | {:g}, {:g}, {:.0f}° | {} | {:.2f} r | {} | {:.2f} r |\n", e.figure,
                        e.start.position_m.x, e.start.position_m.y,
                        e.start.heading.rad() * 180.0 / pi, e.flight.word, e.flight.length_m,
                        fairway::name_of(e.shortest.word), e.shortest.length_m());
  }
  text +=
      "\n| law | starts | converged | shortest | mean ratio | worst ratio | at |\n"
      "|---|---|---|---|---|---|---|\n";
  for (const SteeringStudy& s : figures.studies) {
    text += fmt::format(
        "| {} | {} | {:.2f} % | {:.2f} % | {:.3f} | {:.2f} | {:.2f}, {:.2f}, "
        "{:.0f}° |\n",
        s.name, s.starts, 100.0 * s.converged, 100.0 * s.shortest, s.mean_ratio, s.worst_ratio,
        s.worst_start.position_m.x, s.worst_start.position_m.y,
        s.worst_start.heading.rad() * 180.0 / pi);
  }
  return text;
}

}  // namespace fairway::reproduce
