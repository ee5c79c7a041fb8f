#include "check/flight.hpp"

#include <cmath>

#include <tbb/parallel_for.h>

namespace fairway_check {

namespace {

constexpr std::size_t none = ~std::size_t{0};
constexpr int most_cells = 20000;
constexpr std::size_t most_parts = 64;
constexpr double most_waves = 0x1p50;

/// A set in a cell, and what can be concluded from its past, which all its states share.
struct Part {
  Cell cell{};
  Bundle set{};
  float flown_rad = NAN;  ///< the heading, when it is exactly a command
  double length = 0.0;
  std::size_t began_at = none;     ///< just left this section
  std::size_t mirror_of = none;    ///< just came back over this section, which it left before
  std::size_t circle_from = none;  ///< the first side crossed on the current circle
  std::size_t wave_from = none;    ///< the side crossed at the start of a wave, ...
  double wave_length = 0.0;        ///< ... the length flown until then, ...
  bool wave_returned = false;      ///< ... and whether it has been crossed back since
  int skimmed_side = -1;           ///< the set runs along this side, and is also followed beyond it
};

Verdict verdict_in(CellKind kind) {
  return kind == target ? reach : kind == obstacle ? collide : leave;
}

class Follower {
 public:
  Follower(const Loop& loop, Listener& listener) : loop_(loop), listener_(listener) {}

  void follow(const Part& first) {
    parts_.push_back(first);
    int cells = 0;
    while (!parts_.empty()) {
      const Part part = parts_.back();
      parts_.pop_back();
      if (++cells > most_cells || parts_.size() > most_parts || !cross(part)) {
        listener_.give_up();
        return;
      }
    }
  }

 private:
  std::size_t section(Cell cell, int side) const {
    return 4 * loop_.index(cell) + static_cast<std::size_t>(side);
  }

  /// False: it is unknown where the set goes.
  bool cross(const Part& part) {
    const std::size_t cell = loop_.index(part.cell);
    const float rad = loop_.command_rad[cell];
    const Command command{loop_.direction[cell], !std::isnan(rad), rad == part.flown_rad};
    ways_.clear();
    if (!find_ways(part.set, command, loop_.radius, ways_) || ways_.empty()) return false;
    for (Way& way : ways_) {
      // Along this side, the set is already followed on the other side.
      if (way.skims && way.side == part.skimmed_side) continue;
      const float flown_rad = !command.exists ? part.flown_rad : way.aligned ? rad : NAN;
      go(part, way, flown_rad, ways_.size() == 1);
    }
    return true;
  }

  void go(const Part& part, Way& way, float flown_rad, bool alone) {
    const std::size_t off = section(part.cell, way.side);
    // On the way back to the section it started at, the set aligns where it leaves: this is a hop.
    const bool hop = part.mirror_of == off;
    if (hop && way.aligned) return;
    Part next{.cell = part.cell.beyond(way.side),
              .set = {.heading = way.heading},
              .flown_rad = hop ? loop_.command_rad[off / 4] : flown_rad,
              .length = (Real(part.length) + way.length).upper()};
    if (way.at_low) go_through_corner(part, way, next, -1);
    if (way.at_high) go_through_corner(part, way, next, 1);

    const CellKind kind = loop_.kind_at(next.cell);
    if (kind != ordinary) {
      listener_.end(verdict_in(kind), next.length);
      return;
    }
    if (way.skims && is_turned_away(next, way.side)) return;
    if (hop || (way.aligned && !way.skims)) {
      listener_.arrive(off, way.place, next.length, hop);
      return;
    }
    const std::size_t back = section(next.cell, (way.side + 2) & 3);
    if (way.turn != 0) {
      if (alone) ride_waves(part, way, off, back, next);
      const bool same_circle = part.set.turn == way.turn;
      if (same_circle && part.circle_from == off) {
        listener_.end(trapped, next.length);
        return;
      }
      next.circle_from = same_circle && part.circle_from != none ? part.circle_from : off;
      next.set.turn = way.turn;
      next.set.centre = {way.centre.x - static_cast<double>(step_x[way.side]),
                         way.centre.y - static_cast<double>(step_y[way.side])};
      if (part.began_at == back) next.mirror_of = back;
    }
    if (way.skims) next.skimmed_side = (way.side + 2) & 3;
    next.set.at = from_frame(way.side, {Real(-0.5), way.place});
    parts_.push_back(next);
  }

