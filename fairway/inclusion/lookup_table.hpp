// What a fast look-up needs of parts and verdicts, one record a part: the arc in integer angles,
// the directions of its ends, and what all leaves of each side have in common.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "fairway/base/vec2.hpp"
#include "fairway/inclusion/behaviour_flight.hpp"
#include "fairway/inclusion/contract_verdicts.hpp"
#include "fairway/inclusion/crossing_graph.hpp"
#include "fairway/inclusion/parts.hpp"

namespace fairway {

/// An angle in turns / 2^32: sums and differences wrap by themselves.
using TurnUnits = std::uint32_t;
inline constexpr double turn_units_per_rad = 0x1p32 / whole_turn_rad;
inline constexpr TurnUnits units_of_angle(double angle_rad) {
  return static_cast<TurnUnits>(static_cast<std::int64_t>(angle_rad * turn_units_per_rad));
}

struct PartRecord {
  TurnUnits lo = 0;  ///< of the arc, rounded
  TurnUnits width = 0;
  float cos_lo = 0.0F;
  float sin_lo = 0.0F;
  float cos_hi = 0.0F;
  float sin_hi = 0.0F;
  float longest_way = 0.0F;  ///< through the part along headings of the arc, in parts
  std::uint32_t bits = 0;

  static constexpr unsigned sides_at = 3;  ///< in bits, after the kind
  static constexpr unsigned verdicts_at = sides_at + sections_per_part;

  /// The directions of the arc's ends.
  Vec2 lowest() const { return {static_cast<double>(cos_lo), static_cast<double>(sin_lo)}; }
  Vec2 highest() const { return {static_cast<double>(cos_hi), static_cast<double>(sin_hi)}; }
  PartKind kind() const { return static_cast<PartKind>(bits & 7U); }
  /// Whether some heading of the arc leads out over this side.
  bool is_crossed(std::size_t side) const { return (bits >> (sides_at + side) & 1U) != 0; }
  /// Bit v: some leaf of a side that is crossed has Verdict v.
  unsigned all_verdicts() const {
    return bits >> (verdicts_at + stored_verdict_count * sections_per_part);
  }
  /// Bit v: some leaf of the side has Verdict v.
  unsigned verdicts(std::size_t side) const {
    return bits >> (verdicts_at + stored_verdict_count * side) & 0x1fU;
  }
};
static_assert(sizeof(PartRecord) == 32);
static_assert(PartRecord::verdicts_at + (sections_per_part + 1) * stored_verdict_count == 32);

class LookupTable {
 public:
  /// Keeps what `verdicts` points to.
  LookupTable(const Parts& parts, const ContractVerdictsView& verdicts);

  int nx() const { return nx_; }
  int ny() const { return ny_; }
  /// Of a part of the grid, or of the ring about it: -1 to nx, -1 to ny. A row's lie one after
  /// another.
  const PartRecord& ringed(PartPlace p) const { return record_[number(p)]; }

  /// Of the leaves of all sides that are crossed, at most.
  double longest_time_s(PartPlace p) const {
    const auto& t = time_s_[number(p)];
    return static_cast<double>(std::max(std::max(t[0], t[1]), std::max(t[2], t[3])));
  }

  double longest_time_s(PartPlace p, std::size_t side) const {
    return static_cast<double>(time_s_[number(p)][side]);
  }

  struct Found {
    unsigned verdicts = 0;  ///< bit v: some leaf has Verdict v
    double time_s = 0.0;    ///< of their groups, at most
  };
  /// Of the leaves that the range [lo, hi] of a side touches.
  Found find(PartPlace p, std::size_t side, double lo, double hi) const;

 private:
  std::size_t number(PartPlace p) const {
    return static_cast<std::size_t>(p.iy + 1) * static_cast<std::size_t>(nx_ + 2) +
           static_cast<std::size_t>(p.ix + 1);
  }

  int nx_;
  int ny_;
  ContractVerdictsView verdicts_;
  std::vector<PartRecord> record_;
  std::vector<std::array<float, sections_per_part>>
      time_s_;  ///< of each side, at most; 0 of others
};

}  // namespace fairway
