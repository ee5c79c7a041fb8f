// The steps that a contract allows at one state: those that BehaviourChoices offers.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "fairway/base/short_list.hpp"
#include "fairway/behaviour/behaviour_choices.hpp"
#include "fairway/behaviour/cells_around.hpp"

namespace fairway {

inline constexpr double choice_margin_rad = 1e-11;

inline double into_range(double angle_rad) {
  if (angle_rad > pi) return angle_rad - two_pi;
  return angle_rad <= -pi ? angle_rad + two_pi : angle_rad;
}

inline Vec2 turned(Vec2 unit, double cosine, double sine) {
  return {unit.x * cosine - unit.y * sine, unit.x * sine + unit.y * cosine};
}

/// The steps from one state.
class ChoicesAt {
 public:
  ChoicesAt(const BehaviourChoices& all, const BehaviourState& from, BehaviourChoiceList& choices)
      : all_(all), grid_(all.flow_.grid), contract_(all.contract_), from_(from), choices_(choices) {
    choose_length();
  }
  void add_all();
  /// Of the first kind in this order that is allowed.
  void add_first(const std::array<StepKind, step_kinds>& order);

 private:
  /// A command that may be in force at the state.
  struct Option {
    std::size_t cell;
    double command_rad;
    double left_rad;  ///< to the command, counted to the left, [0, 2 pi)
    Vec2 corner;      ///< of the cell
  };

  Vec2 ahead_of(const BehaviourState& s) const { return s.place + contract_.look_ahead_m * s.unit; }
  /// How far a step may lie from its chord, as lemma 1 of proved_ends has it.
  double bulge_m(double length_m) const {
    const double radius = contract_.turn_radius_m.least;
    const double angle = length_m / radius;
    return 0.125 * (radius + contract_.look_ahead_m) * angle * angle;
  }

  /// Either the error of position allows another cell's command during a whole step, or the step is
  /// in one cell, or it is so short that all the cells it may be in can be asked.
  void choose_length() {
    const double error_m = contract_.command_error_m;
    const Vec2 at = ahead_of(from_);
    length_m_ = all_.step_m_;
    for (int halved = 0; halved < BehaviourChoices::lengths; ++halved, length_m_ *= 0.5) {
      halved_ = static_cast<std::size_t>(halved);
      const double moved =
          length_m_ * (1.0 + contract_.look_ahead_m / contract_.turn_radius_m.least);
      const double around = moved + error_m + all_.margin_m_;
      const CellRange cells = cells_around(grid_, at, at, around);
      reach_m_ = error_m - bulge_m(length_m_) - all_.margin_m_;
      own_ = cells.is_one() || halved == BehaviourChoices::lengths - 1;
      if (own_ || reach_m_ > 0.5 * length_m_) {
        gather(own_ ? cells : cells_around(grid_, at, at, reach_m_), at);
        return;
      }
    }
  }

  void gather(const CellRange& cells, Vec2 at) {
    const bool inside =
        cells.x0 >= 0 && cells.y0 >= 0 && cells.x1 < grid_.nx && cells.y1 < grid_.ny;
    if (own_ && !inside && contract_.look_ahead_m > 0.0) return;
    for (int iy = std::max(cells.y0, 0); iy <= std::min(cells.y1, grid_.ny - 1); ++iy) {
      for (int ix = std::max(cells.x0, 0); ix <= std::min(cells.x1, grid_.nx - 1); ++ix) {
        const std::size_t cell = grid_.index({ix, iy});
        const Vec2 corner = grid_.corner({ix, iy});
        // Where the flight has ended nothing needs to be justified.
        const bool ended = all_.flow_.kind[cell] != CellKind::ordinary;
        if (own_ && ended && contract_.look_ahead_m == 0.0) continue;
        if (!own_ && distance_from(at, corner) > reach_m_) continue;
        const double command = static_cast<double>(all_.commands_[cell]);
        if (std::isnan(command)) return;
        const double left = command - from_.heading_rad;
        const Option option{cell, command, left < 0.0 ? left + two_pi : left, corner};
        if (!options_.add(option)) return;
      }
    }
  }

