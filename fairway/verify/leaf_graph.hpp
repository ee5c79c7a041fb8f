// The section under proof as a graph: leaves, each with what is known of it, and links from each to
// the parts of the section where its flights arrive next.
//
// A section begins as leaves side by side. A leaf that is cut stays as the root of its halves, so
// that a section is a row of binary trees, and its leaves are the ends of the branches. Everything
// lies in flat arrays; the links of a leaf lie side by side, and the links that lead to one section
// are on a list, so that what a leaf leads to and what leads to a leaf are both at hand. Links are
// freed with their leaf's decision, unless all are to be kept.
//
// Properties that always hold:
//   1. The leaves of a section, in order, cover what its first leaves covered.
//   2. A leaf is open (undecided, not cut), decided, or cut. Links lead from open leaves alone,
//      unless all are kept; from cut leaves never.
//   3. Reading changes nothing: any number of threads may read while none writes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "fairway/verify/flow.hpp"
#include "fairway/verify/images.hpp"
#include "fairway/verify/section_verdicts.hpp"

namespace fairway {

class LeafGraph {
 public:
  using Id = std::uint32_t;
  static constexpr Id none = ~Id{0};

  /// Whether links outlive the decision of their leaf: `invalidate` wants them.
  enum class Keep { links_of_open_leaves, all_links };

  /// Where flights from a leaf arrive.
  struct Link {
    std::uint32_t section;
    UnitRange range;
    float flown_s;  ///< upper bound
    Id from;
    /// The leaf's own section alone: how far, at least, it moves every state of the leaf along the
    /// section, in units, all of them the same way and equally far. 0: nothing of the kind.
    std::uint32_t own_move;

   private:
    friend class LeafGraph;
    std::uint32_t next = none;  // on the list of the section it leads to
    std::uint32_t before = none;
  };

  explicit LeafGraph(const SectionVerdicts& start, Keep keep = Keep::links_of_open_leaves);

  // Leaves.
  Id ids() const { return static_cast<Id>(leaf_.size()); }  ///< all ever made, 0 to this
  std::size_t leaves() const { return leaf_count_; }
  std::size_t undecided() const { return open_count_; }
  bool is_open(Id id) const {
    return leaf_[id].verdict == Verdict::undecided && leaf_[id].halves == none;
  }
  LeafPlace place(Id id) const { return {leaf_[id].section, leaf_[id].range}; }
  Verdict verdict(Id id) const { return leaf_[id].verdict; }
  float time_s(Id id) const { return leaf_[id].time_s; }
  std::uint32_t rank(Id id) const { return leaf_[id].rank; }
  std::uint32_t highest_rank() const;
  bool has_leaves(std::size_t section) const { return roots_[section].count > 0; }
  /// Calls with each leaf of the section that touches `range`, in order.
  template <typename Body>
  void for_leaves(std::size_t section, UnitRange range, const Body& body) const;

  // Images: how the flights of a leaf end, and its links.
  VerdictSet ends(Id id) const { return {leaf_[id].end_bits, leaf_[id].end_time_s}; }
  bool gave_up(Id id) const { return leaf_[id].gave_up; }
  std::span<const Link> links(Id id) const {
    return std::span(link_).subspan(leaf_[id].first_link, leaf_[id].link_count);
  }
  /// Calls with every leaf that has a link into `range` of the section.
  template <typename Body>
  void for_dependents(std::size_t section, UnitRange range, const Body& body) const;

  // Changes.
  void set_image(Id id, const Image& image);
  void decide(Id id, Verdict verdict, std::uint32_t rank, float time_s);
  /// Cuts an open leaf. Returns the lower half; the upper is the next id. Neither has an image.
  Id cut(Id id);
  /// The commands or meanings of some cells are other ones now, and `flow` has them already. Every
  /// leaf whose verdict may rest on them is undecided again; returned are the open leaves whose
  /// image has to be flown (again). Wants Keep::all_links.
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
    Id halves = none;  // the lower half of a leaf that was cut
    std::uint32_t first_link = 0;
    std::uint32_t link_count = 0;
    double end_time_s = 0.0;
    Verdict verdict = Verdict::undecided;
    std::uint8_t end_bits = 0;
    bool gave_up = false;
  };
  /// The first leaves of a section: ids side by side.
  struct Roots {
    Id first = 0;
    std::uint32_t count = 0;
  };

  void add_roots(std::size_t section, std::uint32_t count);
  void free_links(Leaf& leaf);
  std::uint32_t room_for(std::uint32_t count);
  std::vector<bool> may_have_flown_through(const Flow& flow,
                                           const std::vector<bool>& changed_cells) const;
  void make_undecided(Id id);

  Keep keep_;
  std::vector<Leaf> leaf_;
  std::vector<Roots> roots_;                      // [sections]
  std::vector<Link> link_;                        // links of a leaf side by side
  std::vector<std::uint32_t> list_;               // [sections] first link on the section's list
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
  const Roots roots = roots_[section];
  Id low = roots.first;  // the first root that does not end before the range
  for (std::uint32_t count = roots.count; count > 0;) {
    const std::uint32_t half = count / 2;
    if (leaf_[low + half].range.hi < range.lo) {
      low += half + 1;
      count -= half + 1;
    } else {
      count = half;
    }
  }
  constexpr std::size_t deepest = 40;  // a leaf is halved at most 32 times
  std::array<Id, deepest> waiting;  // NOLINT(cppcoreguidelines-pro-type-member-init): filled below
  for (const Id end = roots.first + roots.count; low < end; ++low) {
    if (leaf_[low].range.lo > range.hi) return;
    std::size_t count = 0;
    waiting[count++] = low;
    while (count > 0) {
      const Id id = waiting[--count];
      const Leaf& leaf = leaf_[id];
      if (!overlap(leaf.range, range)) continue;
      if (leaf.halves == none) {
        body(id);
      } else {
        waiting[count++] = leaf.halves + 1;
        waiting[count++] = leaf.halves;
      }
    }
  }
}

template <typename Body>
void LeafGraph::for_dependents(std::size_t section, UnitRange range, const Body& body) const {
  for (std::uint32_t i = list_[section]; i != none; i = link_[i].next) {
    if (overlap(link_[i].range, range)) body(link_[i].from);
  }
}

}  // namespace fairway
