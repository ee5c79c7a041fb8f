// The graph of leaves: for each leaf that is not decided, what may come next.
//
// A noun: leaves in the order of their sections, and the images of those that are open, as links to
// ranges of other sections. Ranges, headings and lengths are stored coarser than they were found,
// rounded so that they hold them.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "fairway/inclusion/behaviour_flight.hpp"
#include "fairway/inclusion/contract_verdicts.hpp"
#include "fairway/inclusion/heading_arc.hpp"
#include "fairway/inclusion/leaf_array.hpp"
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
  std::uint16_t heading_lo = 0;     ///< had since the leaf, widened, in turns / 2^16
  std::uint16_t heading_width = 0;  ///< less one
  float flown = 0.0F;               ///< at most, in parts

  HeadingArc headings() const {
    constexpr double unit_rad = whole_turn_rad / 0x1p16;
    return {unit_rad * heading_lo, unit_rad * (heading_width + 1.0)};
  }
  /// Whether whatever follows from `other` follows from this one.
  bool covers(const CrossingLink& other) const;
  static CrossingLink of(const Crossing& crossing, std::size_t part_index);
};
static_assert(sizeof(CrossingLink) == 16);

/// The links of leaves, in blocks, so that they neither move when there are more nor are ever there
/// twice.
class LinkStore {
 public:
  struct Place {
    std::uint32_t block = 0;
    std::uint16_t first = 0;
    std::uint16_t count = 0;
  };
  static constexpr std::size_t block_size = 1U << 15U;  ///< more links of one leaf are too many

  std::span<const CrossingLink> of(Place p) const {
    if (p.count == 0) return {};
    return {block_[p.block].data() + p.first, p.count};
  }
  Place add(std::span<const CrossingLink> links);
  /// Keeps the links at these places, and frees blocks that hold little else; places may change.
  void keep(std::span<Place> places);
  std::size_t bytes() const;

 private:
  std::vector<std::vector<CrossingLink>> block_;
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
  bool gave_up : 1 = false;
  bool is_beside_tube : 1 = false;  ///< some part on the way lies outside the tube
  float end_flown = 0.0F;           ///< by behaviours that end, in parts
};
static_assert(sizeof(Leaf) == 16);

/// Numbers for some of many: those of a set, in order.
class Slots {
 public:
  /// The next one of all, in or out.
  void add(bool is_in) {
    if (size_ % in_word == 0) {
      word_.push_back(0);
      before_.push_back(count_);
    }
    word_.back() |= std::uint64_t{is_in} << size_ % in_word;
    ++size_;
    count_ += is_in ? 1U : 0U;
  }
  std::uint32_t count() const { return count_; }
  bool has(std::size_t k) const { return (word_[k / in_word] >> k % in_word & 1U) != 0; }
  /// Of one of the set.
  std::uint32_t number(std::size_t k) const {
    const std::uint64_t below = word_[k / in_word] & ((std::uint64_t{1} << k % in_word) - 1);
    return before_[k / in_word] + static_cast<std::uint32_t>(std::popcount(below));
  }
  std::size_t bytes() const { return word_.capacity() * 8 + before_.capacity() * 4; }

 private:
  static constexpr std::size_t in_word = 64;
  std::vector<std::uint64_t> word_;
  std::vector<std::uint32_t> before_;  // in earlier words
  std::size_t size_ = 0;
  std::uint32_t count_ = 0;
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
  /// Leaves that were neither decided nor idle when leaves were last cut have slots: what is kept
  /// of them alone is numbered so.
  std::size_t slots() const { return slots_.count(); }
  bool has_slot(Id id) const { return slots_.has(id); }
  std::size_t slot(Id id) const { return slots_.number(id); }
  std::span<const CrossingLink> links(Id id) const {
    if (place_.empty() || !slots_.has(id)) return {};
    return links_.of(place_[slot(id)]);
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

  /// Cuts leaves that are not closed where those of an earlier proof of the same parts begin, too
  /// (earlier_leaves.cpp); the pieces are fresh. A hint: nothing of what was proved of them is
  /// believed.
  void begin_as(const ContractVerdicts& earlier);
  /// Flies all fresh leaves, for as long as `go_on` (asked by several threads at once) says so; the
  /// others stay fresh.
  void fly(const Parts& parts, const BehaviourOptions& options, const std::function<bool()>& go_on);
  /// Cuts these leaves in halves, which are fresh, and forgets the links of closed leaves.
  void cut(const std::vector<bool>& which);
  void forget_links();

  std::size_t bytes() const {
    return first_.capacity() * sizeof(Id) + leaf_.bytes() + slots_.bytes() +
           place_.capacity() * sizeof(LinkStore::Place) + links_.bytes();
  }

 private:
  void take_slots();
  void cut_places(const std::vector<bool>& which);
  void fly_leaf(Id id, std::size_t section, const Parts& parts, const BehaviourOptions& options,
                std::vector<CrossingLink>& links);

  std::vector<Id> first_;
  LeafArray<Leaf> leaf_;
  Slots slots_;
  std::vector<LinkStore::Place> place_;  // [slots]; empty when links are forgotten
  LinkStore links_;
};

}  // namespace fairway
