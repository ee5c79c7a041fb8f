// The graph of leaves: for each leaf that is not decided, what may come next.
//
// A noun: leaves in the order of their sections, and the images of those that are open, as links to
// ranges of other sections. Ranges, headings and lengths are stored coarser than they were found,
// rounded so that they hold them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "fairway/inclusion/behaviour_flight.hpp"
#include "fairway/inclusion/contract_verdicts.hpp"
#include "fairway/inclusion/heading_arc.hpp"
#include "fairway/verify/verdict.hpp"

namespace fairway {

/// Places along a side, in units of a side / 2^16: the finest that leaves are cut to.
inline constexpr std::uint32_t side_units = 1U << 16U;

inline constexpr std::size_t sections_per_part = 4;
constexpr std::size_t section_number(std::size_t part_index, PartSide side) {
  return sections_per_part * part_index + static_cast<std::size_t>(side);
}

/// Of lengths: whoever checks them may add them up in another way.
inline constexpr double generous = 1.25;

struct CrossingLink {
  std::uint32_t section = 0;
  std::uint16_t lo = 0;  ///< in units; the range is [lo, hi + 1]
  std::uint16_t hi = 0;
  float heading_lo_rad = 0.0F;  ///< had since the leaf, widened
  float heading_width_rad = 0.0F;
  float flown = 0.0F;  ///< at most, in parts

  HeadingArc headings() const {
    return {static_cast<double>(heading_lo_rad), static_cast<double>(heading_width_rad)};
  }
  static CrossingLink of(const Crossing& crossing, std::size_t part_index);
};

enum class LeafState : std::uint8_t {
  fresh,   ///< not flown
  open,    ///< flown, not decided
  closed,  ///< decided
  aside,   ///< not flown until it is made fresh
  idle     ///< of a section that nothing crosses
};

struct Leaf {
  std::uint32_t begin = 0;  ///< in units
  std::uint32_t group = 0;
  Verdict verdict = Verdict::undecided;
  LeafState state = LeafState::fresh;
  std::uint8_t ends = 0;  ///< of the image: bit v, Verdict v
  bool gave_up = false;
  float end_flown = 0.0F;   ///< by behaviours that end, in parts
  float distance_m = 0.0F;  ///< as in the image
  float off_rad = 0.0F;
};

class CrossingGraph {
 public:
  using Id = std::uint32_t;

  /// `pieces` leaves for every side of an ordinary part.
  CrossingGraph(const Parts& parts, std::uint32_t pieces);

  std::size_t sections() const { return first_.size() - 1; }
  std::size_t leaves() const { return leaf_.size(); }
  Id first(std::size_t section) const { return first_[section]; }
  const Leaf& leaf(Id id) const { return leaf_[id]; }
  Leaf& leaf(Id id) { return leaf_[id]; }
  std::size_t section_of(Id id) const;
  std::uint32_t end_of(Id id, std::size_t section) const {
    return id + 1 < first_[section + 1] ? leaf_[id + 1].begin : side_units;
  }
  std::span<const CrossingLink> links(Id id) const {
    return {link_.data() + first_link_[id], link_.data() + first_link_[id + 1]};
  }

  /// The leaves that a range of a section touches, [first, last).
  struct Range {
    Id first;
    Id last;
  };
  Range leaves_of(std::size_t section, std::uint32_t lo, std::uint32_t hi) const;
  Range leaves_of(const CrossingLink& link) const {
    return leaves_of(link.section, link.lo, link.hi + 1U);
  }

  /// Cuts fresh leaves where those of an earlier proof of the same parts begin, too
  /// (earlier_leaves.cpp). A hint: nothing of what was proved of them is believed.
  void begin_as(const ContractVerdicts& earlier);
  /// Flies all fresh leaves, for as long as `go_on` (asked by several threads at once) says so; the
  /// others stay fresh.
  void fly(const Parts& parts, const BehaviourOptions& options, const std::function<bool()>& go_on);
  /// Cuts these leaves in halves, which are fresh, and forgets the links of closed leaves.
  void cut(const std::vector<bool>& which);

  std::size_t bytes() const {
    return first_.capacity() * sizeof(Id) + leaf_.capacity() * sizeof(Leaf) +
           first_link_.capacity() * sizeof(std::uint32_t) + link_.capacity() * sizeof(CrossingLink);
  }

 private:
  std::vector<Id> first_;
  std::vector<Leaf> leaf_;
  std::vector<std::uint32_t> first_link_;  // [leaves + 1]
  std::vector<CrossingLink> link_;
};

}  // namespace fairway
