// Follows all states of a set until each is accounted for: it has aligned and left a cell (it is on
// the section, docs/formats.md), or its flight has ended. The reports enclose what happens:
//   1. every state meets one of the things reported, within the length reported with it;
//   2. a state in a corner is reported for all four cells; heading along a side, for both;
//   3. circling is reported for states that crossed one side twice, outwards, on one circle.
// A `hop` (lemma 5): off the section over a side and back over it on one arc each, to the section.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "check/motion.hpp"

namespace fairway_check {

enum Verdict : std::uint8_t { undecided, reach, collide, leave, trapped };
enum CellKind : std::uint8_t { ordinary, obstacle, target, outside };
inline constexpr int verdict_count = 5;
inline constexpr const char* verdict_name[verdict_count]{"undecided", "reach", "collide", "leave",
                                                         "trapped"};

struct Cell {
  int x = 0;
  int y = 0;
  Cell beyond(int side) const { return {x + step_x[side], y + step_y[side]}; }
};

/// The closed loop, in cells.
struct Loop {
  int nx = 0;
  int ny = 0;
  Real radius;
  std::vector<float> command_rad;  ///< [iy][ix]
  std::vector<std::uint8_t> kind;  ///< [iy][ix], CellKind
  std::vector<Vec> direction;      ///< [iy][ix], of the commands of ordinary cells

  /// Fills `radius` and `direction` from the rest.
  void take_directions(double turn_radius_m, double cell_m);

  std::size_t index(Cell c) const {
    return static_cast<std::size_t>(c.y) * static_cast<std::size_t>(nx) +
           static_cast<std::size_t>(c.x);
  }
  Cell cell_at(std::size_t index) const {
    return {static_cast<int>(index % static_cast<std::size_t>(nx)),
            static_cast<int>(index / static_cast<std::size_t>(nx))};
  }
  CellKind kind_at(Cell c) const {
    const bool inside = c.x >= 0 && c.x < nx && c.y >= 0 && c.y < ny;
    return inside ? static_cast<CellKind>(kind[index(c)]) : outside;
  }
  /// The cell beyond a section's side.
  Cell beyond(std::size_t section) const {
    return cell_at(section / 4).beyond(static_cast<int>(section % 4));
  }
};

class Listener {
 public:
  virtual ~Listener() = default;
  /// On the section 4 * cell + side, at `place` in the side's frame.
  virtual void arrive(std::size_t section, const Real& place, double length, bool hop) = 0;
  virtual void end(Verdict verdict, double length) = 0;
  /// Cannot follow further; the reports are incomplete.
  virtual void give_up() = 0;
};

/// Follows all states of `section` with their place in `place` from the cell beyond the side, which
/// is ordinary.
void follow_section(const Loop& loop, std::size_t section, const Real& place, Listener& listener);

/// The same states where they are handed over: their last command is one of `from`, but from there
/// on they fly by those of `loop`, of whose own sections theirs is none.
void follow_handed_over(const Loop& from, const Loop& loop, std::size_t section, const Real& place,
                        Listener& listener);

/// Follows states inside an ordinary cell.
void follow_states(const Loop& loop, std::size_t cell, const Vec& at, const Vec& heading,
                   Listener& listener);

}  // namespace fairway_check
