#include "tools/following/viable_states.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "fairway/base/parallel.hpp"
#include "fairway/field/distance_transform.hpp"
#include "fairway/vehicle/path_locator.hpp"

namespace fairway::following {
namespace {

constexpr int headings = 48;
constexpr int turn_steps = 2;  // headings passed in one step of a turn
constexpr double heading_step_rad = two_pi / headings;
constexpr int most_sweeps = 40;

}  // namespace

ViableStates::ViableStates(const Plan& plan, int fineness) {
  const Grid& g = plan.grid;
  turn_radius_m_ = plan.vehicle.turn_radius_m;
  const PathLocator path(std::get<PathMission>(plan.record.mission.value()));
  fine_ = {g.nx * fineness, g.ny * fineness, g.x0_m, g.y0_m, g.cell_m / fineness};
  std::vector<std::uint8_t> obstacle(fine_.size());
  node_.assign(fine_.size(), -1);
  for (int iy = 0; iy < fine_.ny; ++iy) {
    for (int ix = 0; ix < fine_.nx; ++ix) {
      const std::size_t coarse = g.index({ix / fineness, iy / fineness});
      const std::size_t i = fine_.index({ix, iy});
      obstacle[i] = plan.region[coarse] == Region::obstacle ? 1 : 0;
      if (obstacle[i] != 0 || !std::isfinite(plan.heading_rad[coarse])) continue;
      node_[i] = static_cast<std::int32_t>(cell_.size());
      cell_.push_back(static_cast<std::uint32_t>(i));
    }
  }
  std::vector<std::int32_t> squared(fine_.size());
  distance_transform(obstacle, fine_.nx, fine_.ny, {squared, {}});
  clearance_m_.resize(cell_.size());
  value_m_.resize(cell_.size() * headings);
  for (std::size_t n = 0; n < cell_.size(); ++n) {
    const auto d = static_cast<double>(squared[cell_[n]]);
    clearance_m_[n] = static_cast<float>(std::min(std::sqrt(d) - 0.5, 2.0) * fine_.cell_m);
    const PathFrame frame = path.frame(fine_.center(fine_.cell_at(cell_[n])));
    for (int h = 0; h < headings; ++h) {
      const double turn =
          Heading::of(frame.tangent).turn_to(Heading::from_rad(h * heading_step_rad));
      const bool on_path = std::abs(frame.offset_m) < 0.25 * turn_radius_m_ &&
                           std::abs(turn) < 0.35 && frame.beyond_m == 0.0;
      value_m_[n * headings + static_cast<std::size_t>(h)] =
          on_path ? clearance_m_[n] : -static_cast<float>(fine_.cell_m);
    }
  }
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    std::atomic<std::size_t> changed{0};
    for_ranges(cell_.size(), 256, [&](std::size_t first, std::size_t last) {
      std::size_t here = 0;
      for (std::size_t n = first; n < last; ++n) {
        const Vec2 place = fine_.center(fine_.cell_at(cell_[n]));
        for (int h = 0; h < headings; ++h) {
          float& value = value_m_[n * headings + static_cast<std::size_t>(h)];
          if (value >= clearance_m_[n]) continue;
          const float next = std::min(clearance_m_[n], best_after(place, h));
          if (next <= value) continue;
          if (next > value + 0.02F * static_cast<float>(fine_.cell_m)) ++here;
          value = next;
        }
      }
      changed += here;
    });
    if (changed == 0) break;
  }
}

float ViableStates::value_at(Vec2 p, int heading) const {
  const double x = (p.x - fine_.x0_m) / fine_.cell_m - 0.5;
  const double y = (p.y - fine_.y0_m) / fine_.cell_m - 0.5;
  const int ix = static_cast<int>(std::floor(x));
  const int iy = static_cast<int>(std::floor(y));
  const auto at = [&](int jx, int jy) {
    const Cell c{jx, jy};
    const std::int32_t n = fine_.contains(c) ? node_[fine_.index(c)] : -1;
    if (n < 0) return static_cast<float>(-0.5 * fine_.cell_m);
    return value_m_[static_cast<std::size_t>(n) * headings + static_cast<std::size_t>(heading)];
  };
  const auto tx = static_cast<float>(x - ix);
  const auto ty = static_cast<float>(y - iy);
  return (1 - ty) * ((1 - tx) * at(ix, iy) + tx * at(ix + 1, iy)) +
         ty * ((1 - tx) * at(ix, iy + 1) + tx * at(ix + 1, iy + 1));
}

float ViableStates::best_after(Vec2 place, int heading) const {
  const double step_rad = turn_steps * heading_step_rad;
  const double length_m = turn_radius_m_ * step_rad;
  const double chord_m = 2.0 * turn_radius_m_ * std::sin(0.5 * step_rad);
  float best = -1e9F;
  for (const int side : {-1, 0, 1}) {
    const double way = heading * heading_step_rad + 0.5 * side * step_rad;
    const Vec2 to = place + (side == 0 ? length_m : chord_m) * Vec2{std::cos(way), std::sin(way)};
    best = std::max(best, value_at(to, (heading + side * turn_steps + headings) % headings));
  }
  return best;
}

bool ViableStates::contains(const State& state) const {
  const int h =
      static_cast<int>(std::lround((state.heading.rad() + two_pi) / heading_step_rad)) % headings;
  return value_at(state.position_m, h) > 0.0F;
}

}  // namespace fairway::following
