// Following all states of a set until each is accounted for: it aligned and left a cell (it is on
// the section, docs/formats.md), or its flight ended. What is told encloses what happens:
//   1. every state meets one of the things told, within the length told with it;
//   2. a state in a corner is told of all four cells; heading along a side, of both;
//   3. circling is told of states that crossed one side twice, outwards, on one circle.
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
extern const char* const verdict_name[verdict_count];

/// The closed loop, in cells.
struct Loop {
  int nx = 0;
  int ny = 0;
  Real radius;
  const float* command_rad = nullptr;  ///< [iy][ix]
  const std::uint8_t* kind = nullptr;  ///< [iy][ix]
  std::vector<Vec> direction;          ///< [iy][ix], of the commands of ordinary cells

  /// Fills `radius` and `direction` from the rest.
  void take_directions(double turn_radius_m, double cell_m);

  std::size_t index(int ix, int iy) const {
    return static_cast<std::size_t>(iy) * static_cast<std::size_t>(nx) +
           static_cast<std::size_t>(ix);
  }
  CellKind kind_at(int ix, int iy) const {
    const bool inside = ix >= 0 && ix < nx && iy >= 0 && iy < ny;
    return inside ? static_cast<CellKind>(kind[index(ix, iy)]) : outside;
  }
  int column(std::size_t cell) const {
    return static_cast<int>(cell % static_cast<std::size_t>(nx));
  }
  int row(std::size_t cell) const { return static_cast<int>(cell / static_cast<std::size_t>(nx)); }
  /// Of the cell beyond a section's side.
  CellKind kind_beyond(std::size_t section) const {
    return kind_at(column(section / 4) + step_x[section % 4],
                   row(section / 4) + step_y[section % 4]);
  }
};

class Listener {
 public:
  virtual ~Listener() = default;
  /// On the section 4 * cell + side, at `place` in the side's frame.
  virtual void arrive(std::size_t section, const Real& place, double length, bool hop) = 0;
  virtual void end(Verdict verdict, double length) = 0;
  /// Not all can be said; what was told is not all.
  virtual void give_up() = 0;
};

/// All states of `section` with their place in `place`, followed from the cell beyond the side,
/// which is ordinary.
void follow_section(const Loop& loop, std::size_t section, const Real& place, Listener& listener);

/// States inside an ordinary cell.
void follow_states(const Loop& loop, std::size_t cell, const Vec& at, const Vec& heading,
                   Listener& listener);

}  // namespace fairway_check
