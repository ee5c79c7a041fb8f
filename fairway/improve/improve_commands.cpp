#include "fairway/improve/improve_commands.hpp"

#include <algorithm>
#include <cmath>
#include <deque>

#include "fairway/base/error.hpp"
#include "fairway/base/parallel.hpp"

namespace fairway {

namespace {

class Ascent {
 public:
  Ascent(SampledFlow& flow, const Grid& grid, const ImproveOptions& options,
         const std::vector<std::uint8_t>& frozen)
      : flow_(flow), grid_(grid), options_(options), frozen_(frozen), awake_(grid.size(), 1) {
    for (std::size_t i = 0; i < threads; ++i) trials_.emplace_back(flow);
  }

  std::vector<std::size_t> cells_to_try() const {
    std::vector<std::size_t> cells;
    std::vector<std::size_t> failing(grid_.size(), 0);
    for (std::size_t cell = 0; cell < grid_.size(); ++cell) {
      if (awake_[cell] == 0 || !may_change(cell)) continue;
      failing[cell] = flow_.failing_near(cell);
      if (failing[cell] > 0) cells.push_back(cell);
    }
    std::stable_sort(cells.begin(), cells.end(),
                     [&](std::size_t a, std::size_t b) { return failing[a] > failing[b]; });
    return cells;
  }

  /// Whether the cell's command was changed.
  bool try_cell(std::size_t cell) {
    awake_[cell] = 0;
    list_candidates(cell);
    gains_.assign(candidates_.size(), 0);
    for_ranges(threads, 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t t = begin; t < end; ++t) {
        for (std::size_t i = t; i < candidates_.size(); i += threads) {
          const ModelChange change = trials_[t].ask({&candidates_[i], 1});
          gains_[i] = change.reached - options_.tear_price * change.tears -
                      options_.border_price * change.borders;
        }
      }
    });
    const auto best = std::max_element(gains_.begin(), gains_.end());
    if (best == gains_.end() || *best < options_.least_gain) return false;
    const CommandChange& change = candidates_[static_cast<std::size_t>(best - gains_.begin())];
    flow_.apply({&change, 1});
    for (SampledFlow::Trial& trial : trials_) trial.follow({&change, 1});
    changes_.push_back(change);
    wake_around(cell);
    return true;
  }

  std::vector<CommandChange> take_changes() { return std::move(changes_); }
  std::size_t changed() const { return changes_.size(); }

 private:
  static constexpr std::size_t threads = 4;

  bool may_change(std::size_t cell) const {
    return flow_.kind(cell) == CellKind::ordinary && !std::isnan(flow_.heading_rad(cell)) &&
           (frozen_.empty() || frozen_[cell] == 0);
  }

  template <typename Body>
  void for_neighbours(std::size_t cell, int width, const Body& body) const {
    const Cell at = grid_.cell_at(cell);
    for (int dy = -width; dy <= width; ++dy) {
      for (int dx = -width; dx <= width; ++dx) {
        const Cell c{at.ix + dx, at.iy + dy};
        if ((dx != 0 || dy != 0) && grid_.contains(c)) body(grid_.index(c));
      }
    }
  }

  bool bends_too_much(const CommandChange& change) const {
    const double before = flow_.heading_rad(change.cell);
    bool too_much = false;
    for_neighbours(change.cell, 1, [&](std::size_t next) {
      const double h = flow_.heading_rad(next);
      if (flow_.kind(next) != CellKind::ordinary || std::isnan(h)) return;
      const double bend = angle_between(change.heading_rad, h);
      too_much |= bend > options_.most_bend_rad && bend > angle_between(before, h);
    });
    return too_much;
  }

  void list_candidates(std::size_t cell) {
    static constexpr double fine_rad[]{0.07, 0.21, 0.6};
    candidates_.clear();
    const auto add = [&](double heading_rad) {
      const CommandChange change{cell, Heading::stored(Heading::from_rad(heading_rad).rad())};
      if (!bends_too_much(change)) candidates_.push_back(change);
    };
    for (int k = 0; k < options_.directions; ++k)
      add(two_pi * (k + 0.5) / options_.directions - pi);
    const double before = flow_.heading_rad(cell);
    for (const double by : fine_rad) add(before + by), add(before - by);
  }

  /// What meets a cell soon before or after this one may now gain by another command.
  void wake_around(std::size_t cell) {
    for_neighbours(cell, 2, [&](std::size_t next) { awake_[next] = 1; });
  }

  SampledFlow& flow_;
  const Grid& grid_;
  const ImproveOptions& options_;
  const std::vector<std::uint8_t>& frozen_;
  std::deque<SampledFlow::Trial> trials_;
  std::vector<std::uint8_t> awake_;  // by cell: to be tried
  std::vector<CommandChange> candidates_;
  std::vector<std::int64_t> gains_;
  std::vector<CommandChange> changes_;
};

}  // namespace

std::vector<CommandChange> improve_commands(
    SampledFlow& flow, const Grid& grid, const ImproveOptions& options,
    const std::vector<std::uint8_t>& frozen,
    const std::function<bool(const ImproveProgress&)>& go_on) {
  require(options.sweeps >= 0 && options.directions > 0 && options.least_gain > 0,
          "options of improvement are positive");
  Ascent ascent(flow, grid, options, frozen);
  for (int sweep = 1; sweep <= options.sweeps; ++sweep) {
    const std::vector<std::size_t> cells = ascent.cells_to_try();
    std::size_t tried = 0;
    bool gained = false;
    for (const std::size_t cell : cells) {
      gained |= ascent.try_cell(cell);
      const double share = flow.starts() == 0 ? 0.0
                                              : static_cast<double>(flow.reached()) /
                                                    static_cast<double>(flow.starts());
      if (go_on && !go_on({sweep, ++tried, cells.size(), ascent.changed(), share}))
        return ascent.take_changes();
    }
    if (!gained) break;
  }
  return ascent.take_changes();
}

}  // namespace fairway
