#include "fairway/behaviour/proved_ends.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace fairway {
namespace {

constexpr double angle_margin_rad = 0x1p-46;
constexpr double unit_error = 0x1p-50;  // of sines and cosines, and of each sum, relative

/// Which side is held after a step; `refused` when the step is not proved to be allowed.
enum class Side3 : std::int8_t { right = -1, none = 0, left = 1, refused = 2 };

class StepCheck {
 public:
  StepCheck(const Flow& flow, std::span<const float> commands, const VehicleContract& contract,
            const State& start)
      : flow_(flow),
        grid_(flow.grid),
        commands_(commands),
        contract_(contract),
        place_(start.position_m),
        heading_rad_(start.heading.rad()) {
    size_m_ = std::abs(grid_.x0_m) + std::abs(grid_.y0_m) + grid_.width_m() + grid_.height_m();
    slack_m_ = unit_error * size_m_;  // of comparing with the lines of the grid
    meet(place_, place_, slack_m_);
  }

  bool add(const BehaviourStep& step) {
    if (!is_well_formed(step)) return false;
    const double turned =
        step.turn == 0 ? 0.0 : turn_angle(heading_rad_, step.heading_rad, step.turn);
    if (step.turn != 0 && !(turned > 0.0 && turned < pi)) return false;
    const double length_m =
        (step.turn == 0 ? step.length_m : step.radius_m * turned) * (1.0 + 0x1p-40);
    const Vec2 end = place_ + move_of(step, heading_rad_);
    // Of the move (radius or length times two rounded sines), and of adding it.
    slack_m_ += unit_error * (4.0 * (step.turn == 0 ? step.length_m : step.radius_m) +
                              std::abs(end.x) + std::abs(end.y));
    if (!(std::abs(end.x) + std::abs(end.y) < 0x1p30 * grid_.cell_m + size_m_)) return false;
    const Side3 after = side_after(step, turned, end);
    if (after == Side3::refused) return false;
    held_ = after;
    meet(place_, end, bulge_of(step.radius_m, turned) + slack_m_);
    place_ = end;
    heading_rad_ = step.heading_rad;
    flown_m_ += length_m;
    return true;
  }

  /// The kinds of cells that some position so far may have been in, as bits.
  unsigned met() const { return met_; }
  double flown_m() const { return flown_m_; }

  /// The kind of cell that the present position surely is in; ordinary when there is none.
  CellKind surely_in() const {
    const auto [x0, x1, y0, y1] = cells_within(place_, place_, 2.0 * slack_m_);
    if (x1 < 0 || y1 < 0 || x0 >= grid_.nx || y0 >= grid_.ny) return CellKind::outside;
    return x0 == x1 && y0 == y1 ? flow_.kind_at({x0, y0}) : CellKind::ordinary;
  }

 private:
  struct Cells {
    int x0, x1, y0, y1;
  };

  bool is_well_formed(const BehaviourStep& step) const {
    if (!(std::abs(step.heading_rad) <= pi)) return false;
    if (step.turn == 0) {
      return step.heading_rad == heading_rad_ && step.length_m > 0.0 &&
             std::isfinite(step.length_m);
    }
    return (step.turn == 1 || step.turn == -1) && step.radius_m >= contract_.turn_radius_m.least &&
           step.radius_m <= contract_.turn_radius_m.most &&
           std::abs(step.error_rad) <= contract_.heading_error_rad;
  }

  /// How far a turn may lie from its chord (lemma 1).
  static double bulge_of(double radius_m, double turned) {
    return 0.125 * radius_m * turned * turned * (1.0 + 0x1p-40);
  }

  /// All cells, of the grid or not, that meet the box around two points, grown by `by_m`.
  Cells cells_within(Vec2 a, Vec2 b, double by_m) const {
    const auto number = [&](double at) { return static_cast<int>(std::floor(at / grid_.cell_m)); };
    const double far = by_m + unit_error * size_m_;
    return {number(std::min(a.x, b.x) - grid_.x0_m - far),
            number(std::max(a.x, b.x) - grid_.x0_m + far),
            number(std::min(a.y, b.y) - grid_.y0_m - far),
            number(std::max(a.y, b.y) - grid_.y0_m + far)};
  }

  /// Notes the kinds of all cells that a position on the way may touch.
  void meet(Vec2 from, Vec2 to, double by_m) {
    const auto [x0, x1, y0, y1] = cells_within(from, to, by_m);
    if (x0 < 0 || y0 < 0 || x1 >= grid_.nx || y1 >= grid_.ny) {
      met_ |= 1U << static_cast<unsigned>(CellKind::outside);
    }
    for (int iy = std::max(y0, 0); iy <= std::min(y1, grid_.ny - 1); ++iy) {
      for (int ix = std::max(x0, 0); ix <= std::min(x1, grid_.nx - 1); ++ix) {
        met_ |= 1U << static_cast<unsigned>(flow_.kind_at({ix, iy}));
      }
    }
  }