  double distance_from(Vec2 p, Vec2 corner) const {
    const double far = grid_.cell_m - all_.margin_m_;
    const auto to = [&](double at, double low) {
      return std::max({0.0, low + all_.margin_m_ - at, at - low - far});
    };
    return norm({to(p.x, corner.x), to(p.y, corner.y)});
  }

  bool is_in_force_at(const Option& option, const BehaviourState& end) const {
    return own_ || distance_from(ahead_of(end), option.corner) <= reach_m_;
  }

  double towards(const Option& option, int side) const {
    if (side > 0) return option.left_rad;
    return option.left_rad == 0.0 ? 0.0 : two_pi - option.left_rad;
  }

  /// The angle, counted to `side`, that a command may lie away at most (rule 3).
  double most_behind(int side) const {
    const double hold = contract_.hold_side_rad;
    if (from_.held == -side) return hold;
    if (from_.held == side && (!own_ || options_.size() == 1)) return two_pi - hold;
    return std::min(two_pi - hold, pi + contract_.side_uncertain_rad);
  }

  /// A turn by a whole step; where it ends is computed when it is asked for.
  class WholeTurn {
   public:
    WholeTurn(const ChoicesAt& at, int side, const BehaviourChoices::StepTurn& turn)
        : at_(at), side_(side), turn_(turn) {}
    int side() const { return side_; }
    double radius_m() const { return turn_.radius_m; }
    double angle_rad() const { return turn_.angle_rad; }
    const BehaviourState& end() {
      if (!is_known_) {
        end_ = at_.turn(side_, turn_.radius_m,
                        turned(at_.from_.unit, turn_.cosine, side_ * turn_.sine),
                        at_.from_.heading_rad + side_ * turn_.angle_rad);
        is_known_ = true;
      }
      return end_;
    }

   private:
    const ChoicesAt& at_;
    int side_;
    const BehaviourChoices::StepTurn& turn_;
    bool is_known_ = false;
    BehaviourState end_;
  };

  void add_turns(int side, const BehaviourChoices::StepTurn& step) {
    const double hold = contract_.hold_side_rad;
    const double most = most_behind(side) - choice_margin_rad;
    const double angle = step.angle_rad;
    WholeTurn turn(*this, side, step);
    const bool ahead = add_turn(turn, angle + choice_margin_rad,
                                std::min(most, hold + angle - choice_margin_rad), 0);
    const bool behind =
        from_.held != -side && add_turn(turn, hold + angle + choice_margin_rad, most, side);
    if (!ahead && !behind) add_aligning_turn(side, step.radius_m, angle);
  }

  BehaviourState turn(int side, double radius_m, Vec2 end_unit, double heading_rad) const {
    BehaviourState end;
    end.unit = end_unit;
    end.heading_rad = into_range(heading_rad);
    end.place =
        from_.place + side * radius_m * Vec2{end.unit.y - from_.unit.y, from_.unit.x - end.unit.x};
    return end;
  }
  BehaviourState turn_by(int side, double radius_m, double angle, double heading_rad) const {
    const Vec2 unit = turned(from_.unit, std::cos(angle), side * std::sin(angle));
    return turn(side, radius_m, unit, heading_rad);
  }

  /// A whole step towards a command that lies `least` to `most` away, to this side.
  bool add_turn(WholeTurn& turn, double least, double most, int held) {
    if (least > most) return false;
    const int side = turn.side();
    const auto add = [&](std::size_t cell, double shift) {
      const double error =
          std::clamp(side * shift, -contract_.heading_error_rad, contract_.heading_error_rad);
      BehaviourChoice& choice = choices_.grow();
      choice.step = {side, turn.radius_m(), 0.0, turn.end().heading_rad, cell, error};
      choice.end = turn.end();
      choice.end.held = held;
      return true;
    };
    if (own_) return add_turn_of_all(side, least, most, add);
    for (const Option& option : options_) {
      const double away = towards(option, side);
      for (const double u : {away, away - two_pi}) {
        const double shift = std::clamp(u, least, most) - u;
        if (std::abs(shift) > contract_.heading_error_rad) continue;
        if (is_in_force_at(option, turn.end())) return add(option.cell, shift);
      }
    }
    return false;
  }

