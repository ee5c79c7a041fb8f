// What all behaviours that are followed from one set share, and what is told of them.
#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>

#include "check/contract_parts.hpp"
#include "check/contract_places.hpp"

namespace fairway_check {

/// The past of a set: every heading that any of it may have had since it began (an interval, not
/// reduced to a full turn), and the way it may have flown.
struct Past {
  double least_rad = HUGE_VAL;
  double most_rad = -HUGE_VAL;
  double length = 0.0;  ///< in parts
  double turned = 0.0;  ///< rad, both ways added up
  Past with(double least, double most, double further, double turn) const;
  /// Of both.
  Past joined(const Past& other) const;
};
/// More than this is not followed, so that nothing is followed for ever.
inline constexpr double most_turned = 8.0 * std::numbers::pi;

class Sightings {
 public:
  virtual ~Sightings() = default;
  /// Out of an ordinary part over `side`, aligned; at [low, high], from 0 at the right of one who
  /// looks outwards to 1.
  virtual void cross(std::size_t part, int side, double low, double high, const Past& past) = 0;
  virtual void end(Verdict verdict, const Past& past) = 0;
  /// In an ordinary part, with headings in [least, most].
  virtual void visit(std::size_t /*part*/, double /*least*/, double /*most*/) {}
  /// Cannot follow further: the reports are incomplete.
  virtual void give_up() = 0;
  /// Whether nothing further can matter.
  virtual bool has_enough() const { return false; }
};

/// Bounds of places that hold without any error, as nobody of the set has moved against them.
inline constexpr Box everywhere{-HUGE_VAL, -HUGE_VAL, HUGE_VAL, HUGE_VAL};

/// Parts and places are counted from a part near the set.
class Following {
 public:
  Following(const Parts& parts, const Contract& contract);

  void begin(Cell origin, Sightings& sightings);
  /// Gives up.
  void lose();
  /// Counts one more step of work; false: gives up, as it was too much.
  bool spend();
  bool is_over() const { return lost_ || sightings_->has_enough(); }
  bool is_lost() const { return lost_; }
  Sightings& sightings() const { return *sightings_; }

  CellKind kind_of(Cell part) const { return parts_.kind_at(global(part)); }
  Arc arc_of(Cell part) const { return parts_.arc[index_of(part)]; }
  std::size_t index_of(Cell part) const { return parts_.index(global(part)); }
  const Contract& contract() const { return contract_; }
  double least_radius() const { return least_radius_; }  ///< in parts
  double most_radius() const { return most_radius_; }

  /// They are in an ordinary part, with headings in [least, most].
  void visit(Cell part, double least, double most) const {
    sightings_->visit(index_of(part), least, most);
  }
  /// In a part that is not ordinary.
  void end_in(CellKind kind, const Past& past) const;
  /// Tells of all ends that they touch.
  void touch_ends(const Shape& at, const Past& past) const;
  /// Aligned in a part, `heading` among the headings. `begins`: they are there since the set began,
  /// within `sure`.
  void align(Cell part, const Shape& at, bool begins, const Box& sure, double heading,
             const Past& past) const;

 private:
  Cell global(Cell part) const { return {part.x + origin_.x, part.y + origin_.y}; }

  const Parts& parts_;
  const Contract& contract_;
  double least_radius_;
  double most_radius_;
  Sightings* sightings_ = nullptr;
  Cell origin_{};
  int work_ = 0;
  bool lost_ = false;
};

}  // namespace fairway_check