  /// States that leave through a corner (end -1 or 1 of the side) also touch the two cells beyond
  /// the end, and may continue in the one across. Headings from beyond the end do not leave here.
  void go_through_corner(const Part& part, const Way& way, Part next, int end) {
    const Real onwards = static_cast<double>(end) * into_frame(way.side, way.heading).y;
    if (negative(onwards)) return;
    const int over = (way.side + end) & 3;  // the side of the cell left that is at the end
    next.cell = next.cell.beyond(over);
    const CellKind beside = loop_.kind_at(part.cell.beyond(over));
    const CellKind across = loop_.kind_at(next.cell);
    if (beside != ordinary) listener_.end(verdict_in(beside), next.length);
    if (across != ordinary) {
      listener_.end(verdict_in(across), next.length);
      return;
    }
    if (is_turned_away(next, over)) return;
    next.set.at = from_frame(way.side, {Real(-0.5), Real(-0.5 * end)});
    parts_.push_back(next);
  }

  /// Exactly along the side `over` through which it would enter, where the command turns it out
  /// again at once: no motion stays in that cell for any length of time.
  bool is_turned_away(const Part& next, int over) const {
    const std::size_t cell = loop_.index(next.cell);
    return is_zero(into_frame(over, next.set.heading).x) && !std::isnan(loop_.command_rad[cell]) &&
           negative(into_frame(over, loop_.direction[cell]).x);
  }

  /// Lemma 5 for any weave: out over a side, back over it and out again, each time on one arc and
  /// by all states of the set, repeats as long as it lands between the same two cells: every wave
  /// moves a state by 4 R sin n. Waves that certainly do are skipped in one step.
  void ride_waves(const Part& part, Way& way, std::size_t off, std::size_t back, Part& next) const {
    if (part.wave_from == back && !part.wave_returned) {
      next.wave_from = back;
      next.wave_length = part.wave_length;
      next.wave_returned = true;
      return;
    }
    if (part.wave_from != off || !part.wave_returned) {
      next.wave_from = off;
      next.wave_length = next.length;
      return;
    }
    const Vec u = into_frame(way.side, way.heading);
    const bool up = positive(u.y);
    Real step = 4.0 * loop_.radius * u.x;
    if ((!up && !negative(u.y)) || !cut(step, Real(0.0, 4.0 * loop_.radius.upper()))) return;
    const double room =
        (up ? 0.5 - Real(way.place.upper()) : Real(way.place.lower()) + 0.5).lower();
    const double waves = std::floor((Real(room) / step.upper()).lower()) - 2.0;
    if (!(waves >= 1.0 && waves < most_waves)) return;
    const Real moved = (up ? waves : -waves) * step;
    Vec centre = into_frame(way.side, way.centre);
    way.place += moved;
    centre.y += moved;
    way.centre = from_frame(way.side, centre);
    const Real wave_length = Real(next.length) - part.wave_length;
    next.length = (next.length + waves * wave_length).upper();
  }

  const Loop& loop_;
  Listener& listener_;
  std::vector<Part> parts_;  // yet to be followed
  std::vector<Way> ways_;
};

/// The states of a section, on their way into the cell beyond.
Part beyond_section(const Loop& loop, std::size_t section, const Real& place) {
  return {.cell = loop.beyond(section),
          .set = {.at = from_frame(static_cast<int>(section % 4), {Real(-0.5), place}),
                  .heading = loop.direction[section / 4]},
          .flown_rad = loop.command_rad[section / 4]};
}

}  // namespace

void Loop::take_directions(double turn_radius_m, double cell_m) {
  direction.assign(kind.size(), {Real(0.0), Real(0.0)});
  tbb::parallel_for(std::size_t{0}, kind.size(), [this](std::size_t i) {
    if (kind[i] != ordinary || std::isnan(command_rad[i])) return;
    direction[i] = unit_vector(static_cast<double>(command_rad[i]));
  });
  const Upwards upwards;
  radius = Real(turn_radius_m) / cell_m;
}

void follow_section(const Loop& loop, std::size_t section, const Real& place, Listener& listener) {
  Part first = beyond_section(loop, section, place);
  first.began_at = section;
  Follower(loop, listener).follow(first);
}

void follow_handed_over(const Loop& from, const Loop& loop, std::size_t section, const Real& place,
                        Listener& listener) {
  Follower(loop, listener).follow(beyond_section(from, section, place));
}

void follow_states(const Loop& loop, std::size_t cell, const Vec& at, const Vec& heading,
                   Listener& listener) {
  Follower(loop, listener)
      .follow({.cell = loop.cell_at(cell), .set = {.at = at, .heading = heading}});
}

}  // namespace fairway_check
