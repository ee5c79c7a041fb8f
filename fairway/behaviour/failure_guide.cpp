#include "fairway/behaviour/failure_guide.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>

#include "fairway/base/error.hpp"

namespace fairway {
namespace {

/// A step from near the edge of a bin may end in a bin that others reached: then so many more of
/// its kind are tried, or flights at a shallow angle to an edge would never get away from it.
constexpr int most_repeats = 3;
constexpr double bin_rad = two_pi / FailureGuide::headings;

/// A state from which failure is so many steps away.
struct Reached {
  Vec2 place;
  Vec2 unit;
  double heading_rad;
};

std::uint8_t code_of(int steps) {  // near ones in single steps, far ones in eights
  return static_cast<std::uint8_t>(steps < 160 ? steps : std::min(254, 160 + (steps - 160) / 8));
}

double wrapped(double angle_rad) {
  if (angle_rad > pi) return angle_rad - two_pi;
  return angle_rad <= -pi ? angle_rad + two_pi : angle_rad;
}

/// The states one step before one, by a few kinds of steps.
class StepsBack {
 public:
  explicit StepsBack(const BehaviourChoices& choices)
      : choices_(choices),
        flow_(choices.flow()),
        contract_(choices.contract()),
        step_m_(choices.step_m()),
        per_cell_m_(1.0 / flow_.grid.cell_m),
        // A little, so that without an error of position neighbours' commands count at borders.
        reach_cells_(std::max(contract_.command_error_m * per_cell_m_, 0.02)) {
    const auto [least, most] = contract_.turn_radius_m;
    for (const double radius_m : {least, most, 2.5 * least, 7.0 * least}) {
      for (const int side : {1, -1}) {
        const double angle = step_m_ / radius_m;
        turns_[kinds_++] = {side,           radius_m, angle, std::cos(angle), std::sin(angle),
                            radius_m > most};
      }
    }
  }

  /// From the heading to the commands that may be in force about the end of the step, [-pi, pi].
  void gather(const Reached& to) {
    commands_ = 0;
    const Grid& g = flow_.grid;
    const double ahead_m = contract_.look_ahead_m - 0.5 * step_m_;
    const double x = (to.place.x + ahead_m * to.unit.x - g.x0_m) * per_cell_m_;
    const double y = (to.place.y + ahead_m * to.unit.y - g.y0_m) * per_cell_m_;
    const auto lowest = [&](double at, int count) {
      return std::clamp(static_cast<int>(at - reach_cells_), 0, count - 1);
    };
    const auto highest = [&](double at, int count) {
      return std::clamp(static_cast<int>(at + reach_cells_), 0, count - 1);
    };
    const int x0 = lowest(x, g.nx);
    const int x1 = highest(x, g.nx);
    const int y1 = highest(y, g.ny);
    const double most = reach_cells_ * reach_cells_;
    for (int iy = lowest(y, g.ny); iy <= y1; ++iy) {
      const double dy = std::max({0.0, iy - y, y - iy - 1.0});
      const float* row = choices_.commands().data() + g.index({0, iy});
      for (int ix = x0; ix <= x1; ++ix) {
        const double dx = std::max({0.0, ix - x, x - ix - 1.0});
        if (dx * dx + dy * dy > most || commands_ == off_.size()) continue;
        const double command = static_cast<double>(row[ix]);
        if (!std::isnan(command)) off_[commands_++] = wrapped(command - to.heading_rad);
      }
    }
  }

  static constexpr std::size_t straight = 8;
  static constexpr std::size_t kinds = 9;

  /// Whether a step of that kind may lead to `to`, and from where.
  bool step(std::size_t kind, const Reached& to, Reached& from) const {
    if (kind == straight) {
      if (!is_straight_allowed()) return false;
      from = {to.place - step_m_ * to.unit, to.unit, to.heading_rad};
    } else {
      const Turn& turn = turns_[kind];
      if (!is_allowed(turn)) return false;
      from.unit = {to.unit.x * turn.cosine + turn.side * to.unit.y * turn.sine,
                   to.unit.y * turn.cosine - turn.side * to.unit.x * turn.sine};
      from.heading_rad = wrapped(to.heading_rad - turn.side * turn.angle_rad);
      from.place = to.place - turn.side * turn.radius_m *
                                  Vec2{to.unit.y - from.unit.y, from.unit.x - to.unit.x};
    }
    return flow_.kind_at(flow_.grid.cell_of(from.place)) == CellKind::ordinary &&
           choices_.met(from.place, to.place) != CellKind::target;
  }

 private:
  struct Turn {
    int side = 0;
    double radius_m = 0.0;
    double angle_rad = 0.0;
    double cosine = 1.0;
    double sine = 0.0;
    bool follows = false;  ///< no turn of the contract, but what following commands comes to
  };

  /// Some command lies ahead of the whole turn, by no more than the smaller angle.
  bool is_allowed(const Turn& turn) const {
    const double error = contract_.heading_error_rad;
    const double most =
        turn.follows ? error : pi + contract_.side_uncertain_rad + error - turn.angle_rad;
    for (std::size_t i = 0; i < commands_; ++i) {
      const double left = turn.side * off_[i];  // after the turn
      if (left >= (turn.follows ? -error - turn.angle_rad : -error) && left <= most) return true;
    }
    return false;
  }
  bool is_straight_allowed() const {
    const double error = std::max(contract_.heading_error_rad, 0.02);
    for (std::size_t i = 0; i < commands_; ++i) {
      if (std::abs(off_[i]) <= error) return true;
    }
    return false;
  }

