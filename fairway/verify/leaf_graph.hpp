// The section under proof as a graph: leaves, each with what is known about it, and links from each
// to the parts of the section where its flights arrive next.
//
// Memory follows what is undecided. The leaves of a section are in a list ordered by their starts;
// of a decided leaf there is no more than its entry there: start, verdict, rank and time. An open
// leaf has an id, under which its image is kept: how its flights end, and its links. There is a
// list of what waits for each section, so that both what a leaf leads to and what leads to it can
// be looked up.
//
// Properties that always hold:
//   1. The leaves of a section, in order, cover what its first leaves covered.
//   2. A leaf is open (undecided) or decided. Only open leaves have ids and links, unless all are
//      kept; an id that was released is used again.
//   3. Reading changes nothing: any number of threads may read while none writes.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "fairway/verify/chunked_array.hpp"
#include "fairway/verify/flow.hpp"
#include "fairway/verify/images.hpp"
#include "fairway/verify/section_lists.hpp"
#include "fairway/verify/section_verdicts.hpp"

namespace fairway {

class LeafGraph {
 public:
  using Id = std::uint32_t;
  static constexpr Id none = ~Id{0};

  /// Whether ids and links outlive the decision of their leaf: `invalidate` needs them.
  enum class Keep { links_of_open_leaves, all_links };

  /// Where flights from a leaf arrive.
  struct Link {
    std::uint32_t section : 31;
    /// To the leaf's own section, every state of it moved along it all the same way and equally
    /// far (LeafGraph::own_move).
    std::uint32_t hop : 1;
    UnitRange range;
    float flown_s;  ///< upper bound
  };
  /// What lookups tell of a leaf.
  struct Leaf {
    std::uint32_t begin;
    Id id;  ///< none: decided, and only what is here is known of it
    Verdict verdict;
    float time_s;
    std::uint32_t rank;  ///< of a decided leaf without an id; else 0
  };

  explicit LeafGraph(const SectionVerdicts& start, Keep keep = Keep::links_of_open_leaves);

  bool keeps_all_links() const { return keep_ == Keep::all_links; }

  // Leaves. Ids run from 0 to ids(); some may be of no leaf.
  Id ids() const { return open_.size(); }
  std::size_t leaves() const { return leaf_count_; }
  std::size_t undecided() const { return open_count_; }
  bool is_open(Id id) const {
    return open_[id].verdict == Verdict::undecided && open_[id].section != none;
  }
  LeafPlace place(Id id) const { return {open_[id].section, open_[id].range}; }
  Verdict verdict(Id id) const { return open_[id].verdict; }
  float time_s(Id id) const { return known(id).time_s; }
  std::uint32_t rank(Id id) const { return known(id).rank; }
  std::uint32_t highest_rank() const { return highest_rank_; }
  bool has_leaves(std::size_t section) const { return !on_section_[section].empty(); }
  /// Calls with each leaf of the section that touches `range`, in order.
  template <typename Body>
  void for_leaves(std::size_t section, UnitRange range, const Body& body) const;

  // Images: how the flights of a leaf end, and its links.
  VerdictSet ends(Id id) const { return {open_[id].end_bits, open_[id].end_time_s}; }
  bool gave_up(Id id) const { return (open_[id].flags & gave_up_flag) != 0; }
  /// Not handed over, but a part of it might be (hand_over.hpp).
  bool hands_over_in_part(Id id) const { return (open_[id].flags & in_part_flag) != 0; }
  /// The verdicts that its image met when it was last examined, a bit for each.
  std::uint8_t seen(Id id) const { return open_[id].seen; }
  void set_seen(Id id, std::uint8_t bits) { open_[id].seen = bits; }
  /// Never decided unless it is cut: whatever its links lead to.
  bool is_hopeless(Id id) const { return (open_[id].flags & hopeless_flag) != 0; }
  std::span<const Link> links(Id id) const {
    const Open& open = open_[id];
    return open.link_count == 0 ? std::span<const Link>{}
                                : std::span(link_.block(open.first_link), open.link_count);
  }
  /// Of a link of that leaf that is a hop: how far, at least, it moves every state of the leaf, in
  /// units. 0: no hop, or it may not move at all.
  double own_move(Id id, const Link& link) const {
    return link.hop != 0 ? least_move(link.range, open_[id].range) : 0.0;
  }
  /// Calls with every leaf that has a link into `range` of the section and waits for it.
  template <typename Body>
  void for_dependents(std::size_t section, UnitRange range, const Body& body) const;

