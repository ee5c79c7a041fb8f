#include "fairway/run/steering.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "fairway/base/number_text.hpp"
#include "fairway/base/parallel.hpp"
#include "fairway/report/draw_steering.hpp"
#include "fairway/run/path_segments.hpp"
#include "fairway/steer/dubins_words.hpp"
#include "fairway/steer/waypoint_law.hpp"

namespace fairway {
namespace {

constexpr double step_radii = 0.01;
constexpr double most_points = 10'000.0;  // of a leg along a shortest path, beside its joins

void add_shortest_track(SteeredLeg& leg, const DubinsPath& path) {
  const double length_m = path.length_m();
  const double step_m = std::max(step_radii * path.turn_radius_m, length_m / most_points);
  const auto add = [&](const State& s, double per_m, double driven_m) {
    leg.track.push_back({driven_m, s, per_m, (length_m - driven_m) / path.turn_radius_m, 0.0, 0.0});
  };
  leg.segments = segments_of(path);
  double driven_m = 0.0;
  for (const FlightSegment& piece : leg.segments) {
    const double steps = std::ceil(piece.length_m / step_m);
    for (double k = 0.0; k < steps; k += 1.0) {
      const double along_m = piece.length_m * k / steps;
      add(driven(piece.start, along_m, piece.curvature_per_m), piece.curvature_per_m,
          driven_m + along_m);
    }
    driven_m += piece.length_m;
  }
  add(end_of(path), leg.segments.empty() ? 0.0 : leg.segments.back().curvature_per_m, length_m);
}

SteeredLeg shortest_leg(const State& from, const State& goal, double turn_radius_m,
                        LegTrack track) {
  const DubinsPath path = shortest_path(from, goal, turn_radius_m);
  SteeredLeg leg{from, goal, path.length_m(), name_of(path.word), true, end_of(path), {}, {}};
  if (track == LegTrack::all) add_shortest_track(leg, path);
  return leg;
}

/// The states of a flight, with what the law saw at each: it is asked again, and answers the same.
void add_clf_track(SteeredLeg& leg, std::span<const State> states, double turn_radius_m) {
  ClfLaw law;
  const double step_m = step_radii * turn_radius_m;
  for (std::size_t i = 0; i < states.size(); ++i) {
    const State& s = states[i];
    const ClfValue value = law.value(s, leg.goal, turn_radius_m);
    const bool repels = value.repels_left || value.repels_right;
    const double driven_m = static_cast<double>(i) * step_m;
    const bool last = i + 1 == states.size();
    const double per_m = !last ? law.curvature_per_m(s, leg.goal, turn_radius_m, step_m)
                         : leg.track.empty() ? 0.0
                                             : leg.track.back().curvature_per_m;
    leg.track.push_back({driven_m, s, per_m, value.v, value.v_attract,
                         repels ? value.v_repel : std::numeric_limits<double>::quiet_NaN()});
    if (!last) leg.segments.push_back({s, driven_m, step_m, per_m});
  }
}

SteeredLeg clf_leg(const State& from, const State& goal, double turn_radius_m, LegTrack track) {
  ClfLaw law;
  SteeringFlight flight =
      fly(law, from, goal, turn_radius_m, steering_options(from, goal, turn_radius_m),
          track == LegTrack::all ? Track::all : Track::none);
  SteeredLeg leg{from, goal, flight.length_m, std::move(flight.word), flight.converged, flight.end,
                 {},   {}};
  add_clf_track(leg, flight.track, turn_radius_m);
  return leg;
}

SteeredPath joined(std::span<const SteeredLeg> legs, std::string name) {
  SteeredPath path{std::move(name), {}};
  for (const SteeredLeg& leg : legs) {
    path.segments.insert(path.segments.end(), leg.segments.begin(), leg.segments.end());
  }
  return path;
}

double total_m(std::span<const SteeredLeg> legs) {
  double sum_m = 0.0;
  for (const SteeredLeg& leg : legs) sum_m += leg.length_m;
  return sum_m;
}

std::string words_of(std::span<const SteeredLeg> legs) {
  const std::string what =
      legs.size() == 1 ? legs.front().word : fmt::format("{} legs", legs.size());
  return fmt::format("{}, {} m", what, length_text(total_m(legs)));
}

/// V over all legs; a gap between legs, where it jumps.
std::vector<ChartSeries> value_series(std::span<const SteeredLeg> legs, SteeringLaw law) {
  const bool shortest = law == SteeringLaw::shortest;
  ChartSeries v{shortest ? "V: what is left of the path" : "V (Eq. 20)", {}, {}, LineStyle::solid};
  ChartSeries attract{"V_A, attraction (Eq. 9)", {}, {}, LineStyle::dashed};
  ChartSeries repel{"V_R, repulsion (Eq. 17)", {}, {}, LineStyle::dotted};
  bool repels = false;
  double before_m = 0.0;
  for (const SteeredLeg& leg : legs) {
    const auto add = [&](double driven_m, double value, double attraction, double repulsion) {
      for (const auto& [series, y] :
           {std::pair{&v, value}, std::pair{&attract, attraction}, std::pair{&repel, repulsion}}) {
        series->x.push_back(before_m + driven_m);
        series->y.push_back(y);
      }
    };
    for (const TrackPoint& point : leg.track) {
      add(point.driven_m, point.value, point.attract, point.repel);
      repels = repels || !std::isnan(point.repel);
    }
    constexpr double gap = std::numeric_limits<double>::quiet_NaN();
    add(leg.length_m, gap, gap, gap);
    before_m += leg.length_m;
  }
  if (shortest) return {std::move(v)};
  std::vector<ChartSeries> all{std::move(v), std::move(attract)};
  if (repels) all.push_back(std::move(repel));
  return all;
}

}  // namespace

std::vector<SteeredLeg> steer_pairs(const PosePairs& pairs, double turn_radius_m, SteeringLaw law,
                                    LegTrack track) {
  std::vector<SteeredLeg> legs(pairs.from.size());
  const bool shortest = law == SteeringLaw::shortest;
  for_ranges(legs.size(), shortest ? 1024 : 4, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      legs[i] =
          (shortest ? shortest_leg : clf_leg)(pairs.from[i], pairs.to[i], turn_radius_m, track);
    }
  });
  return legs;
}

