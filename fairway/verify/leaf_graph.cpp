#include "fairway/verify/leaf_graph.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fairway/base/error.hpp"

namespace fairway {
namespace {

constexpr UnitRange whole_side{0, 0xffffffffU};

/// How many changed cells lie in a rectangle of cells, in constant time.
class ChangedCells {
 public:
  ChangedCells(const Grid& grid, const std::vector<bool>& changed) : grid_(grid) {
    const auto nx = static_cast<std::size_t>(grid.nx) + 1;
    sums_.assign(nx * (static_cast<std::size_t>(grid.ny) + 1), 0);
    for (std::size_t i = 0; i < changed.size(); ++i) {
      const Cell c = grid.cell_at(i);
      at(c.ix + 1, c.iy + 1) =
          at(c.ix, c.iy + 1) + at(c.ix + 1, c.iy) - at(c.ix, c.iy) + (changed[i] ? 1 : 0);
    }
  }
  bool any_within(Cell c, double reach_cells) const {
    const double far = std::max(grid_.nx, grid_.ny);
    const int reach = static_cast<int>(std::min(reach_cells, far));
    const int x0 = std::max(c.ix - reach, 0);
    const int y0 = std::max(c.iy - reach, 0);
    const int x1 = std::min(c.ix + reach + 1, grid_.nx);
    const int y1 = std::min(c.iy + reach + 1, grid_.ny);
    return at(x1, y1) - at(x0, y1) - at(x1, y0) + at(x0, y0) != 0;
  }

