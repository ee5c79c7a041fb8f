// An oracle for tests and falsification: flights over a whole plan in a wide number type, cell by
// cell (vehicle/wide_motion.hpp), with the places where they meet the section.
//
// Where the model leaves a choice, or two events cannot be distinguished, `Choices` picks.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "fairway/vehicle/testing/wide_motion.hpp"
#include "fairway/verify/flow.hpp"
#include "fairway/verify/verdict.hpp"

namespace fairway {

/// Where a flight meets the section, or how it ends (then `section` is none).
template <typename Real>
struct WideMeeting {
  static constexpr std::size_t none = ~std::size_t{0};
  std::size_t section = none;
  Real along_m{0};
  Verdict end = Verdict::undecided;  ///< undecided: unknown within the allowed crossings
  long double length_m = 0;
  std::uint64_t crossings = 0;
};

/// The commands of a flow as vectors.
template <typename Real>
struct WideCommands {
  const Flow& flow;
  std::vector<WideVec<Real>> unit;

  explicit WideCommands(const Flow& flow_) : flow(flow_), unit(flow_.grid.size()) {
    for (std::size_t c = 0; c < unit.size(); ++c) {
      if (std::isnan(flow.heading_rad[c])) continue;
      unit[c] = wide_unit<Real>(static_cast<double>(flow.heading_rad[c]));
    }
  }
};

template <typename Real>
class WideFlight {
 public:
  /// Starts at `p`, in the coordinates of cell (ix, iy). `choice(n)` picks one of n, 0 .. n - 1.
  WideFlight(const WideCommands<Real>& commands, int ix, int iy, const WideVec<Real>& p,
             const WideVec<Real>& u, std::function<std::size_t(std::size_t)> choice = {})
      : commands_(commands),
        flow_(commands.flow),
        cell_(commands.flow.grid.cell_m, commands.flow.vehicle.turn_radius_m),
        ix_(ix),
        iy_(iy),
        p_(p),
        u_(u),
        choice_(std::move(choice)) {}

  /// Flies on to the next meeting with the section, or to the end.
  WideMeeting<Real> fly(std::uint64_t most_crossings) {
    WideMeeting<Real> meeting;
    int turns = 0;  // consecutive cells left on the current circle
    int circle = 0;
    for (; meeting.crossings < most_crossings; ++meeting.crossings) {
      const std::size_t here = flow_.grid.index({ix_, iy_});
      const WideExit<Real> exit = cross(here);
      length_m_ += exit.length;
      meeting.length_m = length_m_;
      turns = exit.turn != 0 && exit.turn == circle ? turns + 1 : 0;
      circle = exit.turn;
      const int s = static_cast<int>(exit.side);
      ix_ += s == 0 ? 1 : s == 2 ? -1 : 0;
      iy_ += s == 1 ? 1 : s == 3 ? -1 : 0;
      const Real d(flow_.grid.cell_m);
      p_ = exit.p;
      (s % 2 == 0 ? p_.x : p_.y) = s < 2 ? Real(0) : d;
      u_ = exit.u;
      const CellKind kind = flow_.kind_at({ix_, iy_});
      if (kind != CellKind::ordinary) {
        meeting.end = kind == CellKind::target     ? Verdict::reach
                      : kind == CellKind::obstacle ? Verdict::collide
                                                   : Verdict::leave;
        return meeting;
      }
      if (is_aligned(here)) {
        u_ = commands_.unit[here];
        meeting.section = 4 * here + static_cast<std::size_t>(s);
        meeting.along_m = s % 2 == 0 ? exit.p.y : exit.p.x;
        return meeting;
      }
      // A circle crosses a line at most twice: it cannot cross this many borders.
      if (turns > 8.0 * flow_.vehicle.turn_radius_m / flow_.grid.cell_m + 16.0) {
        meeting.end = Verdict::trapped;
        return meeting;
      }
    }
    return meeting;
  }

  /// Where it is now, in the cell that it is about to cross.
  int ix() const { return ix_; }
  int iy() const { return iy_; }
  const WideVec<Real>& position() const { return p_; }
  const WideVec<Real>& heading() const { return u_; }

  /// To the end, over any number of meetings; trapped when one repeats within rounding.
  WideMeeting<Real> fly_to_end(std::uint64_t most_crossings) {
    WideMeeting<Real> kept;
    std::uint64_t left = 1;
    std::uint64_t period = 1;
    std::uint64_t crossings = 0;
    long double kept_at_m = 0;
    while (crossings < most_crossings) {
      WideMeeting<Real> now = fly(most_crossings - crossings);
      crossings += now.crossings + 1;
      now.crossings = crossings;
      if (now.section == WideMeeting<Real>::none) return now;
      Real off = now.along_m - kept.along_m;
      if (off < 0) off = -off;
      // A closed curve of curvature at most 1 / r is at least as long as its circle.
      if (now.section == kept.section && off < Real(1e-22) * Real(flow_.grid.cell_m) &&
          now.length_m - kept_at_m > 6.28L * flow_.vehicle.turn_radius_m) {
        now.section = WideMeeting<Real>::none;
        now.end = Verdict::trapped;
        return now;
      }
      if (--left == 0) {
        period *= 2;
        left = period;
        kept = now;
        kept_at_m = now.length_m;
      }
    }
    WideMeeting<Real> unknown;
    unknown.length_m = length_m_;
    unknown.crossings = crossings;
    return unknown;
  }

 private:
  /// The heading is the cell's command, up to the rounding of this arithmetic.
  bool is_aligned(std::size_t cell) const {
    if (std::isnan(flow_.heading_rad[cell])) return false;
    const WideVec<Real>& command = commands_.unit[cell];
    const Real off = wide_cross(u_, command);
    const Real least(1e-22);
    return off < least && off > -least && wide_dot(u_, command) > 0;
  }
  WideExit<Real> cross(std::size_t cell) {
    WideExits<Real> exits;
    if (std::isnan(flow_.heading_rad[cell])) {
      cell_.straight(p_, u_, {}, exits);
    } else {
      const WideVec<Real>& command = commands_.unit[cell];
      int turn = WideCell<Real>::turn_of(u_, command);
      if (turn == 2) turn = choose(2) == 0 ? 1 : -1;
      if (turn == 0) {
        WideExit<Real> exit;
        exit.aligned = true;
        cell_.straight(p_, u_, exit, exits);
      } else {
        exits = cell_.turning(p_, u_, command, turn);
      }
    }
    return exits.of[exits.count > 1 ? choose(exits.count) : 0];
  }
  std::size_t choose(std::size_t n) { return choice_ ? choice_(n) : 0; }

  const WideCommands<Real>& commands_;
  const Flow& flow_;
  WideCell<Real> cell_;
  int ix_;
  int iy_;
  WideVec<Real> p_;
  WideVec<Real> u_;
  std::function<std::size_t(std::size_t)> choice_;
  long double length_m_ = 0;
};

}  // namespace fairway
