// Follows every behaviour within a contract from a set of states, until each has met an end or
// crosses out of a part *aligned*: with its heading in the part's arc (contract_parts.hpp). What is
// reported holds everything that any behaviour may do (docs/trust.md, "The second theorem"):
//
//   aligned   The heading stays in the arc, so the way through the part lies in a cone.
//   turning   The heading only grows (or falls), so it serves as the clock: in a step of a few
//             degrees all places of the set lie in one polygon. In every part that the polygon
//             meets, `choices_in` says what may happen: align, turn on, turn back.
//   roaming   Where any command may be in force, or a behaviour may alternate between the sides,
//             only the least radius bounds it: within a part the heading changes by little.
#pragma once

#include <cmath>
#include <vector>

#include "check/contract_parts.hpp"
#include "check/contract_rules.hpp"
#include "check/shape.hpp"

namespace fairway_check {

/// The past of a set: every heading that any of it may have had since it began (an interval, not
/// reduced to a full turn), and the way it may have flown.
struct Past {
  double least_rad = HUGE_VAL;
  double most_rad = -HUGE_VAL;
  double length = 0.0;  ///< in parts
  double turned = 0.0;  ///< rad, both ways added up
  Past with(double least, double most, double further, double turn) const;
};

class Sightings {
 public:
  virtual ~Sightings() = default;
  /// Out of an ordinary part over `side`, aligned; at [low, high], from 0 at the right of one who
  /// looks outwards to 1.
  virtual void cross(std::size_t part, int side, double low, double high, const Past& past) = 0;
  virtual void end(Verdict verdict, const Past& past) = 0;
  /// Cannot follow further: the reports are incomplete.
  virtual void give_up() = 0;
  /// Whether nothing further can matter.
  virtual bool has_enough() const { return false; }
};

/// Follows one set after the other; not by two threads at once.
class Behaviours {
 public:
  Behaviours(const Parts& parts, const Contract& contract);

  /// All that leave the part aligned at [low, high] of a side.
  void follow_leaf(std::size_t part, int side, double low, double high, Sightings& sightings);
  /// At (x, y) in an ordinary part, from its corner; no side in memory.
  void follow_state(std::size_t part, double x, double y, double heading_rad, Sightings& sightings);

 private:
  /// Bounds that hold without any error, as nobody of the set has moved against them.
  static constexpr Box everywhere{-HUGE_VAL, -HUGE_VAL, HUGE_VAL, HUGE_VAL};
  struct Turning {
    Shape at{};
    Shape joining{};     ///< until the clock is `joined`, others begin here
    int turn = 1;        ///< 1 left, -1 right
    double clock = 0.0;  ///< the heading is turn * clock
    double joined = 0.0;
    Memory memory{};
    Past past{};
    Box sure = everywhere;
  };
  /// A part that a set meets in a step.
  struct Near {
    Cell part;
    Shape there;
    bool is_reached;
  };
  struct Met {
    Cell part{};
    bool stays = false;  ///< the set may turn on in it
  };
  /// Those that turn back in a part.
  struct Return {
    Cell part{};
    Turning set{};
  };
  struct Run;

  void begin(Cell part, const Shape& at, double least, double most, Memory left, Memory right,
             const Box& sure, const Past& past);
  void turn_from(const Shape& at, int turn, double least, double most, Memory memory,
                 const Box& sure, const Past& past);
  void turn_back(const Turning& set, double end, Cell part, const Shape& there, Memory memory,
                 const Past& past);
  void align(Cell part, const Shape& at, bool begins, const Box& sure, double heading,
             const Past& past);
  void roam(Cell part, const Shape& at, double least, double most, const Past& past);
  void touch_ends(const Shape& at, const Past& past);

  void run(Sightings& sightings);
  bool advance(Turning& set);
  double step_before_changes(const Turning& set, const Box& swept, double step) const;
  void meet(const Turning& set, double step, const Shape& swept, const Past& past, Memory& memory);
  void meet_part(const Turning& set, double step, Cell part, const Shape& there, const Past& past,
                 Memory& memory);
  bool part_from(Turning& set);
  void lose();

  template <typename Visit>
  void for_parts(const Shape& at, double margin, Visit visit) const;
  CellKind kind_of(Cell part) const { return parts_.kind_at(global(part)); }
  Arc arc_of(Cell part) const { return parts_.arc[parts_.index(global(part))]; }
  Cell global(Cell part) const { return {part.x + origin_.x, part.y + origin_.y}; }

  const Parts& parts_;
  const Contract& contract_;
  double least_radius_;  ///< in parts
  double most_radius_;
  double roaming_rad_;  ///< by which the heading may change in a part; NaN: any
  Sightings* sightings_ = nullptr;
  Cell origin_{};  ///< places and parts are counted from here
  int work_ = 0;
  bool lost_ = false;
  std::vector<Turning> waiting_;
  std::vector<Return> returns_;
  std::vector<Near> near_;  ///< what a step sweeps
  std::vector<Met> met_;
};

}  // namespace fairway_check
