#include "fairway/identify/nearest_motion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include "fairway/base/error.hpp"
#include "fairway/base/random.hpp"
#include "fairway/identify/commands_in_force.hpp"
#include "fairway/identify/turn_range.hpp"

namespace fairway {
namespace {

/// A motion so far.
struct Reached {
  Vec2 place_m;
  Heading course;
  HeldSide held;
  double farthest_m = 0.0;
  std::uint32_t farthest = 0;  ///< sample
  std::uint32_t parent = 0;
  double score = 0.0;
  std::uint64_t alike = 0;  ///< equal: as good as one
};

struct Place {
  Vec2 place_m;
  std::uint32_t parent = 0;
};

/// The number of a key among those of a step: open addressing, emptied by a new stamp.
class PlaceOfKey {
 public:
  void begin_step() {
    ++stamp_;
    used_ = 0;
  }
  /// `fresh` is stored for a key not seen before in this step.
  std::uint32_t place_of(std::uint64_t key, std::uint32_t fresh) {
    if (2 * ++used_ > slots_.size()) grow();
    Slot& slot = slot_of(key);
    if (slot.stamp != stamp_) slot = {key, stamp_, fresh};
    return slot.place;
  }

 private:
  struct Slot {
    std::uint64_t key = 0;
    std::uint32_t stamp = 0;
    std::uint32_t place = 0;
  };

  Slot& slot_of(std::uint64_t key) {
    std::uint64_t mixed = key;
    std::size_t at = splitmix64(mixed) & (slots_.size() - 1);
    while (slots_[at].stamp == stamp_ && slots_[at].key != key) at = (at + 1) & (slots_.size() - 1);
    return slots_[at];
  }
  void grow() {
    const std::vector<Slot> old = std::move(slots_);
    slots_.assign(2 * old.size(), {});
    for (const Slot& slot : old) {
      if (slot.stamp == stamp_) slot_of(slot.key) = slot;
    }
  }

  std::vector<Slot> slots_ = std::vector<Slot>(4096);
  std::uint32_t stamp_ = 0;
  std::size_t used_ = 0;  ///< at most so many
};

class Beam {
 public:
  Beam(const FlownTrack& track, const VehicleContract& contract, const MotionSearch& search)
      : track_(track), contract_(contract), search_(search), commands_(track, contract) {
    begin();
  }

  NearestMotion run() {
    for (std::size_t i = 0; i + 1 < track_.size(); ++i) {
      step(i);
      if (next_.empty()) return told(i, false);
      now_.swap(next_);
      remember();
    }
    return told(track_.size() - 1, true);
  }

 private:
  void begin() {
    constexpr std::array<double, 5> offsets{0.0, -0.5, 0.5, -1.0, 1.0};
    const double aside_rad = 0.04;
    const Vec2 left = left_of(track_.course[0].unit());
    for (const double across : offsets) {
      for (const double turned : offsets) {
        Reached start;
        start.place_m = track_.place_m[0] + (0.6 * search_.limit_m * across) * left;
        start.course = Heading::from_rad(track_.course[0].rad() + aside_rad * turned);
        start.farthest_m = 0.6 * search_.limit_m * std::abs(across);
        now_.push_back(start);
      }
    }
    remember();
  }

  void remember() {
    if (!search_.wants_places) return;
    std::vector<Place>& places = history_.emplace_back();
    for (const Reached& r : now_) places.push_back({r.place_m, r.parent});
  }

  /// The track's speed, corrected for being ahead or behind.
  double step_m(const Reached& r, std::size_t i) const {
    const double behind_m = dot(track_.place_m[i] - r.place_m, along_);
    const double share = std::clamp(behind_m / contract_.turn_radius_m.least, -0.5, 0.5);
    return (1.0 + share) * track_.speed_mps[i] * (track_.time_s[i + 1] - track_.time_s[i]);
  }

  void step(std::size_t i) {
    next_.clear();
    found_.begin_step();
    along_ = track_.course[i].unit();
    along_next_ = track_.course[i + 1].unit();
    commands_.look_back_from(i, search_.limit_m);
    for (std::uint32_t k = 0; k < now_.size(); ++k) {
      const Reached& r = now_[k];
      const double way_m = step_m(r, i);
      commands_.near(r.place_m, r.course);
      find_turn_choices(commands_, TurnStep(contract_, way_m), contract_, search_.sides, r.course,
                        r.held, choices_);
      if (!choices_.empty()) follow(r, k, way_m, i + 1);
    }
    keep_best();
  }

