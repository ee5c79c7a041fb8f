#include <algorithm>
#include <cmath>
#include <limits>

#include "fairway/base/error.hpp"
#include "fairway/verify/leaf_graph.hpp"

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

void LeafGraph::make_undecided(Id id) {
  Entry& entry = entry_of(id);
  entry.state = 0;
  entry.of = id & most_of;
  entry.time_s = 0.0F;
  open_[id].verdict = Verdict::undecided;
  known_[id] = {};
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
  std::vector<bool> may(ids(), false);
  for (Id id = 0; id < ids(); ++id) {
    const Open& leaf = open_[id];
    if (leaf.section == none) continue;
    double longest_s = gave_up(id) ? std::numeric_limits<double>::infinity() : leaf.end_time_s;
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
      on_section_.add(section, entry(k * step, new_id(section, {k * step, end})));
    }
    return;
  }
  for (const Entry& entry : on_section_[section]) {
    const Id id = entry.of;
    open_count_ -= open_[id].verdict == Verdict::undecided ? 1 : 0;
    --leaf_count_;
    free_links(id);
    open_[id].section = none;
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
    if (open_[id].verdict != Verdict::undecided) make_undecided(id);
    free_links(id);
    Open& leaf = open_[id];
    leaf.end_bits = 0;
    leaf.end_time_s = 0.0;
    leaf.flags |= gave_up_flag;  // until it has an image
    work.push_back(id);
  }
  while (!work.empty()) {
    const LeafPlace changed = place(work.back());
    work.pop_back();
    for_dependents(changed.section, changed.range, [&](Id other) {
      if (open_[other].verdict == Verdict::undecided) return;
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

}  // namespace fairway
