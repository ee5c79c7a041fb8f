// Which mode an exact flight is in, decided by what is proved of the plan: as a vehicle decides
// that has the certificate on board (verify/mode_choice.hpp), asked at every border.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "fairway/simulate/modal_flight.hpp"
#include "fairway/verify/mode_choice.hpp"

namespace fairway {

/// How far the vehicle may weave in `mode` without coming to a leaf that tells it to change: to the
/// end of the leaf that it meets the section in, over and over, or without end if it meets none.
inline double weave_within_leaf_m(const ProofView& proof, const BorderCrossing& crossing,
                                  int mode) {
  const Flow flow = proof.flow_of(mode);
  const SectionView sections = proof.sections_of(mode);
  const Vec2 u = crossing.state.heading.unit();
  const bool vertical = crossing.side == Side::right || crossing.side == Side::left;
  const double unit_m = flow.grid.cell_m / units_per_side;
  const bool upwards = (vertical ? u.y : u.x) > 0.0;
  const Cell beyond{crossing.left.ix + (crossing.side == Side::right  ? 1
                                        : crossing.side == Side::left ? -1
                                                                      : 0),
                    crossing.left.iy + (crossing.side == Side::top      ? 1
                                        : crossing.side == Side::bottom ? -1
                                                                        : 0)};
  double most_m = std::numeric_limits<double>::infinity();
  for (const Cell cell : {crossing.left, beyond}) {
    const auto command = static_cast<double>(flow.heading_rad[flow.grid.index(cell)]);
    const Vec2 c = Heading::from_rad(std::isnan(command) ? 0.0 : command).unit();
    // It comes back to the border at the same angle each time: aligned always, or never.
    const double off = std::abs(vertical ? u.x : u.y) - std::abs(vertical ? c.x : c.y);
    if (std::isnan(command) || std::abs(off) > 1e-9) continue;
    const auto side = static_cast<std::size_t>(crossing.side);
    const std::size_t section =
        4 * flow.grid.index(cell) + (cell == crossing.left ? side : (side + 2) % 4);
    const double units = std::clamp(crossing.along_m / unit_m, 0.0, units_per_side - 1.0);
    const auto unit = static_cast<std::uint32_t>(units);
    sections.for_leaves(section, {unit, unit}, [&](std::size_t leaf) {
      const double begin = sections.begin[leaf];
      const double end =
          leaf + 1 < sections.first[section + 1] ? sections.begin[leaf + 1] : units_per_side;
      const bool changes = sections.next_mode != nullptr && sections.next_mode[leaf] != no_mode;
      const double rest_m = (upwards ? end - units : units - begin) * unit_m;
      most_m = std::min(most_m, changes ? 0.0 : std::max(0.0, rest_m));
    });
  }
  return most_m;
}

class ProvedModes final : public ModeDecider {
 public:
  /// What `proof` refers to must outlive this. Starts and flights within 2^30 cells of the grid.
  explicit ProvedModes(const ProofView& proof) : proof_(proof) {}

  int begin(const State& start) override {
    const Vec2 p = start.position_m;
    return ask_all_modes(proof_, p.x, p.y, start.heading.rad()).mode;
  }
  int at_border(const BorderCrossing& crossing, int mode) override {
    const Vec2 p = crossing.state.position_m;
    return mode_from(proof_, mode, p.x, p.y, crossing.state.heading.rad()).mode;
  }
  double weaves_m(const BorderCrossing& crossing, int mode) override {
    return weave_within_leaf_m(proof_, crossing, mode);
  }

 private:
  ProofView proof_;
};

}  // namespace fairway