  /// Extremes, straight on, and two turns that lead back to the track.
  void follow(const Reached& from, std::uint32_t parent, double way_m, std::size_t to) {
    const double aside_m = cross(along_next_, track_.place_m[to] - from.place_m);
    const double radius_m = contract_.turn_radius_m.least;
    const double to_track_rad = from.course.turn_to(track_.course[to]);
    const double soon_rad = to_track_rad + std::atan(aside_m / (0.5 * radius_m));
    const double late_rad = to_track_rad + std::atan(aside_m / (1.5 * radius_m));
    for (const TurnChoice& choice : choices_) {
      if (choice.turn.is_empty()) continue;
      const TurnRange turn = choice.turn;
      const std::array<double, 5> turns{turn.least, turn.most, turn.nearest_to(0.0),
                                        turn.nearest_to(soon_rad), turn.nearest_to(late_rad)};
      for (std::size_t t = 0; t < turns.size(); ++t) {
        if (std::find(turns.begin(), turns.begin() + t, turns[t]) != turns.begin() + t) continue;
        add(from, parent, turns[t], choice.held, way_m, to);
      }
    }
  }

  void add(const Reached& from, std::uint32_t parent, double turn_rad, HeldSide held, double way_m,
           std::size_t to) {
    Reached next = from;
    const double half = 0.5 * turn_rad;
    const double chord_m = way_m * (std::abs(half) < 1e-4 ? 1.0 : std::sin(half) / half);
    next.place_m = from.place_m + chord_m * Heading::from_rad(from.course.rad() + half).unit();
    const Vec2 off = next.place_m - track_.place_m[to];
    const double distance_m = norm(off);
    if (distance_m > search_.limit_m) return;
    next.course = Heading::from_rad(from.course.rad() + turn_rad);
    next.held = held;
    next.parent = parent;
    if (distance_m > next.farthest_m) {
      next.farthest_m = distance_m;
      next.farthest = static_cast<std::uint32_t>(to);
    }
    rate(next, off, distance_m, track_.course[to]);
    const std::uint32_t known =
        found_.place_of(next.alike, static_cast<std::uint32_t>(next_.size()));
    if (known == next_.size()) {
      next_.push_back(next);
    } else if (next.score < next_[known].score) {
      next_[known] = next;
    }
  }

  void rate(Reached& r, Vec2 off, double distance_m, Heading course) const {
    constexpr double cells_per_limit = 4.0;
    constexpr double cells_per_rad = 40.0;
    const double turned_rad = course.turn_to(r.course);
    r.score = distance_m + 0.3 * contract_.turn_radius_m.least * std::abs(turned_rad);
    const auto cell = [](double value) {
      return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(value + 0.5))) &
             0xffff;
    };
    const double per_m = cells_per_limit / search_.limit_m;
    r.alike = (cell(off.x * per_m) << 48) | (cell(off.y * per_m) << 32) |
              (cell(turned_rad * cells_per_rad) << 16) | ((r.held.run & 0x3fffU) << 2) |
              static_cast<std::uint64_t>(static_cast<int>(r.held.side) + 1);
  }

  void keep_best() {
    if (next_.size() <= search_.most_states) return;
    const auto better = [](const Reached& a, const Reached& b) {
      return a.score != b.score ? a.score < b.score : a.alike < b.alike;
    };
    std::nth_element(next_.begin(), next_.begin() + search_.most_states, next_.end(), better);
    next_.resize(search_.most_states);
  }

  NearestMotion told(std::size_t reached, bool stays) const {
    NearestMotion motion;
    const auto best = std::min_element(
        now_.begin(), now_.end(),
        [](const Reached& a, const Reached& b) { return a.farthest_m < b.farthest_m; });
    motion.stays = stays;
    motion.reached = reached;
    motion.farthest_m = best->farthest_m;
    motion.farthest = best->farthest;
    if (!search_.wants_places) return motion;
    motion.place_m.resize(history_.size());
    auto at = static_cast<std::uint32_t>(best - now_.begin());
    for (std::size_t i = history_.size(); i-- > 0;) {
      motion.place_m[i] = history_[i][at].place_m;
      at = history_[i][at].parent;
    }
    return motion;
  }

  const FlownTrack& track_;
  const VehicleContract& contract_;
  const MotionSearch& search_;
  CommandsInForce commands_;
  std::vector<Reached> now_;
  std::vector<Reached> next_;  ///< of those alike the best
  PlaceOfKey found_;           ///< where in next_
  TurnChoices choices_;
  Vec2 along_;       ///< the track, at the beginning of a step
  Vec2 along_next_;  ///< at its end
  std::vector<std::vector<Place>> history_;
};

}  // namespace

NearestMotion nearest_motion(const FlownTrack& track, const VehicleContract& contract,
                             const MotionSearch& search) {
  require(track.size() >= 2, "a track has at least two samples");
  require(search.limit_m > 0.0, "the limit is above 0");
  require(contract.turn_radius_m.least > 0.0, "a radius is above 0");
  return Beam(track, contract, search).run();
}

}  // namespace fairway