std::vector<SteeredLeg> steer_waypoints(const PosePairs& asked, double turn_radius_m,
                                        SteeringLaw law, LegTrack track) {
  if (law == SteeringLaw::shortest) return steer_pairs(asked, turn_radius_m, law, track);
  const State& start = asked.from.front();
  const SteeringOptions options = steering_options(start, asked.to.front(), turn_radius_m);
  WaypointFlight flight = follow_waypoints(WaypointLaw<ClfLaw>(ClfLaw(), {options.tolerance}),
                                           start, asked.to, turn_radius_m, options.step_m,
                                           track == LegTrack::all ? Track::all : Track::none);
  std::vector<SteeredLeg> legs;
  for (std::size_t i = 0; i < flight.legs.size(); ++i) {
    WaypointLeg& leg = flight.legs[i];
    legs.push_back({leg.begin,
                    asked.to[i],
                    leg.length_m,
                    std::move(leg.word),
                    leg.converged,
                    leg.end,
                    {},
                    {}});
    add_clf_track(legs.back(), leg.track, turn_radius_m);
  }
  return legs;
}

std::string track_csv(std::span<const SteeredLeg> legs) {
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "leg,driven_m,x_m,y_m,heading_rad,curvature_per_m,value\n");
  double before_m = 0.0;
  for (std::size_t i = 0; i < legs.size(); ++i) {
    for (const TrackPoint& p : legs[i].track) {
      fmt::format_to(out, "{},{},{},{},{},{},{}\n", i, before_m + p.driven_m, p.state.position_m.x,
                     p.state.position_m.y, p.state.heading.rad(), p.curvature_per_m, p.value);
    }
    before_m += legs[i].length_m;
  }
  return fmt::to_string(text);
}

Picture steering_picture(std::span<const SteeredLeg> legs, double turn_radius_m, SteeringLaw law) {
  SteeringPicture picture;
  picture.turn_radius_m = turn_radius_m;
  picture.start = legs.front().from;
  for (const SteeredLeg& leg : legs) picture.goals.push_back(leg.goal);
  if (law == SteeringLaw::shortest) {
    picture.path = joined(legs, "shortest: " + words_of(legs));
  } else {
    picture.path = joined(legs, "law clf: " + words_of(legs));
    std::vector<SteeredLeg> shortest;
    State from = picture.start;
    for (const SteeredLeg& leg : legs) {
      shortest.push_back(shortest_leg(from, leg.goal, turn_radius_m, LegTrack::all));
      from = leg.goal;
    }
    picture.compared = joined(shortest, "shortest: " + words_of(shortest));
  }
  picture.values = value_series(legs, law);
  picture.value_label = "V (turning radii)";
  return draw_steering(picture);
}

}  // namespace fairway
