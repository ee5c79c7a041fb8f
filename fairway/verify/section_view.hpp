// What is proved about the section (section_flight.hpp): every section is cut into leaves, and a
// leaf has one verdict. A view: it owns nothing, so that it can refer to a mapped file.
//
// Places along a side are measured in units of cell_m / 2^32. A leaf holds every place from its
// start to the next leaf's start (or the side's end), both ends included.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "fairway/base/grid.hpp"
#include "fairway/base/interval.hpp"
#include "fairway/vehicle/modes.hpp"
#include "fairway/vehicle/size_range.hpp"
#include "fairway/vehicle/vehicle.hpp"
#include "fairway/verify/verdict.hpp"

namespace fairway {

inline constexpr double units_per_side = 0x1p32;

/// The array "geometry" of a certificate's file: the grid's position and the vehicle, by name.
struct Geometry {
  double x0_m;
  double y0_m;
  double cell_m;
  double turn_radius_m;
  double speed_mps;
  double units;  ///< units_per_side, which gives places their meaning

  static Geometry of(const Grid& grid, const Vehicle& vehicle) {
    return {grid.x0_m,         grid.y0_m,     grid.cell_m, vehicle.turn_radius_m,
            vehicle.speed_mps, units_per_side};
  }
  bool is_valid() const {
    Grid grid;
    Vehicle vehicle;
    put_into(grid, vehicle);
    return size_range::holds(grid, vehicle) && units == units_per_side;
  }
  void put_into(Grid& grid, Vehicle& vehicle) const {
    grid.x0_m = x0_m;
    grid.y0_m = y0_m;
    grid.cell_m = cell_m;
    vehicle = {speed_mps, turn_radius_m};
  }
};
inline constexpr std::size_t geometry_numbers = 6;
static_assert(sizeof(Geometry) == geometry_numbers * sizeof(double));

/// A range of places in whole units, both ends included; it covers the interval it came from and
/// one more unit on either side, so that other arithmetic finds the same leaves.
struct UnitRange {
  std::uint32_t lo = 0;
  std::uint32_t hi = 0;
};
inline UnitRange units_of(Interval along_m, double cell_m) {
  const auto clamped = [](double units) {
    return static_cast<std::uint32_t>(units < 0.0                    ? 0.0
                                      : units > units_per_side - 1.0 ? units_per_side - 1.0
                                                                     : units);
  };
  const double scale = units_per_side / cell_m;
  return {clamped(std::floor(along_m.lo * scale) - 1.0),
          clamped(std::ceil(along_m.hi * scale) + 1.0)};
}
/// The places of a range, as an interval that holds them and one more unit on either side. The last
/// unit of a side stands for the side's end.
inline Interval along_of(UnitRange range, double cell_m) {
  const double unit_m = cell_m / units_per_side;
  const bool to_end = range.hi == 0xffffffffU;
  return {
      std::max(0.0, below((static_cast<double>(range.lo) - 1.0) * unit_m)),
      to_end ? cell_m : std::min(cell_m, above((static_cast<double>(range.hi) + 1.0) * unit_m))};
}

/// A set of verdicts, and the longest time to any of them.
struct VerdictSet {
  std::uint8_t bits = 0;
  double time_s = 0.0;

  void add(Verdict verdict, double t_s) {
    bits = static_cast<std::uint8_t>(bits | 1U << static_cast<unsigned>(verdict));
    if (t_s > time_s) time_s = t_s;
  }
  /// The one verdict of all; undecided when there are several, or none.
  Verdict only() const {
    for (int v = 1; v < verdict_count; ++v) {
      if (bits == 1U << static_cast<unsigned>(v)) return static_cast<Verdict>(v);
    }
    return Verdict::undecided;
  }
};

struct SectionView {
  const std::uint32_t* first = nullptr;   ///< [4 cells + 1]: a section's leaves start here
  const std::uint32_t* begin = nullptr;   ///< [leaves], units; ascending in a section, from 0
  const std::uint8_t* verdict = nullptr;  ///< [leaves]
  const float* time_s = nullptr;          ///< [leaves], bound of the time to the verdict
  /// [leaves], the earlier mode that the vehicle changes to there, or no_mode; null: all no_mode.
  const std::uint8_t* next_mode = nullptr;

  /// Calls with each leaf that `range` of the section touches; false when it has no leaves.
  template <typename Body>
  bool for_leaves(std::size_t section, UnitRange range, const Body& body) const {
    std::size_t low = first[section];
    const std::size_t end = first[section + 1];
    if (low == end) return false;
    for (std::size_t count = end - low; count > 1;) {  // the last leaf that starts at or before
      const std::size_t half = count / 2;
      if (begin[low + half] <= range.lo) low += half;
      count -= half;
    }
    // A place on the seam of two leaves belongs to both.
    if (low > first[section] && begin[low] == range.lo) --low;
    for (std::size_t i = low; i < end && begin[i] <= range.hi; ++i) body(i);
    return true;
  }

  void look_up(std::size_t section, UnitRange range, double flown_s, VerdictSet& found) const {
    const bool any = for_leaves(section, range, [&](std::size_t leaf) {
      found.add(static_cast<Verdict>(verdict[leaf]),
                above(flown_s + static_cast<double>(time_s[leaf])));
    });
    if (!any) found.add(Verdict::undecided, 0.0);
  }
};

}  // namespace fairway
