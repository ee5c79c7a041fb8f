#include "check/contract_flight.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace fairway_check {
namespace {

/// By which ends of arcs may differ from those of the certificate's author.
constexpr double along_slack = 0x1p-20;

/// Adjacent headings from which a set turns to one side alike.
struct Run {
  int turn;
  double least = 0.0;
  double most = 0.0;
  Memory memory{};
};

}  // namespace

Behaviours::Behaviours(const Parts& parts, const Contract& contract)
    : parts_(parts),
      following_(parts, contract),
      turning_(following_, *this),
      roaming_rad_(std::asin(part_diagonal / following_.least_radius()) + angle_slack) {}

void Behaviours::follow_leaf(std::size_t part, int side, double low, double high,
                             Sightings& sightings) {
  following_.begin(parts_.part_at(part), sightings);
  const Arc arc = parts_.arc[part];
  double least = arc.right;
  double most = arc.right + arc.width;
  if (parts_.kind[part] != ordinary || is_loose(arc, following_.contract()))
    return following_.lose();
  if (!point_outwards(side, least, most)) {
    // The author's arc may reach a little farther than this one, just over the side: then those
    // that fly along it are followed, so that nothing is concluded from nobody.
    least = arc.right - along_slack;
    most = arc.right + arc.width + along_slack;
    if (!point_outwards(side, least, most)) return;
  }
  // Near the ends of a wide arc a side may be held: the one that leads into the arc. (Those that
  // hold the other one have turned that way without pause, and are followed as such.)
  const double far_left = arc.right + arc.width - following_.contract().hold_side + angle_slack;
  const double far_right = arc.right + following_.contract().hold_side - angle_slack;
  const double to_left = std::clamp(far_left, least, most);
  const double to_right = std::clamp(far_right, to_left, most);
  const Shape at = places_on(side, low, high);
  const Box sure = at.bounds();
  const Past past = Past{}.with(least, most, 0.0, 0.0);
  const Memory none{.nothing = true, .side = false};
  const Memory any{.nothing = true, .side = true};
  const Cell beyond = Cell{0, 0}.beyond(side);
  following_.visit({0, 0}, least, most);
  if (to_left > least) begin(beyond, at, least, to_left, any, none, sure, past);
  if (to_right > to_left || least == most)
    begin(beyond, at, to_left, to_right, none, none, sure, past);
  if (most > to_right) begin(beyond, at, to_right, most, none, any, sure, past);
  turning_.follow();
}

void Behaviours::follow_state(std::size_t part, double x, double y, double heading_rad,
                              Sightings& sightings) {
  follow_states(part, Shape{{x, y}}, heading_rad, heading_rad, sightings);
}

void Behaviours::follow_states(std::size_t part, const Shape& at, double least, double most,
                               Sightings& sightings) {
  following_.begin(parts_.part_at(part), sightings);
  const Memory memory{.nothing = true, .side = false};
  begin({0, 0}, at, least, most, memory, memory, everywhere, Past{}.with(least, most, 0.0, 0.0));
  turning_.follow();
}

/// States in a part (or on its border, about to enter) with headings in [least, most].
void Behaviours::begin(Cell part, const Shape& at, double least, double most, Memory left,
                       Memory right, const Box& sure, const Past& past) {
  following_.touch_ends(at, past);
  if (following_.kind_of(part) != ordinary || following_.is_over() || !following_.spend()) return;
  const Arc arc = following_.arc_of(part);
  following_.visit(part, least, most);
  if (is_loose(arc, following_.contract())) return roam(part, at, least, most, past);

  // Between these headings the choices are the same.
  std::array<double, turning_points + 2> cuts;
  std::size_t count = 0;
  cuts[count++] = least;
  double points[turning_points];
  find_turning_points(arc.right, arc.width, following_.contract(), points);
  for (const double point : points) {
    const double cut = least + around_from(point - least);
    if (cut > least + angle_slack && cut < most - angle_slack) cuts[count++] = cut;
  }
  cuts[count++] = most;
  std::sort(cuts.begin(), cuts.begin() + static_cast<std::ptrdiff_t>(count));
  bool aligns = false;
  std::array<Run, 2> runs{Run{.turn = 1}, Run{.turn = -1}};
  const auto finish = [&](Run& run) {
    if (run.memory.any()) turning_.add(at, run.turn, run.least, run.most, run.memory, sure, past);
    run.memory = {};
  };
  for (std::size_t i = 0; i + 1 < count; ++i) {
    const double low = cuts[i];
    const double step = cuts[i + 1] - low;
    const double end = arc.right + arc.width;
    const std::array<Choices, 2> choices{
        choices_in(arc.right, arc.width, low, step, left, following_.contract()),
        choices_in(-end, arc.width, -low - step, step, right, following_.contract())};
    if (choices[0].aligns && !aligns)
      following_.align(part, at, true, sure, low + 0.5 * step, past);
    aligns = aligns || choices[0].aligns;
    const bool alternates = choices[0].alternates || choices[1].alternates;
    if (alternates) roam(part, at, low, low + step, past);
    for (std::size_t k = 0; k < 2; ++k) {
      const Memory now = alternates ? Memory{} : choices[k].on;
      if (now.nothing != runs[k].memory.nothing || now.side != runs[k].memory.side) {
        finish(runs[k]);
        runs[k].least = low;
        runs[k].memory = now;
      }
      runs[k].most = low + step;
    }
  }
  for (Run& run : runs) finish(run);
}

/// A curve of radius r1 or more that has turned by n < 90 degrees has come forward by r1 sin n.
void Behaviours::roam(Cell part, const Shape& at, double least, double most, const Past& past) {
  const double low_rad = least - roaming_rad_;
  const double high_rad = most + roaming_rad_;
  if (!(high_rad - low_rad < std::numbers::pi - 0x1p-20)) return following_.lose();  // also NaN
  const double length = part_diagonal / std::cos(0.5 * (high_rad - low_rad));
  const Past then = past.with(low_rad, high_rad, length, roaming_rad_);
  following_.visit(part, low_rad, high_rad);
  if (then.turned > most_turned) return following_.lose();
  const Shape inside = moved(at, -1.0 * corner_of(part));
  for (int side = 0; side < 4; ++side) {
    double low = 0.0;
    double high = 0.0;
    if (!find_way_out(inside, side, low_rad, high_rad, false, low, high)) continue;
    double from = low_rad;
    double to = high_rad;
    if (!point_outwards(side, from, to)) continue;
    const Memory any{.nothing = true, .side = true};
    begin(part.beyond(side), moved(places_on(side, low, high), corner_of(part)), from, to, any, any,
          everywhere, then);
  }
}

}  // namespace fairway_check