  const BehaviourChoices& choices_;
  const Flow& flow_;
  const VehicleContract& contract_;
  double step_m_;
  double per_cell_m_;
  double reach_cells_;
  std::array<Turn, 8> turns_;
  std::size_t kinds_ = 0;
  std::array<double, 128> off_{};
  std::size_t commands_ = 0;
};

/// States that are about to fail: along all sides of ordinary cells with an obstacle, or the
/// outside, behind them.
template <typename Visit>
void visit_edges(const Flow& flow, int per_side, const Visit& visit) {
  const Grid& g = flow.grid;
  for (std::size_t i = 0; i < g.size(); ++i) {
    if (flow.kind[i] != CellKind::ordinary) continue;
    const Cell c = g.cell_at(i);
    for (int side = 0; side < 4; ++side) {
      const Vec2 out{side == 0   ? 1.0
                     : side == 2 ? -1.0
                                 : 0.0,
                     side == 1   ? 1.0
                     : side == 3 ? -1.0
                                 : 0.0};
      const CellKind kind =
          flow.kind_at({c.ix + static_cast<int>(out.x), c.iy + static_cast<int>(out.y)});
      if (kind != CellKind::obstacle && kind != CellKind::outside) continue;
      for (int k = 0; k < per_side; ++k) {
        const double along = (k + 0.5) / per_side - 0.5;
        const Vec2 at = g.center(c) + g.cell_m * (0.499 * out + along * left_of(out));
        for (int h = 0; h < FailureGuide::headings; ++h) {
          const double heading = -pi + (h + 0.5) * bin_rad;
          const Vec2 unit{std::cos(heading), std::sin(heading)};
          if (dot(unit, out) > 0.05) visit(Reached{at, unit, heading});
        }
      }
    }
  }
}

int bins_along(const FailureGuideOptions& options, std::size_t cells) {
  require(options.per_cell >= 0 && options.per_cell <= 8, "FailureGuide: expected 0 to 8 per cell");
  if (options.per_cell > 0) return options.per_cell;
  return cells <= 100'000 ? 4 : cells <= 400'000 ? 2 : 1;
}

}  // namespace

FailureGuide::FailureGuide(const BehaviourChoices& choices, const FailureGuideOptions& options) {
  const Grid& g = choices.flow().grid;
  const int per_cell = bins_along(options, g.size());
  nx_ = g.nx * per_cell;
  ny_ = g.ny * per_cell;
  x0_m_ = g.x0_m;
  y0_m_ = g.y0_m;
  bins_per_m_ = per_cell / g.cell_m;
  row_of_.assign(g.size() * static_cast<std::size_t>(per_cell * per_cell), 0);
  rows_.emplace_back().reserve(rows_together);
  rows_.back().emplace_back().fill(never);
  // Those that are about to fail are many: they are made twice, not kept.
  std::vector<bool> is_first;  // in its bin
  visit_edges(choices.flow(), per_cell, [&](const Reached& state) {
    is_first.push_back(add(state.place, state.heading_rad, code_of(0)));
  });
  // Queues give back their memory as they are emptied.
  std::deque<Reached> reached;
  std::deque<Reached> next;
  StepsBack back(choices);
  int steps = 1;
  const auto go_back_from = [&](const Reached& to) {
    bool moved = true;
    for (std::size_t kind = 0; kind < StepsBack::kinds; ++kind) {
      Reached at = to;
      Reached from;
      for (int again = 0; again < most_repeats; ++again, at = from) {
        if (again > 0 || moved) back.gather(at);
        moved = again > 0;
        if (!back.step(kind, at, from)) break;
        if (!add(from.place, from.heading_rad, code_of(steps + again))) continue;
        next.push_back(from);
        break;
      }
    }
  };
  std::size_t visited = 0;
  visit_edges(choices.flow(), per_cell, [&](const Reached& state) {
    if (is_first[visited++]) go_back_from(state);
  });
  for (++steps; !next.empty(); ++steps) {
    reached.swap(next);
    for (; !reached.empty(); reached.pop_front()) go_back_from(Reached(reached.front()));
  }
}

/// False when it is there already, or there is no such bin.
bool FailureGuide::add(Vec2 place, double heading_rad, std::uint8_t level) {
  const std::size_t at = place_number(place);
  if (at >= row_of_.size()) return false;
  std::uint32_t& row = row_of_[at];
  if (row == 0) {
    if (rows_.back().size() == rows_together) rows_.emplace_back().reserve(rows_together);
    row = static_cast<std::uint32_t>((rows_.size() - 1) * rows_together + rows_.back().size());
    rows_.back().emplace_back().fill(never);
  }
  std::uint8_t& known =
      rows_[row / rows_together][row % rows_together][heading_number(heading_rad)];
  if (known != never) return false;
  known = level;
  return true;
}

}  // namespace fairway
