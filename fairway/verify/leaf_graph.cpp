#include "fairway/verify/leaf_graph.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "fairway/base/error.hpp"

namespace fairway {
namespace {

constexpr std::uint32_t chunk = std::uint32_t{1} << 14;  // entries of ChunkedArray

}  // namespace

LeafGraph::LeafGraph(const SectionVerdicts& start, Keep keep)
    : keep_(keep), on_section_(start.first.size() - 1), dependents_(start.first.size() - 1) {
  require(start.first.size() <= most_section, "there are fewer than 2^31 sections");
  for (std::size_t s = 0; s + 1 < start.first.size(); ++s) {
    on_section_.make_room(s, start.first[s + 1] - start.first[s]);
    for (std::size_t i = start.first[s]; i < start.first[s + 1]; ++i) {
      const UnitRange range = start.range_of(s, i);
      const Id id = new_id(s, range);
      on_section_.add(s, entry(range.lo, id));
      if (start.verdict[i] != static_cast<std::uint8_t>(Verdict::undecided)) {
        decide(id, static_cast<Verdict>(start.verdict[i]), start.rank[i], start.time_s[i]);
        release(id);
      }
    }
  }
}

/// For a new leaf, an open one.
LeafGraph::Id LeafGraph::new_id(std::size_t section, UnitRange range) {
  Id id = unused_id_;
  if (id != none) {
    unused_id_ = open_[id].first_link;
  } else {
    id = open_.add(1);
    require(id <= most_of, "there are fewer than 2^29 open leaves");
    if (keeps_all_links()) known_.resize(open_.size());
  }
  open_[id] = {static_cast<std::uint32_t>(section), range, 0, 0, Verdict::undecided, 0, 0, 0, 0.0};
  ++leaf_count_;
  ++open_count_;
  return id;
}

void LeafGraph::release(Id id) {
  if (keeps_all_links()) return;
  require(!is_open(id) && open_[id].section != none, "a leaf that is released is decided");
  open_[id].section = none;
  open_[id].first_link = std::exchange(unused_id_, id);
}

LeafGraph::Entry& LeafGraph::entry_of(Id id) {
  const std::span<Entry> entries = on_section_[open_[id].section];
  const std::uint32_t begin = open_[id].range.lo;
  return *std::lower_bound(entries.begin(), entries.end(), begin,
                           [](const Entry& entry, std::uint32_t at) { return entry.begin < at; });
}

LeafGraph::Known LeafGraph::known(Id id) const {
  return keeps_all_links() && !is_open(id) ? known_[id] : Known{};
}

std::uint32_t LeafGraph::room_for(std::uint32_t count) {
  if (free_.size() <= count) free_.resize(count + std::size_t{1});
  // Next to a block longer than a chunk there is no other.
  if (free_[count].empty()) return link_.add(count <= chunk ? count : (count / chunk + 1) * chunk);
  const std::uint32_t first = free_[count].back();
  free_[count].pop_back();
  return first;
}

void LeafGraph::free_room(std::uint32_t first, std::uint32_t count) {
  if (count == 0) return;
  if (free_.size() <= count) free_.resize(count + std::size_t{1});
  free_[count].push_back(first);
}

void LeafGraph::remove_dependent(const Link& link, Id id) {
  const std::span<const Dependent> all = std::as_const(dependents_)[link.section];
  std::size_t at = all.size();  // from the end: what was linked last is mostly removed first
  do {
    --at;
  } while (all[at].from != id || all[at].range.lo != link.range.lo ||
           all[at].range.hi != link.range.hi);
  dependents_.remove(link.section, at);
}

void LeafGraph::stop_awaiting(Id id) {
  if ((open_[id].flags & awaits_flag) == 0) return;
  for (const Link& link : links(id)) remove_dependent(link, id);
  open_[id].flags &= static_cast<std::uint8_t>(~awaits_flag);
}

void LeafGraph::free_links(Id id) {
  stop_awaiting(id);
  Open& open = open_[id];
  free_room(open.first_link, open.link_count);
  open.link_count = 0;
}

void LeafGraph::keep_image(Id id, const Image& image) {
  free_links(id);
  const auto count = static_cast<std::uint32_t>(image.pieces.size());
  Open& open = open_[id];
  open.flags =
      static_cast<std::uint8_t>((open.flags & in_part_flag) | (image.gave_up ? gave_up_flag : 0));
  open.end_bits = image.ends.bits;
  open.end_time_s = image.ends.time_s;
  if (count == 0) return;
  open.first_link = room_for(count);
  open.link_count = count;
  Link* link = link_.block(open.first_link);
  for (const ImagePiece& piece : image.pieces) {
    const bool hop = piece.hop && piece.section == open.section;
    *link++ = {piece.section & most_section, hop ? 1U : 0U, piece.range, piece.flown_s};
  }
}

/// What a link leads to, if all of it is decided, is the leaf's own end from now on: true.
bool LeafGraph::fold(Id id, const Link& link) {
  VerdictSet found = ends(id);
  bool decided = has_leaves(link.section);
  for_leaves(link.section, link.range, [&](const Leaf& leaf) {
    decided = decided && leaf.verdict != Verdict::undecided;
    found.add(leaf.verdict,
              above(static_cast<double>(link.flown_s) + static_cast<double>(leaf.time_s)));
  });
  if (!decided) return false;
  open_[id].end_bits = found.bits;
  open_[id].end_time_s = found.time_s;
  return true;
}

void LeafGraph::await_links(Id id) {
  Open& open = open_[id];
  if (open.link_count == 0) return;
  const bool awaits = (open.flags & awaits_flag) != 0;
  if (awaits && keeps_all_links()) return;
  Link* const link = link_.block(open.first_link);
  std::uint32_t left = 0;
  for (std::uint32_t k = 0; k < open.link_count; ++k) {
    const Link this_one = link[k];
    if (!keeps_all_links() && fold(id, this_one)) {
      if (awaits) remove_dependent(this_one, id);
      continue;
    }
    if (!awaits) dependents_.add(this_one.section, {this_one.range, id});
    link[left++] = this_one;
  }
  // Of a block longer than a chunk what is over is lost: it could not be named from its middle.
  if (open.link_count <= chunk) free_room(open.first_link + left, open.link_count - left);
  open.link_count = left;
  open.flags |= awaits_flag;
}

void LeafGraph::give_up_hope(Id id, VerdictSet found) {
  constexpr auto undecided = static_cast<std::uint8_t>(1U << static_cast<unsigned>(0));
  stop_awaiting(id);
  open_[id].flags |= hopeless_flag;
  open_[id].end_bits |= static_cast<std::uint8_t>(found.bits & ~undecided);
}

void LeafGraph::decide(Id id, Verdict verdict, Known known) {
  require(is_open(id), "a leaf that is decided was open");
  Entry& entry = entry_of(id);
  const bool by_mode = known.next_mode != no_mode;
  entry.state = (by_mode ? handed_over : static_cast<std::uint32_t>(verdict)) & 7U;
  entry.time_s = known.time_s;
  open_[id].verdict = verdict;
  --open_count_;
  highest_rank_ = std::max(highest_rank_, known.rank);
  if (keeps_all_links()) {
    known_[id] = known;
    return;
  }
  const std::uint32_t of = by_mode ? known.next_mode : known.rank;
  require(of <= most_of, "a rank is less than 2^29");
  entry.of = of & most_of;
  free_links(id);
}

void LeafGraph::decide(Id id, Verdict verdict, std::uint32_t rank, float time_s) {
  decide(id, verdict, Known{rank, time_s, no_mode});
}

void LeafGraph::decide_by_hand_over(Id id, std::uint8_t mode, float time_s) {
  decide(id, Verdict::reach, Known{0, time_s, mode});
}

LeafGraph::Id LeafGraph::cut(Id id) {
  require(is_open(id), "a leaf that is cut was open");
  free_links(id);
  const UnitRange range = open_[id].range;
  const auto half = static_cast<std::uint32_t>(std::ceil(0.5 * width_of(range)));
  const std::uint32_t middle = range.lo + half;
  const std::uint32_t section = open_[id].section;
  const Id high = new_id(section, {middle, range.hi});
  open_[id] = {section, {range.lo, middle}, 0, 0, Verdict::undecided, 0, 0, 0, 0.0};
  const std::size_t at = static_cast<std::size_t>(&entry_of(id) - on_section_[section].data());
  on_section_.insert(section, at + 1, entry(middle, high));
  return high;
}

SectionVerdicts LeafGraph::sections() const {
  SectionVerdicts out;
  const std::size_t sections = on_section_.size();
  out.first.reserve(sections + 1);
  out.first.push_back(0);
  out.begin.reserve(leaf_count_);
  out.rank.reserve(leaf_count_);
  out.verdict.reserve(leaf_count_);
  out.time_s.reserve(leaf_count_);
  for (std::size_t s = 0; s < sections; ++s) {
    for (const Entry& entry : on_section_[s]) {
      const bool by_id = entry.state == 0 || keeps_all_links();
      Known known{entry.of, entry.time_s, no_mode};
      if (by_id) {
        known = this->known(entry.of);
      } else if (entry.state == handed_over) {
        known = {0, entry.time_s, static_cast<std::uint8_t>(entry.of)};
      }
      if (known.next_mode != no_mode && out.next_mode.empty()) {
        out.next_mode.reserve(leaf_count_);
        out.next_mode.assign(out.begin.size(), no_mode);
      }
      if (!out.next_mode.empty() || known.next_mode != no_mode) {
        out.next_mode.push_back(known.next_mode);
      }
      out.begin.push_back(entry.begin);
      out.rank.push_back(known.rank);
      out.verdict.push_back(entry.state == handed_over ? static_cast<std::uint8_t>(Verdict::reach)
                                                       : static_cast<std::uint8_t>(entry.state));
      out.time_s.push_back(known.time_s);
    }
    out.first.push_back(static_cast<std::uint32_t>(out.begin.size()));
  }
  return out;
}

SectionVerdicts LeafGraph::into_sections() {
  if (!keeps_all_links()) {
    open_ = {};
    link_ = {};
    free_.clear();
    dependents_ = SectionLists<Dependent>(0);
  }
  SectionVerdicts out = sections();
  on_section_ = SectionLists<Entry>(0);
  return out;
}

std::size_t LeafGraph::bytes() const {
  std::size_t total = open_.bytes() + link_.bytes() + on_section_.bytes() + dependents_.bytes() +
                      known_.capacity() * sizeof(Known);
  for (const auto& unused : free_) total += unused.capacity() * sizeof(std::uint32_t);
  return total;
}

}  // namespace fairway