 private:
  std::uint32_t& at(int x, int y) { return sums_[place(x, y)]; }
  std::uint32_t at(int x, int y) const { return sums_[place(x, y)]; }
  std::size_t place(int x, int y) const {
    return static_cast<std::size_t>(y) * (static_cast<std::size_t>(grid_.nx) + 1) +
           static_cast<std::size_t>(x);
  }
  const Grid& grid_;
  std::vector<std::uint32_t> sums_;  // [iy][ix], of all cells lower and left
};

}  // namespace

LeafGraph::LeafGraph(const SectionVerdicts& start, Keep keep)
    : keep_(keep), on_section_(start.first.size() - 1), dependents_(start.first.size() - 1) {
  require(start.first.size() < none, "there are fewer than 2^32 sections");
  leaf_.reserve(start.leaves());
  for (std::size_t s = 0; s + 1 < start.first.size(); ++s) {
    for (std::size_t i = start.first[s]; i < start.first[s + 1]; ++i) {
      const UnitRange range = start.range_of(s, i);
      const Id id = add_leaf(s, range);
      on_section_.add(s, {range.lo, id});
      if (start.verdict[i] != static_cast<std::uint8_t>(Verdict::undecided)) {
        decide(id, static_cast<Verdict>(start.verdict[i]), start.rank[i], start.time_s[i]);
      }
    }
  }
}

LeafGraph::Id LeafGraph::add_leaf(std::size_t section, UnitRange range) {
  Leaf leaf;
  leaf.section = static_cast<std::uint32_t>(section);
  leaf.range = range;
  require(leaf_.size() < none, "there are fewer than 2^32 leaves");
  leaf_.push_back(leaf);
  ++leaf_count_;
  ++open_count_;
  return ids() - 1;
}

std::uint32_t LeafGraph::highest_rank() const {
  std::uint32_t rank = 0;
  for (const Leaf& leaf : leaf_) rank = std::max(rank, leaf.rank);
  return rank;
}

std::uint32_t LeafGraph::room_for(std::uint32_t count) {
  if (count < free_.size() && !free_[count].empty()) {
    const std::uint32_t first = free_[count].back();
    free_[count].pop_back();
    return first;
  }
  require(link_.size() + count < none, "there are fewer than 2^32 links");
  const auto first = static_cast<std::uint32_t>(link_.size());
  link_.resize(link_.size() + count);
  return first;
}

void LeafGraph::free_links(Id id) {
  Leaf& leaf = leaf_[id];
  if (leaf.link_count == 0) return;
  for (const Link& link : links(id)) {
    const std::span<const Dependent> all = dependents_[link.section];
    std::size_t at = all.size();  // from the end: what was linked last is mostly removed first
    while (all[--at].from != id) {
    }
    dependents_.remove(link.section, at);
  }
  if (free_.size() <= leaf.link_count) free_.resize(leaf.link_count + std::size_t{1});
  free_[leaf.link_count].push_back(leaf.first_link);
  leaf.link_count = 0;
}

void LeafGraph::set_image(Id id, const Image& image) {
  free_links(id);
  const auto count = static_cast<std::uint32_t>(image.pieces.size());
  const std::uint32_t first = room_for(count);
  Leaf& leaf = leaf_[id];
  leaf.gave_up = image.gave_up;
  leaf.end_bits = image.ends.bits;
  leaf.end_time_s = image.ends.time_s;
  leaf.first_link = first;
  leaf.link_count = count;
  for (std::uint32_t k = 0; k < count; ++k) {
    const ImagePiece& piece = image.pieces[k];
    const bool own = piece.hop && piece.section == leaf.section;
    link_[first + k] = {piece.section, piece.range, piece.flown_s,
                        own ? static_cast<std::uint32_t>(least_move(piece, leaf.range)) : 0};
    dependents_.add(piece.section, {piece.range, id});
  }
}

void LeafGraph::decide(Id id, Verdict verdict, std::uint32_t rank, float time_s) {
  require(is_open(id), "a leaf that is decided was open");
  Leaf& leaf = leaf_[id];
  leaf.verdict = verdict;
  leaf.rank = rank;
  leaf.time_s = time_s;
  --open_count_;
  if (keep_ == Keep::links_of_open_leaves) free_links(id);
}

void LeafGraph::decide_by_hand_over(Id id, std::uint8_t mode, float time_s) {
  decide(id, Verdict::reach, 0, time_s);
  leaf_[id].next_mode = mode;
}

LeafGraph::Id LeafGraph::cut(Id id) {
  require(is_open(id), "a leaf that is cut was open");
  free_links(id);
  const UnitRange range = leaf_[id].range;
  const auto half = static_cast<std::uint32_t>(std::ceil(0.5 * width_of(range)));
  const std::uint32_t middle = range.lo + half;
  const std::uint32_t section = leaf_[id].section;
  const Id high = add_leaf(section, {middle, range.hi});
  Leaf& low = leaf_[id];
  low = Leaf{};
  low.section = section;
  low.range = {range.lo, middle};
  const std::span<const Place> places = on_section_[section];
  std::size_t at = 0;
  while (places[at].id != id) ++at;
  on_section_.insert(section, at + 1, {middle, high});
  return high;
}

void LeafGraph::make_undecided(Id id) {
  Leaf& leaf = leaf_[id];
  leaf.verdict = Verdict::undecided;
  leaf.rank = 0;
  leaf.time_s = 0.0F;
  ++open_count_;
}

/// For every leaf, whether its flights may have come near a changed cell: they came no farther than
/// their length. Flights of a leaf that gave up, or that circle, have no known length.
std::vector<bool> LeafGraph::may_have_flown_through(const Flow& flow,
                                                    const std::vector<bool>& changed_cells) const {
  const ChangedCells changed(flow.grid, changed_cells);
  // Covers the step into the cell beyond, rounding of times, and the border of the last cell.
  constexpr double margin_cells = 4.0;
  const double cells_per_s = 1.001 * flow.vehicle.speed_mps / flow.grid.cell_m;
  std::vector<bool> may(leaf_.size(), false);
  for (Id id = 0; id < ids(); ++id) {
    const Leaf& leaf = leaf_[id];
    if (leaf.section == none) continue;
    double longest_s = leaf.gave_up ? std::numeric_limits<double>::infinity() : leaf.end_time_s;
    for (const Link& link : links(id)) {
      longest_s = std::max(longest_s, static_cast<double>(link.flown_s));
    }
    may[id] = changed.any_within(flow.grid.cell_at(leaf.section / 4),
                                 longest_s * cells_per_s + margin_cells);
  }
  return may;
}

/// Gives a section its first leaves, or removes those it had.
void LeafGraph::renew_section(std::size_t section, bool there) {
  if (there) {
    constexpr std::uint32_t count = 4;
    constexpr std::uint32_t step = 0x40000000U;
    for (std::uint32_t k = 0; k < count; ++k) {
      const std::uint32_t end = k + 1 == count ? whole_side.hi : (k + 1) * step;
      on_section_.add(section, {k * step, add_leaf(section, {k * step, end})});
    }
    return;
  }
  for (const Place& place : on_section_[section]) {
    open_count_ -= leaf_[place.id].verdict == Verdict::undecided ? 1 : 0;
    --leaf_count_;
    free_links(place.id);
    leaf_[place.id].section = none;
  }
  on_section_.clear(section);
}

std::vector<LeafGraph::Id> LeafGraph::invalidate(const Flow& flow,
                                                 const std::vector<bool>& changed_cells) {
  require(keep_ == Keep::all_links, "a graph that is to be invalidated keeps all links");
  require(changed_cells.size() == flow.grid.size(), "a flag for every cell");
  const std::vector<bool> stale = may_have_flown_through(flow, changed_cells);
  std::vector<Id> work;  // newly undecided; their dependents are still to be processed
  for (Id id = 0; id < stale.size(); ++id) {
    if (!stale[id]) continue;
    if (leaf_[id].verdict != Verdict::undecided) make_undecided(id);
    free_links(id);
    Leaf& leaf = leaf_[id];
    leaf.end_bits = 0;
    leaf.end_time_s = 0.0;
    leaf.gave_up = true;  // until it has an image
    work.push_back(id);
  }
  while (!work.empty()) {
    const LeafPlace changed = place(work.back());
    work.pop_back();
    for_dependents(changed.section, changed.range, [&](Id other) {
      if (leaf_[other].verdict == Verdict::undecided) return;
      make_undecided(other);
      work.push_back(other);
    });
  }
  // A section that appears or disappears is next to a changed cell: its leaves are stale.
  for (std::size_t s = 0; s < 4 * flow.grid.size(); ++s) {
    if (is_section(flow, s) != has_leaves(s)) renew_section(s, is_section(flow, s));
  }
  std::vector<Id> to_fly;
  for (Id id = 0; id < ids(); ++id) {
    if (is_open(id) && (id >= stale.size() || stale[id])) to_fly.push_back(id);
  }
  return to_fly;
}

SectionVerdicts LeafGraph::sections() const {
  SectionVerdicts out;
  const std::size_t sections = on_section_.size();
  out.first.reserve(sections + 1);
  out.first.push_back(0);
  for (std::size_t s = 0; s < sections; ++s) {
    for (const Place& place : on_section_[s]) {
      const Leaf& leaf = leaf_[place.id];
      out.begin.push_back(leaf.range.lo);
      out.rank.push_back(leaf.rank);
      out.verdict.push_back(static_cast<std::uint8_t>(leaf.verdict));
      out.time_s.push_back(leaf.time_s);
      out.next_mode.push_back(leaf.next_mode);
    }
    out.first.push_back(static_cast<std::uint32_t>(out.begin.size()));
  }
  const bool hands_over = std::any_of(out.next_mode.begin(), out.next_mode.end(),
                                      [](std::uint8_t mode) { return mode != no_mode; });
  if (!hands_over) out.next_mode = {};
  return out;
}

std::size_t LeafGraph::bytes() const {
  std::size_t total = leaf_.capacity() * sizeof(Leaf) + link_.capacity() * sizeof(Link) +
                      on_section_.bytes() + dependents_.bytes();
  for (const auto& unused : free_) total += unused.capacity() * sizeof(std::uint32_t);
  return total;
}

}  // namespace fairway
