// The part of exact flights that decides which cell a state belongs to: the padded table of cells,
// and the ties of the model (starts, corners, touches, headings along a border).
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "fairway/base/error.hpp"
#include "fairway/base/parallel.hpp"
#include "fairway/simulate/exact_flight.hpp"

namespace fairway {

ExactFlights::ExactFlights(const Plan& plan, int mode)
    : grid_(plan.grid),
      vehicle_(plan.vehicle),
      stride_(static_cast<std::size_t>(plan.grid.nx) + 2) {
  require(grid_.nx > 0 && grid_.ny > 0, "a plan has at least one cell");
  require(std::isfinite(grid_.x0_m) && std::isfinite(grid_.y0_m), "the grid's origin is finite");
  require(grid_.cell_m > 0.0 && grid_.cell_m < vehicle_.turn_radius_m &&
              std::isfinite(vehicle_.turn_radius_m),
          "0 < cell side < turning radius");
  require(vehicle_.speed_mps > 0.0 && std::isfinite(vehicle_.speed_mps), "speed > 0");
  require(plan.heading_rad.size() == grid_.size() && plan.region.size() == grid_.size(),
          "a plan's arrays have one entry per cell");
  require(mode >= 0 && static_cast<std::size_t>(mode) <= plan.further_modes() &&
              plan.mode_heading_rad.size() == plan.further_modes() * grid_.size(),
          "the mode is one of the plan's");
  const float* heading_rad =
      mode == 0 ? plan.heading_rad.data()
                : plan.mode_heading_rad.data() + static_cast<std::size_t>(mode - 1) * grid_.size();
  const auto nx = static_cast<std::size_t>(grid_.nx);
  const auto ny = static_cast<std::size_t>(grid_.ny);
  const Direction none = Direction::none();
  cells_.assign(stride_ * (ny + 2),
                {none.unit, std::numeric_limits<float>::quiet_NaN(), Kind::outside});
  for_rows(grid_.ny, [&](int begin, int end) {
    for (auto iy = static_cast<std::size_t>(begin); iy < static_cast<std::size_t>(end); ++iy) {
      for (std::size_t ix = 0; ix < nx; ++ix) {
        CellRecord& cell = cells_[(iy + 1) * stride_ + ix + 1];
        cell.rad = heading_rad[iy * nx + ix];
        if (!std::isnan(cell.rad)) {
          cell.unit = Direction::of(Heading::from_rad(static_cast<double>(cell.rad))).unit;
        }
        const Region region = plan.region[iy * nx + ix];
        cell.kind = region == Region::obstacle ? Kind::obstacle
                    : region == Region::goal   ? Kind::goal
                                               : Kind::open;
      }
    }
  });
}

ExactFlights::Position ExactFlights::locate(const State& start) const {
  const Vec2 p = start.position_m;
  require(std::isfinite(p.x) && std::isfinite(p.y), "a start's position is finite");
  const double d = grid_.cell_m;
  // The padding ring represents the world outside; the closed grid's edge counts as inside.
  const auto along = [d](double x, double x0, int n, double& local) {
    if (x < x0 || x > x0 + n * d) {
      local = 0.5 * d;
      return x < x0 ? -1 : n;
    }
    int i = std::min(static_cast<int>((x - x0) / d), n - 1);
    // The division may round up to the next cell.
    if (x < x0 + i * d) --i;
    if (i + 1 < n && x >= x0 + (i + 1) * d) ++i;
    local = std::clamp(x - (x0 + i * d), 0.0, d);
    return i;
  };
  Position position;
  position.state.heading = Direction::of(start.heading);
  const int ix = along(p.x, grid_.x0_m, grid_.nx, position.state.position_m.x);
  const int iy = along(p.y, grid_.y0_m, grid_.ny, position.state.position_m.y);
  position.place = static_cast<std::size_t>(iy + 1) * stride_ + static_cast<std::size_t>(ix + 1);
  return position;
}

/// For states on a border that are more than a plain crossing (starts, corners, touches): moves the
/// state into the cell its heading points into, and returns what it meets there.
ExactFlights::Kind ExactFlights::settle(Position& position, bool at_start) const {
  const double d = grid_.cell_m;
  Vec2& p = position.state.position_m;
  const Vec2 u = position.state.heading.unit;
  position.slides = false;
  if (at(position.place).kind == Kind::outside) return Kind::outside;

  if (p.x == d && u.x > 0.0) {
    p.x = 0.0;
    position.place += 1;
  } else if (p.x == 0.0 && u.x < 0.0) {
    p.x = d;
    position.place -= 1;
  }
  if (p.y == d && u.y > 0.0) {
    p.y = 0.0;
    position.place += stride_;
  } else if (p.y == 0.0 && u.y < 0.0) {
    p.y = d;
    position.place -= stride_;
  }

  // The closed cells that hold the point: one, two or four. From the ring around the grid the steps
  // lead back inside, as the point lies on the grid's edge.
  const std::ptrdiff_t row = static_cast<std::ptrdiff_t>(stride_);
  const std::ptrdiff_t dx = p.x == 0.0 ? -1 : p.x == d ? 1 : 0;
  const std::ptrdiff_t dy = p.y == 0.0 ? -row : p.y == d ? row : 0;
  const auto kind_at = [&](std::ptrdiff_t step) {
    return cells_[static_cast<std::size_t>(static_cast<std::ptrdiff_t>(position.place) + step)]
        .kind;
  };
  for (const std::ptrdiff_t step : {std::ptrdiff_t{0}, dx, dy, dx + dy}) {
    if (kind_at(step) == Kind::obstacle) return Kind::obstacle;
  }
  const std::ptrdiff_t beside = dx != 0 && u.x == 0.0 ? dx : dy != 0 && u.y == 0.0 ? dy : 0;
  const Kind here = kind_at(0);
  const Kind there = kind_at(beside);
  if (beside == 0 || here == Kind::outside) return here;
  if (there == Kind::outside) {  // along the grid's edge: its command may turn the vehicle out
    const double inwards = cross(u, Vec2{0.5 * d - p.x, 0.5 * d - p.y});
    const int turn = turn_towards(position.state.heading, command_at(position.place));
    return here == Kind::open && turn * inwards < 0.0 ? there : here;
  }
  choose_side(position, beside, at_start);
  return there == Kind::goal ? there : here;
}

/// Heading along the border between two cells: see the conventions in the header.
void ExactFlights::choose_side(Position& position, std::ptrdiff_t beside, bool at_start) const {
  const double d = grid_.cell_m;
  const Vec2 u = position.state.heading.unit;
  const Vec2 p = position.state.position_m;
  // The cell's middle lies to the left of the heading.
  const bool on_left = cross(u, Vec2{0.5 * d - p.x, 0.5 * d - p.y}) > 0.0;
  const auto other = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(position.place) + beside);
  const auto stays = [&](std::size_t place, bool left) {
    const int turn = turn_towards(position.state.heading, command_at(place));
    return left ? turn >= 0 : turn <= 0;
  };
  const bool stays_here = stays(position.place, on_left);
  const bool stays_there = stays(other, !on_left);
  const bool prefers_here = !at_start || on_left;
  position.slides = !stays_here && !stays_there;
  if (prefers_here ? stays_here || !stays_there : stays_here && !stays_there) return;
  position.place = other;
  Vec2& q = position.state.position_m;
  if (u.x == 0.0) {
    q.x = q.x == 0.0 ? d : 0.0;
  } else {
    q.y = q.y == 0.0 ? d : 0.0;
  }
}

}  // namespace fairway