  /// The same shift for the commands of all cells that the step may be in.
  template <typename Add>
  bool add_turn_of_all(int side, double least, double most, const Add& add) {
    double lo = -contract_.heading_error_rad;
    double hi = contract_.heading_error_rad;
    for (const Option& option : options_) {
      double u = towards(option, side);
      if (u > most + contract_.heading_error_rad) u -= two_pi;
      lo = std::max(lo, least - u);
      hi = std::min(hi, most - u);
    }
    return lo <= hi && add(own_cell, std::clamp(0.0, lo, hi));
  }

  /// A shorter step, that ends with the farthest command to this side, or within the error of it.
  void add_aligning_turn(int side, double radius_m, double whole_angle) {
    const double error = contract_.heading_error_rad;
    const bool exact = error < 4.0 * choice_margin_rad;
    if (own_ && options_.size() > 1) return;
    for (const Option& option : options_) {
      const double away = towards(option, side);
      for (const double u : {away, away - two_pi}) {
        const double angle = exact ? u : u + error - 2.0 * choice_margin_rad;
        if (!(angle > 1e-9 && angle < whole_angle) || u > contract_.hold_side_rad - error) continue;
        const BehaviourState end = turn_by(
            side, radius_m, angle, exact ? option.command_rad : from_.heading_rad + side * angle);
        if (!is_in_force_at(option, end)) continue;
        choices_.add({{side, radius_m, 0.0, end.heading_rad, own_ ? own_cell : option.cell,
                       exact ? 0.0 : side * error},
                      end,
                      true});
        return;
      }
    }
  }

  void add_straight() {
    BehaviourState end = from_;
    end.place = from_.place + length_m_ * from_.unit;
    end.held = 0;
    std::size_t cell = own_cell;
    int aligned = 0;
    for (const Option& option : options_) {
      const double off = std::min(option.left_rad, two_pi - option.left_rad);
      if (off != 0.0 && off > contract_.heading_error_rad - choice_margin_rad) continue;
      if (!is_in_force_at(option, end)) continue;
      ++aligned;
      if (!own_) cell = option.cell;
    }
    if (own_ ? aligned < options_.size() : aligned == 0) return;
    choices_.add({{0, 0.0, length_m_, from_.heading_rad, cell, 0.0}, end, true});
  }

  /// By the command of the vehicle's own cell, whatever the rounding.
  void add_unproved() {
    const Cell own = grid_.cell_of(ahead_of(from_));
    const Cell cell{std::clamp(own.ix, 0, grid_.nx - 1), std::clamp(own.iy, 0, grid_.ny - 1)};
    const double command = static_cast<double>(all_.commands_[grid_.index(cell)]);
    const double radius_m = contract_.turn_radius_m.least;
    const double length_m = std::max(length_m_, 1e-3 * all_.step_m_);
    double left = std::isnan(command) ? 0.0 : into_range(command - from_.heading_rad);
    const int side = std::abs(left) > contract_.hold_side_rad && from_.held != 0
                         ? from_.held
                         : (left > 0.0) - (left < 0.0);
    if (side != 0 && left * side < 0.0) left += side * two_pi;
    const double angle = std::min(std::abs(left), length_m / radius_m);
    BehaviourChoice& choice = choices_.grow();
    if (angle < 1e-12) {
      BehaviourState end = from_;
      end.place = from_.place + length_m * from_.unit;
      choice = {{0, 0.0, length_m, from_.heading_rad, own_cell, 0.0}, end, false};
    } else {
      const BehaviourState end = turn_by(side, radius_m, angle, from_.heading_rad + side * angle);
      choice = {{side, radius_m, 0.0, end.heading_rad, own_cell, 0.0}, end, false};
    }
    choice.end.held = std::abs(left) - angle > contract_.hold_side_rad ? side : 0;
  }

  const BehaviourChoices& all_;
  const Grid& grid_;
  const VehicleContract& contract_;
  const BehaviourState& from_;
  BehaviourChoiceList& choices_;
  ShortList<Option, 128> options_;
  double length_m_ = 0.0;
  std::size_t halved_ = 0;  ///< how often the step is
  double reach_m_ = 0.0;
  bool own_ = false;  ///< the vehicle's own cell is asked, else any within reach_m_
};

}  // namespace fairway
