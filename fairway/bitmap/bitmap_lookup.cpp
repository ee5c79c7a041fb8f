#include "fairway/bitmap/bitmap_lookup.hpp"

#include <algorithm>
#include <cmath>

#include "fairway/base/error.hpp"
#include "fairway/vehicle/cell_motion.hpp"

namespace fairway {

BitmapLookup::BitmapLookup(const Bitmap& bitmap)
    : flow_(bitmap.flow()), set_(bitmap.set), samples_(bitmap.set.samples) {
  require(bitmap.heading_rad.size() == bitmap.grid().size() &&
              bitmap.kind.size() == bitmap.grid().size(),
          "a bitmap's arrays have one entry per cell");
  require_fit();
}

BitmapLookup::BitmapLookup(const Plan& plan, const std::vector<std::uint8_t>& target_cells,
                           const BorderBitmap& set)
    : flow_{plan.grid, plan.vehicle, plan.heading_rad.data(), nullptr},
      set_(set),
      samples_(set.samples) {
  require(set.grid == plan.grid, "the bitmap has the plan's grid");
  require(target_cells.size() == plan.grid.size() && plan.region.size() == plan.grid.size() &&
              plan.heading_rad.size() == plan.grid.size(),
          "a plan's arrays and the region have one entry per cell");
  for (std::size_t i = 0; i < target_cells.size(); ++i) {
    owned_kind_.push_back(target_cells[i] != 0                 ? CellKind::target
                          : plan.region[i] == Region::obstacle ? CellKind::obstacle
                                                               : CellKind::ordinary);
  }
  require_fit();
}

void BitmapLookup::require_fit() const {
  require(flow_.grid.cell_m > 0.0 && flow_.grid.cell_m < flow_.vehicle.turn_radius_m,
          "0 < cell side < turning radius");
  require(set_.words.size() == set_.borders().count() * set_.words_per_border(),
          "the bitmap has the size that its borders require");
}

BitmapLookup::First BitmapLookup::first_border(const State& state) const {
  const Grid& grid = flow_.grid;
  const Vec2 p{state.position_m.x - grid.x0_m, state.position_m.y - grid.y0_m};
  if (!(p.x >= 0.0 && p.x <= grid.width_m() && p.y >= 0.0 && p.y <= grid.height_m())) return {};
  const double d = grid.cell_m;
  const Cell cell{std::min(static_cast<int>(p.x / d), grid.nx - 1),
                  std::min(static_cast<int>(p.y / d), grid.ny - 1)};
  const std::size_t place = grid.index(cell);
  if (kind_at(place) == CellKind::target) return {Sampled::reach, {}};
  if (kind_at(place) == CellKind::obstacle) return {};
  const double command_rad = flow_.heading_rad[place];
  const Direction command =
      std::isnan(command_rad) ? Direction::none() : Direction::of(Heading::from_rad(command_rad));
  const Vec2 inside{std::clamp(p.x - cell.ix * d, 0.0, d), std::clamp(p.y - cell.iy * d, 0.0, d)};
  const CellExit exit =
      cross_cell({inside, Direction::of(state.heading)}, command, {d, flow_.vehicle.turn_radius_m});
  const BorderNumbers borders = set_.borders();
  if (!borders.is_inner(cell, exit.side)) return {};
  const bool upright = exit.side == Side::right || exit.side == Side::left;
  const Vec2 q = exit.state.position_m;
  return {Sampled::undecided,
          Sample{borders.of(cell, exit.side), samples_.heading_bin(exit.state.heading.unit),
                 samples_.position_bin((upright ? q.y : q.x) / d)}};
}

bool BitmapLookup::reaches(const State& state) const {
  const First first = first_border(state);
  if (!first.sample) return first.known == Sampled::reach;
  return set_.reached(first.sample->border, first.sample->heading, first.sample->position);
}

Sampled BitmapLookup::answer(const State& state) const {
  const First first = first_border(state);
  if (!first.sample) return first.known;
  const auto& [border, heading, position] = *first.sample;
  const bool reached = set_.reached(border, heading, position);
  for (int k = heading - 1; k <= heading + 1; ++k) {
    for (int i = std::max(position - 1, 0); i <= std::min(position + 1, samples_.count() - 1);
         ++i) {
      if (set_.reached(border, samples_.wrapped(k), i) != reached) return Sampled::undecided;
    }
  }
  return reached ? Sampled::reach : Sampled::other;
}

}  // namespace fairway
