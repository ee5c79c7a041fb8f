// The parts of a plan's cells, and which commands may be in force in each: what the inclusion sees
// of a plan and a contract.
//
// A cell is divided into `per_cell` by `per_cell` square parts. Coordinates are counted in parts
// from the grid's lower left corner: part (ix, iy) covers [ix, ix + 1] by [iy, iy + 1], and radii
// are in parts, too.
//
// Properties that always hold:
//   1. The arc of an ordinary part holds every command that the contract allows to be in force at
//      any position of the part, or within `place_slack` of it, with `heading_slack_rad` to spare.
//   2. An arc is narrower than pi - side_uncertain_rad and than 2 hold_side_rad, so that a heading
//   in
//      it stays in it; a part whose arc would not be is `wild`, and nothing is claimed there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "fairway/inclusion/heading_arc.hpp"
#include "fairway/vehicle/contract.hpp"
#include "fairway/vehicle/filled_commands.hpp"
#include "fairway/verify/flow.hpp"

namespace fairway {

/// Positions so near a part may be treated as in it (in parts), headings so near an arc likewise.
/// Far above all rounding, far below all that matters.
inline constexpr double place_slack = 0x1p-20;
inline constexpr double heading_slack_rad = 0x1p-22;

enum class PartKind : std::uint8_t {
  ordinary,
  obstacle,
  goal,
  outside,
  wild,
  closed  ///< a goal: nothing is claimed of who touches it
};

struct PartPlace {
  int ix = 0;
  int iy = 0;
};

class Parts {
 public:
  /// `contract`: look_ahead_m and wind_mps are 0. per_cell: 1 to 16.
  Parts(const Flow& flow, const VehicleContract& contract, int per_cell);

  int nx() const { return nx_; }
  int ny() const { return ny_; }
  std::size_t size() const { return kind_.size(); }
  std::size_t index(PartPlace p) const {
    return static_cast<std::size_t>(p.iy) * static_cast<std::size_t>(nx_) +
           static_cast<std::size_t>(p.ix);
  }
  PartPlace place(std::size_t index) const {
    const auto n = static_cast<std::size_t>(nx_);
    return {static_cast<int>(index % n), static_cast<int>(index / n)};
  }
  PartKind kind(PartPlace p) const {
    const bool inside = p.ix >= 0 && p.ix < nx_ && p.iy >= 0 && p.iy < ny_;
    return inside ? kind_[index(p)] : PartKind::outside;
  }
  /// Its parts are wild.
  void claim_nothing(Cell cell);
  /// Nothing is claimed of who comes to the goal.
  void close_goal();
  /// Of an ordinary part.
  const HeadingArc& arc(PartPlace p) const { return arc_[index(p)]; }

  double part_m() const { return part_m_; }
  SizeRange turn_radius() const { return turn_radius_; }  ///< in parts
  double hold_side_rad() const { return hold_side_rad_; }
  double side_uncertain_rad() const { return side_uncertain_rad_; }

 private:
  int nx_;
  int ny_;
  double part_m_;
  SizeRange turn_radius_;
  double hold_side_rad_;
  double side_uncertain_rad_;
  int per_cell_;
  std::vector<PartKind> kind_;
  std::vector<HeadingArc> arc_;
};

}  // namespace fairway
