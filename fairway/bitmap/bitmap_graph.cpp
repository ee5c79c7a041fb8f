#include "fairway/bitmap/bitmap_graph.hpp"

#include <cmath>

#include "fairway/base/error.hpp"

namespace fairway {

BitmapGraph::BitmapGraph(const Plan& plan, const std::vector<std::uint8_t>& target_cells,
                         int samples)
    : samples_(samples),
      borders_{plan.grid.nx, plan.grid.ny},
      turn_radius_(plan.vehicle.turn_radius_m / plan.grid.cell_m),
      stride_(static_cast<std::uint32_t>(plan.grid.nx) + 2) {
  const Grid& grid = plan.grid;
  require(grid.nx > 0 && grid.ny > 0, "a plan has at least one cell");
  require(grid.size() < (std::size_t{1} << 30), "a plan has fewer than 2^30 cells");
  require(grid.cell_m > 0.0 && turn_radius_ > 1.0 && std::isfinite(turn_radius_),
          "0 < cell side < turning radius");
  require(plan.heading_rad.size() == grid.size() && plan.region.size() == grid.size() &&
              target_cells.size() == grid.size(),
          "a plan's arrays and the region have one entry per cell");
  cells_.resize(static_cast<std::size_t>(stride_) * (static_cast<std::size_t>(grid.ny) + 2));
  for (int iy = 0; iy < grid.ny; ++iy) {
    for (int ix = 0; ix < grid.nx; ++ix) {
      const std::size_t i = grid.index({ix, iy});
      Record& cell = cells_[place_of({ix, iy})];
      const double heading_rad = plan.heading_rad[i];
      const Direction command = std::isnan(heading_rad)
                                    ? Direction::none()
                                    : Direction::of(Heading::from_rad(heading_rad));
      cell.command = BitmapCommand::of(command, samples_);
      // Numbers of outer borders are wrong, but never used.
      cell.right_border = static_cast<std::uint32_t>(borders_.of({ix, iy}, Side::right));
      cell.top_border = static_cast<std::uint32_t>(borders_.of({ix, iy}, Side::top));
      cell.end = target_cells[i] != 0                 ? BitmapEnd::reached
                 : plan.region[i] == Region::obstacle ? BitmapEnd::not_reached
                                                      : BitmapEnd::none;
    }
  }
}

}  // namespace fairway
