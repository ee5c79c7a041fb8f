#include "fairway/report/draw_flights.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "fairway/base/error.hpp"
#include "fairway/report/flight_path.hpp"
#include "fairway/report/map_page.hpp"
#include "fairway/report/outcome_style.hpp"
#include "fairway/report/thinned_path.hpp"
#include "fairway/report/tube_outline.hpp"

namespace fairway {
namespace {

constexpr double start_dot_pt = 2.4;
constexpr double start_tick_pt = 9.0;

/// Rare outcomes are drawn last and strongest, so that they stand out among many flights.
constexpr std::array as_drawn{Outcome::reach, Outcome::hold, Outcome::leave, Outcome::collide,
                              Outcome::trapped};

/// One style with all flights that share it.
struct Bundle {
  std::string label;
  std::string layer;
  Pen pen;
  std::vector<const Flight*> flights;
};

/// Followed along a path, into an obstacle or off the grid: drawn like the outcome it ends with.
bool ended_after_reaching(const Flight& flight) {
  return flight.onward.after == After::collide || flight.onward.after == After::leave;
}

std::vector<Bundle> bundles_by_outcome(std::span<const Flight> flights) {
  std::vector<Bundle> bundles;
  const auto add = [&](const std::string& label, const std::string& layer, Outcome like,
                       const auto& belongs) {
    Bundle bundle{"", "flights-" + layer, style_of(like).pen, {}};
    for (const Flight& flight : flights)
      if (belongs(flight)) bundle.flights.push_back(&flight);
    if (bundle.flights.empty()) return;
    bundle.label = fmt::format("{} ({})", label, bundle.flights.size());
    bundles.push_back(std::move(bundle));
  };
  for (const Outcome outcome : as_drawn) {
    add(name_of(outcome), name_of(outcome), outcome, [&](const Flight& flight) {
      return flight.result.outcome == outcome && !ended_after_reaching(flight);
    });
  }
  for (const auto& [after, like] :
       {std::pair{After::leave, Outcome::leave}, std::pair{After::collide, Outcome::collide}}) {
    add(fmt::format("reach, then {}", name_of(after)), fmt::format("reach-{}", name_of(after)),
        like, [after = after](const Flight& flight) { return flight.onward.after == after; });
  }
  return bundles;
}

std::vector<Bundle> bundles_by_name(std::span<const Flight> flights,
                                    const std::vector<std::string>& names) {
  static const std::array<std::vector<double>, 3> dashes{
      {{}, {1.5, 1.8}, {5.0, 2.0}}};  // solid, dotted, dashed, as in the charts
  std::vector<Bundle> bundles;
  std::map<std::string, std::size_t> place;
  for (std::size_t i = 0; i < flights.size(); ++i) {
    const std::size_t k = place.try_emplace(names[i], bundles.size()).first->second;
    if (k == bundles.size())
      bundles.push_back({names[i],
                         fmt::format("flights-{}", k + 1),
                         {series_color(static_cast<int>(k)), 1.6, dashes[k % dashes.size()]},
                         {}});
    bundles[k].flights.push_back(&flights[i]);
  }
  return bundles;
}

void draw_bundle(MapPage& page, const Bundle& bundle, std::size_t share_of_drawn) {
  Canvas& canvas = page.canvas();
  const auto layer = canvas.layer(bundle.layer, page.frame().rect);
  Pen pen = bundle.pen;
  if (bundle.flights.size() > 60) pen.width_pt *= 0.6;
  const std::size_t count = std::min(bundle.flights.size(), share_of_drawn);
  for (std::size_t i = 0; i < count; ++i)
    canvas.stroke(thinned(flight_path(*bundle.flights[i], page.frame()), unseen_pt), pen);
  DrawingPath dots;
  DrawingPath ticks;
  const double dot_pt = bundle.flights.size() > 60 ? 0.6 * start_dot_pt : start_dot_pt;
  for (std::size_t i = 0; i < count; ++i) {
    const State& start = bundle.flights[i]->start;
    const Vec2 at = page.frame().to_page(start.position_m);
    const Vec2 along{start.heading.unit().x, -start.heading.unit().y};
    dots.move_to({at.x + dot_pt, at.y}).arc(at, dot_pt, 0.0, two_pi).close();
    ticks.move_to(at).line_to(at + dot_pt / start_dot_pt * start_tick_pt * along);
  }
  canvas.stroke(ticks, {pen.color, 1.2 * dot_pt / start_dot_pt, {}});
  canvas.fill(dots, pen.color);
}

/// Over the outcome's own line, so that both are seen.
const Pen further_pen{color_of_oklch(0.85, 0.16, 110.0), 1.2, {2.5, 2.5}};

bool flies_further(const FlightSegment& piece) { return piece.mode > 0; }

/// How many flights have pieces in further modes of the plan.
std::size_t flown_further(std::span<const Flight> flights) {
  return static_cast<std::size_t>(
      std::count_if(flights.begin(), flights.end(), [](const Flight& flight) {
        return std::any_of(flight.segments.begin(), flight.segments.end(), flies_further);
      }));
}

LegendEntry further_entry(std::size_t count, const Pen& below) {
  return {fmt::format("in a further mode ({})", count), [below](Canvas& canvas, const Rect& box) {
            DrawingPath line;
            line.move_to({box.x, box.y + 0.5 * box.height});
            line.line_to({box.x + box.width, box.y + 0.5 * box.height});
            canvas.stroke(line, below);
            canvas.stroke(line, further_pen);
          }};
}

/// The pieces in further modes of the flights that the bundle has drawn.
void draw_further(MapPage& page, const Bundle& bundle, std::size_t share_of_drawn) {
  Canvas& canvas = page.canvas();
  const auto layer = canvas.layer(bundle.layer + "-further-modes", page.frame().rect);
  Pen pen = further_pen;
  if (bundle.flights.size() > 60) pen.width_pt *= 0.6;
  for (std::size_t i = 0; i < std::min(bundle.flights.size(), share_of_drawn); ++i) {
    const std::span<const FlightSegment> pieces = bundle.flights[i]->segments;
    auto begin = std::find_if(pieces.begin(), pieces.end(), flies_further);
    while (begin != pieces.end()) {
      const auto end = std::find_if_not(begin, pieces.end(), flies_further);
      canvas.stroke(thinned(segments_path({begin, end}, page.frame()), unseen_pt), pen);
      begin = std::find_if(end, pieces.end(), flies_further);
    }
  }
}

/// The legs of one state.
struct LegBundle {
  FinalLegState state = FinalLegState::not_asked;
  std::size_t count = 0;
  Pen pen;
};

DrawingPath crossing_strokes(Vec2 at, double arm_pt) {
  DrawingPath path;
  path.move_to({at.x - arm_pt, at.y - arm_pt}).line_to({at.x + arm_pt, at.y + arm_pt});
  path.move_to({at.x - arm_pt, at.y + arm_pt}).line_to({at.x + arm_pt, at.y - arm_pt});
  return path;
}

constexpr double refused_arm_pt = 3.0;

std::vector<LegBundle> leg_bundles(std::span<const Flight> flights) {
  const Color color = color_of_oklch(0.45, 0.18, 310.0);
  std::vector<LegBundle> bundles{
      {FinalLegState::shortest, 0, {color, 1.3, {}}},
      {FinalLegState::other, 0, {color, 1.3, {4.0, 1.5}}},
      {FinalLegState::none_clear, 0, {color_of_oklch(0.58, 0.20, 40.0), 1.6, {}}}};
  for (LegBundle& bundle : bundles) {
    for (const Flight& flight : flights) {
      bundle.count += flight.final_leg.state == bundle.state ? 1 : 0;
    }
  }
  std::erase_if(bundles, [](const LegBundle& bundle) { return bundle.count == 0; });
  return bundles;
}

LegendEntry leg_entry(const LegBundle& bundle) {
  if (bundle.state == FinalLegState::none_clear) {
    return {fmt::format("no clear last leg ({})", bundle.count),
            [pen = bundle.pen](Canvas& canvas, const Rect& box) {
              const Vec2 middle{box.x + 0.5 * box.width, box.y + 0.5 * box.height};
              canvas.stroke(crossing_strokes(middle, refused_arm_pt), pen);
            }};
  }
  const bool shortest = bundle.state == FinalLegState::shortest;
  return line_entry(
      fmt::format("last leg, {} ({})", shortest ? "shortest" : "other path", bundle.count),
      bundle.pen);
}

void draw_legs(MapPage& page, const LegBundle& bundle, std::span<const Flight> flights,
               std::size_t most_drawn) {
  Canvas& canvas = page.canvas();
  const auto layer =
      canvas.layer(fmt::format("final-legs-{}", name_of(bundle.state)), page.frame().rect);
  Pen pen = bundle.pen;
  if (bundle.count > 60) pen.width_pt *= 0.6;
  std::size_t drawn = 0;
  for (const Flight& flight : flights) {
    const FinalLeg& leg = flight.final_leg;
    if (leg.state != bundle.state || drawn == most_drawn) continue;
    ++drawn;
    if (leg.state == FinalLegState::none_clear) {
      const Vec2 at = page.frame().to_page(leg.entry.position_m);
      canvas.stroke(crossing_strokes(at, refused_arm_pt), bundle.pen);
    } else {
      const DrawingPath path = segments_path(leg.segments, page.frame());
      canvas.stroke(thinned(path, unseen_pt), pen);
    }
  }
}

constexpr Color tube_ground{170, 51, 119, 0.2};
const Pen tube_pen{{170, 51, 119}, 0.7, {}};

void draw_tube(MapPage& page, const FollowProof& proof, double cell_m) {
  DrawingPath outline;
  for (const auto& line : tube_outline(proof, 0.25 * cell_m)) {
    outline.move_to(page.frame().to_page(line.front()));
    for (std::size_t i = 1; i + 1 < line.size(); ++i)
      outline.line_to(page.frame().to_page(line[i]));
    outline.close();
  }
  const DrawingPath drawn = thinned(outline, 2.0 * unseen_pt);
  const auto layer = page.canvas().layer("tube", page.frame().rect);
  page.canvas().fill(drawn, tube_ground);
  page.canvas().stroke(drawn, tube_pen);
}

LegendEntry tube_entry(const FollowProof& proof) {
  return {fmt::format("proved tube (up to {:.1f} m)", std::ceil(10.0 * widest_m(proof)) / 10.0),
          [](Canvas& canvas, const Rect& box) {
            canvas.fill(box.outline(), tube_ground);
            canvas.stroke(box.outline(), tube_pen);
          }};
}

}  // namespace

Picture draw_flights(const Plan& plan, std::span<const Flight> flights,
                     const FlightPictureOptions& options) {
  require(options.names.empty() || options.names.size() == flights.size(),
          "names: none, or one per flight");
  require(options.most_drawn >= 1, "at least one flight is drawn");
  const bool by_name = !options.names.empty();
  const auto bundles =
      by_name ? bundles_by_name(flights, options.names) : bundles_by_outcome(flights);
  const auto legs = leg_bundles(flights);
  std::vector<LegendEntry> entries;
  for (const Bundle& bundle : bundles) entries.push_back(line_entry(bundle.label, bundle.pen));

  const std::size_t further = flown_further(flights);
  if (further > 0) entries.push_back(further_entry(further, bundles.front().pen));
  for (const LegBundle& bundle : legs) entries.push_back(leg_entry(bundle));
  if (options.follow != nullptr) entries.push_back(tube_entry(*options.follow));

  // Every outcome keeps its fair share: the few that collide matter more than the many that do not.
  std::vector<std::size_t> drawn(bundles.size(), 0);
  std::size_t left = static_cast<std::size_t>(options.most_drawn);
  for (bool any = true; any && left > 0;) {
    any = false;
    for (std::size_t k = bundles.size(); k-- > 0 && left > 0;)
      if (drawn[k] < bundles[k].flights.size()) {
        ++drawn[k];
        --left;
        any = true;
      }
  }
  std::size_t total = 0;
  for (const std::size_t count : drawn) total += count;
  if (total < flights.size())
    entries.push_back({fmt::format("{} of {} drawn", total, flights.size()), {}});

  MapPage page(plan,
               {options.title, false, options.mission, options.frame_pt, options.pixels_per_pt},
               std::move(entries));
  if (options.follow != nullptr) draw_tube(page, *options.follow, plan.grid.cell_m);
  if (legs.empty()) page.mark_mission();
  for (std::size_t k = 0; k < bundles.size(); ++k) draw_bundle(page, bundles[k], drawn[k]);
  for (std::size_t k = 0; k < bundles.size() && further > 0; ++k) {
    draw_further(page, bundles[k], drawn[k]);
  }
  for (const LegBundle& bundle : legs) {
    draw_legs(page, bundle, flights, static_cast<std::size_t>(options.most_drawn));
  }
  if (!legs.empty()) page.mark_mission();  // the legs end at the goal's arrow
  return page.finish();
}

}  // namespace fairway
