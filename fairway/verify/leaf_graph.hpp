// The section under proof as a graph: leaves, each with what is known about it, and links from each
// to the parts of the section where its flights arrive next.
//
// Everything is in flat arrays. The leaves of a section are in a list ordered by their starts, and
// there is a list of everything that leads to the section: both what a leaf leads to and what leads
// to it can be looked up. The links of a leaf are contiguous; they are freed when it is decided,
// unless all are to be kept.
//
// Properties that always hold:
//   1. The leaves of a section, in order, cover what its first leaves covered.
//   2. A leaf is open (undecided) or decided. Only open leaves have links, unless all are kept.
//   3. Reading changes nothing: any number of threads may read while none writes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "fairway/verify/flow.hpp"
#include "fairway/verify/images.hpp"
#include "fairway/verify/section_lists.hpp"
#include "fairway/verify/section_verdicts.hpp"

namespace fairway {

class LeafGraph {
 public:
  using Id = std::uint32_t;
  static constexpr Id none = ~Id{0};

  /// Whether links outlive the decision of their leaf: `invalidate` needs them.
  enum class Keep { links_of_open_leaves, all_links };

  /// Where flights from a leaf arrive.
  struct Link {
    std::uint32_t section;
    UnitRange range;
    float flown_s;  ///< upper bound
    /// Only for links to the leaf's own section: how far, at least, it moves every state of the
    /// leaf along the section, in units, all the same way and equally far. 0: no such move.
    std::uint32_t own_move;
  };

  explicit LeafGraph(const SectionVerdicts& start, Keep keep = Keep::links_of_open_leaves);

  // Leaves. Ids run from 0 to ids(); after an invalidation, some may no longer be leaves.
  Id ids() const { return static_cast<Id>(leaf_.size()); }
  std::size_t leaves() const { return leaf_count_; }
  std::size_t undecided() const { return open_count_; }
  bool is_open(Id id) const {
    return leaf_[id].verdict == Verdict::undecided && leaf_[id].section != none;
  }
  LeafPlace place(Id id) const { return {leaf_[id].section, leaf_[id].range}; }
  Verdict verdict(Id id) const { return leaf_[id].verdict; }
  float time_s(Id id) const { return leaf_[id].time_s; }
  std::uint32_t rank(Id id) const { return leaf_[id].rank; }
  std::uint32_t highest_rank() const;
  bool has_leaves(std::size_t section) const { return !on_section_[section].empty(); }
  /// Calls with each leaf of the section that touches `range`, in order.
  template <typename Body>
  void for_leaves(std::size_t section, UnitRange range, const Body& body) const;

  // Images: how the flights of a leaf end, and its links.
  VerdictSet ends(Id id) const { return {leaf_[id].end_bits, leaf_[id].end_time_s}; }
  bool gave_up(Id id) const { return leaf_[id].gave_up; }
  /// The earlier mode that the vehicle changes to there; no_mode: none.
  std::uint8_t next_mode(Id id) const { return leaf_[id].next_mode; }
  /// Not handed over, but a part of it might be (hand_over.hpp).
  bool hands_over_in_part(Id id) const { return leaf_[id].hands_over_in_part; }
  std::span<const Link> links(Id id) const {
    return std::span(link_).subspan(leaf_[id].first_link, leaf_[id].link_count);
  }
  /// Calls with every leaf that has a link into `range` of the section.
  template <typename Body>
  void for_dependents(std::size_t section, UnitRange range, const Body& body) const;

  // Changes.
  void set_image(Id id, const Image& image);
  void decide(Id id, Verdict verdict, std::uint32_t rank, float time_s);
  /// All its states are proved to reach once the vehicle changes to that mode.
  void decide_by_hand_over(Id id, std::uint8_t mode, float time_s);
  void set_hands_over_in_part(Id id) { leaf_[id].hands_over_in_part = true; }
  /// Cuts an open leaf: it becomes its own lower half; the returned id is the upper half. Neither
  /// has an image.
  Id cut(Id id);
  /// The commands or meanings of some cells have changed, and `flow` already has the new ones.
  /// Every leaf whose verdict may depend on them becomes undecided; returns the open leaves whose
  /// images must be flown (again). Needs Keep::all_links.
  std::vector<Id> invalidate(const Flow& flow, const std::vector<bool>& changed_cells);

  /// The leaves as they are now, in order.
  SectionVerdicts sections() const;
  std::size_t bytes() const;

 private:
  struct Leaf {
    std::uint32_t section = 0;
    UnitRange range;
    std::uint32_t rank = 0;
    float time_s = 0.0F;
    std::uint32_t first_link = 0;
    std::uint32_t link_count = 0;
    Verdict verdict = Verdict::undecided;
    std::uint8_t end_bits = 0;
    std::uint8_t next_mode = no_mode;
    bool gave_up = false;
    bool hands_over_in_part = false;
    double end_time_s = 0.0;
  };
  struct Place {
    std::uint32_t begin;
    Id id;
  };
  struct Dependent {
    UnitRange range;  // that a link leads to
    Id from;
  };

  Id add_leaf(std::size_t section, UnitRange range);
  void free_links(Id id);
  std::uint32_t room_for(std::uint32_t count);
  std::vector<bool> may_have_flown_through(const Flow& flow,
                                           const std::vector<bool>& changed_cells) const;
  void make_undecided(Id id);
  void renew_section(std::size_t section, bool there);

  Keep keep_;
  std::vector<Leaf> leaf_;
  SectionLists<Place> on_section_;
  std::vector<Link> link_;  // links of a leaf are contiguous
  SectionLists<Dependent> dependents_;
  std::vector<std::vector<std::uint32_t>> free_;  // [count] first of `count` unused links
  std::size_t leaf_count_ = 0;
  std::size_t open_count_ = 0;
};

inline bool overlap(UnitRange a, UnitRange b) { return a.lo <= b.hi && b.lo <= a.hi; }
inline double width_of(UnitRange range) {
  return static_cast<double>(range.hi) - static_cast<double>(range.lo);
}

template <typename Body>
void LeafGraph::for_leaves(std::size_t section, UnitRange range, const Body& body) const {
  const std::span<const Place> places = on_section_[section];
  std::size_t low = 0;  // becomes the last leaf that starts before the range, or the first
  for (std::size_t count = places.size(); count > 1;) {
    const std::size_t half = count / 2;
    if (places[low + half].begin < range.lo) low += half;
    count -= half;
  }
  for (; low < places.size() && places[low].begin <= range.hi; ++low) body(places[low].id);
}

template <typename Body>
void LeafGraph::for_dependents(std::size_t section, UnitRange range, const Body& body) const {
  for (const Dependent& dependent : dependents_[section]) {
    if (overlap(dependent.range, range)) body(dependent.from);
  }
}

}  // namespace fairway