  /// Lemmas 1 and 2 find the cells whose commands must justify the step; 3 and 4 judge it.
  Side3 side_after(const BehaviourStep& step, double turned, Vec2 end) const {
    const double ahead_m = contract_.look_ahead_m;
    const auto ahead_of = [&](Vec2 p, double heading_rad) {
      return p + ahead_m * Vec2{std::cos(heading_rad), std::sin(heading_rad)};
    };
    const Vec2 a = ahead_of(place_, heading_rad_);
    const Vec2 b = ahead_of(end, step.heading_rad);
    const double by_m =
        bulge_of(step.turn == 0 ? 0.0 : std::hypot(step.radius_m, ahead_m), turned) + slack_m_ +
        unit_error * 4.0 * ahead_m;
    if (step.cell != own_cell) {
      if (step.cell >= commands_.size()) return Side3::refused;
      const double far_m = std::max(distance_from(a, step.cell), distance_from(b, step.cell));
      if (!(far_m + by_m <= contract_.command_error_m * (1.0 - 0x1p-40))) return Side3::refused;
      return side_under(step, turned, step.cell, held_);
    }
    const auto [x0, x1, y0, y1] = cells_within(a, b, by_m);
    const bool all_inside = x0 >= 0 && y0 >= 0 && x1 < grid_.nx && y1 < grid_.ny;
    if (!all_inside && ahead_m > 0.0) return Side3::refused;
    // Another cell's command may have made the vehicle forget the side before it enters this one.
    const bool one = x0 == x1 && y0 == y1;
    const Side3 held = one || held_ == static_cast<Side3>(-step.turn) ? held_ : Side3::none;
    std::optional<Side3> all;
    for (int iy = std::max(y0, 0); iy <= std::min(y1, grid_.ny - 1); ++iy) {
      for (int ix = std::max(x0, 0); ix <= std::min(x1, grid_.nx - 1); ++ix) {
        // In an obstacle, in a goal cell and outside the flight has ended.
        if (ahead_m == 0.0 && flow_.kind_at({ix, iy}) != CellKind::ordinary) continue;
        const Side3 after = side_under(step, turned, grid_.index({ix, iy}), held);
        if (all && after != *all) return Side3::refused;
        all = after;
      }
    }
    return all.value_or(Side3::none);
  }

  /// From `p` to a point surely inside the cell.
  double distance_from(Vec2 p, std::size_t cell) const {
    const Vec2 corner = grid_.corner(grid_.cell_at(cell));
    const double inset = 0x1p-20 * grid_.cell_m;
    const auto to = [&](double at, double low) {
      return at - std::clamp(at, low + inset, low + grid_.cell_m - inset);
    };
    const Vec2 apart{to(p.x, corner.x), to(p.y, corner.y)};
    return norm(apart) * (1.0 + 0x1p-40) + unit_error * size_m_;
  }

  Side3 side_under(const BehaviourStep& step, double turned, std::size_t cell, Side3 held) const {
    const double command = static_cast<double>(commands_[cell]);
    if (!(std::abs(command) <= pi)) return Side3::refused;
    if (step.turn == 0) {
      const double off = std::abs(std::remainder(command - heading_rad_, two_pi));
      const bool aligned =
          command == heading_rad_ || off <= contract_.heading_error_rad - angle_margin_rad;
      return aligned ? Side3::none : Side3::refused;
    }
    const auto side = static_cast<Side3>(step.turn);
    const auto other = static_cast<Side3>(-step.turn);
    const double hold = contract_.hold_side_rad;
    // A turn that ends at the command itself does so exactly.
    const bool to_command = step.error_rad == 0.0 && step.heading_rad == command;
    const double before = to_command ? turned : angle_to(command + step.error_rad, step.turn);
    const double after = to_command ? 0.0 : before - turned;
    if (!to_command && !(after >= angle_margin_rad)) return Side3::refused;
    if (before > hold - angle_margin_rad) {  // it may be behind
      const double most =
          std::min(two_pi - hold, held == side ? two_pi : pi + contract_.side_uncertain_rad);
      if (held == other || !(before <= most - angle_margin_rad)) return Side3::refused;
    }
    if (after > hold + angle_margin_rad) return side;
    return after < hold - angle_margin_rad ? Side3::none : Side3::refused;
  }

  double angle_to(double command_rad, int side) const {
    const double angle = std::fmod(side * (command_rad - heading_rad_), two_pi);
    return angle < 0.0 ? angle + two_pi : angle;
  }

  const Flow& flow_;
  const Grid& grid_;
  std::span<const float> commands_;
  const VehicleContract& contract_;
  Vec2 place_;
  double heading_rad_;
  Side3 held_ = Side3::none;
  double size_m_ = 0.0;
  double slack_m_ = 0.0;
  double flown_m_ = 0.0;
  unsigned met_ = 0;
};

}  // namespace

ProvedEnds proved_ends(const Flow& flow, std::span<const float> commands,
                       const VehicleContract& contract, const BehaviourFlight& flight) {
  ProvedEnds proved;
  const Vec2 p = flight.start.position_m;
  const double far_m = 0x1p30 * flow.grid.cell_m;
  if (!(std::abs(p.x - flow.grid.x0_m) < far_m && std::abs(p.y - flow.grid.y0_m) < far_m) ||
      commands.size() != flow.grid.size()) {
    proved.admissible = false;
    return proved;
  }
  StepCheck check(flow, commands, contract, flight.start);
  for (const BehaviourStep& step : flight.steps) {
    if (!check.add(step)) {
      proved.admissible = false;
      return proved;
    }
  }
  proved.length_m = check.flown_m();
  if (check.surely_in() == CellKind::ordinary) return proved;
  const auto add = [&](CellKind kind, Verdict verdict) {
    if ((check.met() >> static_cast<unsigned>(kind) & 1U) == 0) return;
    proved.ends = static_cast<std::uint8_t>(proved.ends | 1U << static_cast<unsigned>(verdict));
  };
  add(CellKind::target, Verdict::reach);
  add(CellKind::obstacle, Verdict::collide);
  add(CellKind::outside, Verdict::leave);
  return proved;
}

bool is_witness(const Flow& flow, std::span<const float> commands, const VehicleContract& contract,
                const BehaviourFlight& flight) {
  const ProvedEnds proved = proved_ends(flow, commands, contract, flight);
  return proved.admissible && proved.surely_fails();
}

}  // namespace fairway