  // Changes.
  /// Keeps an image. The leaf waits for no one yet: `await_links` is to follow, or the leaf to be
  /// decided or cut.
  void keep_image(Id id, const Image& image);
  /// From now on, it is among the dependents of what its links lead to. What is decided of that is
  /// added to its ends, unless all links are kept. May be called again.
  void await_links(Id id);
  void set_image(Id id, const Image& image) {
    keep_image(id, image);
    await_links(id);
  }
  /// It can only be cut, and waits for no one: `found` says so, the verdicts of its image.
  void give_up_hope(Id id, VerdictSet found);
  /// It has no image, and waits for no one.
  void drop_image(Id id) { free_links(id); }
  void decide(Id id, Verdict verdict, std::uint32_t rank, float time_s);
  /// All its states are proved to reach once the vehicle changes to that mode.
  void decide_by_hand_over(Id id, std::uint8_t mode, float time_s);
  void set_hands_over_in_part(Id id) { open_[id].flags |= in_part_flag; }
  /// The leaf, which is decided, is known by its place alone from now on, unless all ids are kept.
  void release(Id id);
  /// Cuts an open leaf: it becomes its own lower half; the returned id is the upper half. Neither
  /// has an image.
  Id cut(Id id);
  /// The commands or meanings of some cells have changed, and `flow` already has the new ones.
  /// Every leaf whose verdict may depend on them becomes undecided; returns the open leaves whose
  /// images must be flown (again). Needs Keep::all_links.
  std::vector<Id> invalidate(const Flow& flow, const std::vector<bool>& changed_cells);

  /// The leaves as they are now, in order.
  SectionVerdicts sections() const;
  /// The same, when nothing else will be asked: frees everything else first.
  SectionVerdicts into_sections();
  std::size_t bytes() const;

 private:
  /// A leaf in its section's list.
  struct Entry {
    std::uint32_t begin;
    std::uint32_t state : 3;  // a verdict that is stored, or handed_over
    std::uint32_t of : 29;    // its id if it has one; else its rank, or the mode
    float time_s;
  };
  static constexpr std::uint32_t handed_over = stored_verdict_count;
  static Entry entry(std::uint32_t begin, Id id) { return {begin, 0, id & most_of, 0.0F}; }
  static constexpr std::uint32_t most_section = (std::uint32_t{1} << 31) - 1;
  static constexpr std::uint32_t most_of = (std::uint32_t{1} << 29) - 1;
  static_assert(static_cast<int>(Verdict::undecided) == 0 && handed_over < 8);

  /// What is kept under an id.
  struct Open {
    std::uint32_t section;
    UnitRange range;
    std::uint32_t first_link;  // of an id that is not used: the next one of these
    std::uint32_t link_count;
    Verdict verdict;
    std::uint8_t end_bits;
    std::uint8_t flags;
    std::uint8_t seen;
    double end_time_s;
  };
  static constexpr std::uint8_t gave_up_flag = 1;
  static constexpr std::uint8_t in_part_flag = 2;
  static constexpr std::uint8_t awaits_flag = 4;  // it is among the dependents of its links
  static constexpr std::uint8_t hopeless_flag = 8;
  struct Known {
    std::uint32_t rank = 0;
    float time_s = 0.0F;
    std::uint8_t next_mode = no_mode;
  };
  struct Dependent {
    UnitRange range;  // that a link leads to
    Id from;
  };

  Id new_id(std::size_t section, UnitRange range);
  Entry& entry_of(Id id);
  void decide(Id id, Verdict verdict, Known known);
  Known known(Id id) const;
  void remove_dependent(const Link& link, Id id);
  void stop_awaiting(Id id);
  void free_links(Id id);
  void free_room(std::uint32_t first, std::uint32_t count);
  std::uint32_t room_for(std::uint32_t count);
  bool fold(Id id, const Link& link);
  std::vector<bool> may_have_flown_through(const Flow& flow,
                                           const std::vector<bool>& changed_cells) const;
  void make_undecided(Id id);
  void renew_section(std::size_t section, bool there);

  Keep keep_;
  ChunkedArray<Open> open_;
  Id unused_id_ = none;
  std::vector<Known> known_;  // [id] of decided leaves, if all are kept
  SectionLists<Entry> on_section_;
  ChunkedArray<Link> link_;  // links of a leaf are contiguous
  SectionLists<Dependent> dependents_;
  std::vector<std::vector<std::uint32_t>> free_;  // [count] first of `count` unused links
  std::size_t leaf_count_ = 0;
  std::size_t open_count_ = 0;
  std::uint32_t highest_rank_ = 0;
};

inline bool overlap(UnitRange a, UnitRange b) { return a.lo <= b.hi && b.lo <= a.hi; }
inline double width_of(UnitRange range) {
  return static_cast<double>(range.hi) - static_cast<double>(range.lo);
}

template <typename Body>
void LeafGraph::for_leaves(std::size_t section, UnitRange range, const Body& body) const {
  const std::span<const Entry> entries = on_section_[section];
  std::size_t low = 0;  // becomes the last leaf that starts before the range, or the first
  for (std::size_t count = entries.size(); count > 1;) {
    const std::size_t half = count / 2;
    if (entries[low + half].begin < range.lo) low += half;
    count -= half;
  }
  for (; low < entries.size() && entries[low].begin <= range.hi; ++low) {
    const Entry& entry = entries[low];
    const bool by_id = entry.state == 0 || keeps_all_links();
    const bool by_mode = entry.state == handed_over;
    body(Leaf{entry.begin, by_id ? Id{entry.of} : none,
              by_mode ? Verdict::reach : static_cast<Verdict>(entry.state), entry.time_s,
              by_id || by_mode ? 0 : std::uint32_t{entry.of}});
  }
}

template <typename Body>
void LeafGraph::for_dependents(std::size_t section, UnitRange range, const Body& body) const {
  for (const Dependent& dependent : dependents_[section]) {
    if (overlap(dependent.range, range)) body(dependent.from);
  }
}

}  // namespace fairway
