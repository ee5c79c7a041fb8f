#include "fairway/inclusion/contract_shares.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "fairway/base/parallel.hpp"
#include "fairway/base/random.hpp"

namespace fairway {
namespace {

using Place = std::pair<std::size_t, Trouble>;  // a cell, and what is the matter there

struct Tally {
  std::array<std::size_t, verdict_count> free{};
  std::array<std::size_t, verdict_count> buffer{};
  std::array<std::size_t, verdict_count> usable{};
  std::size_t at_risk = 0;
  std::size_t at_risk_free = 0;
  double worst_time_s = 0.0;
  std::vector<std::size_t> by_mode;  ///< of all, that reach
  std::map<Place, std::size_t> waiting;

  void add(const Tally& other) {
    for (std::size_t v = 0; v < verdict_count; ++v) {
      free[v] += other.free[v];
      buffer[v] += other.buffer[v];
      usable[v] += other.usable[v];
    }
    at_risk += other.at_risk;
    at_risk_free += other.at_risk_free;
    worst_time_s = std::max(worst_time_s, other.worst_time_s);
    by_mode.resize(std::max(by_mode.size(), other.by_mode.size()), 0);
    for (std::size_t k = 0; k < other.by_mode.size(); ++k) by_mode[k] += other.by_mode[k];
    for (const auto& [place, count] : other.waiting) waiting[place] += count;
  }
};

class Surveyor {
 public:
  Surveyor(const Flow& flow, std::span<const ContractMode> modes, const InclusionProver& prover,
           double speed_mps)
      : flow_(flow),
        modes_(modes),
        parts_(modes.front().parts),
        prover_(prover),
        speed_mps_(speed_mps) {}

  /// Which of the totals a sampled state counts for.
  struct Counts {
    bool of_all;
    bool is_free;
    bool is_usable;
    bool is_looked_into;  ///< what it waits for, when it is undecided
  };
  void look(Cell cell, Vec2 offset, double heading_rad, Counts counts, const IsAtRisk& is_at_risk,
            Tally& tally) const {
    const double per_cell = static_cast<double>(parts_.nx()) / flow_.grid.nx;
    const Vec2 place{(cell.ix + offset.x) * per_cell, (cell.iy + offset.y) * per_cell};
    const auto [answer, mode] = answer_of_modes(modes_, speed_mps_, place, heading_rad);
    const auto verdict = static_cast<std::size_t>(flow_.told(answer.verdict, cell));
    tally.usable[verdict] += counts.is_usable ? 1 : 0;
    if (!counts.of_all) return;
    ++(counts.is_free ? tally.free : tally.buffer)[verdict];
    if (answer.verdict == Verdict::reach) {
      tally.worst_time_s = std::max(tally.worst_time_s, answer.worst_time_s);
      tally.by_mode.resize(modes_.size(), 0);
      ++tally.by_mode[static_cast<std::size_t>(mode)];
    }
    if (answer.verdict != Verdict::undecided) return;
    const Grid& grid = flow_.grid;
    const Vec2 middle = grid.center(cell);
    const Vec2 at_m{middle.x + (offset.x - 0.5) * grid.cell_m,
                    middle.y + (offset.y - 0.5) * grid.cell_m};
    if (is_at_risk && is_at_risk({at_m, Heading::from_rad(heading_rad)})) {
      ++tally.at_risk;
      tally.at_risk_free += counts.is_free ? 1 : 0;
    }
    if (counts.is_looked_into) ++tally.waiting[cause_of(answer, cell)];
  }

 private:
  Place cause_of(const ContractAnswer& answer, Cell cell) const {
    const std::size_t own = flow_.grid.index(cell);
    const bool gave_up = (answer.possible & 1U) != 0;
    if (answer.undecided_section == ContractAnswer::no_section) {
      return {own, gave_up ? Trouble::gave_up : Trouble::mixed};
    }
    const CrossingGraph& graph = prover_.graph();
    const auto unit = static_cast<std::uint32_t>(
        std::clamp(answer.undecided_place * side_units, 0.0, side_units - 1.0));
    const auto range = graph.leaves_of(answer.undecided_section, unit, unit + 1);
    for (auto id = range.first; id < range.last; ++id) {
      if (graph.leaf(id).state != LeafState::open) continue;
      const auto cause = prover_.last().cause[graph.slot(id)];
      const PartPlace part = parts_.place(graph.section_of(cause) / 4);
      const int per_cell = parts_.nx() / flow_.grid.nx;
      return {flow_.grid.index({part.ix / per_cell, part.iy / per_cell}),
              prover_.last().trouble[graph.slot(cause)]};
    }
    return {own, Trouble::mixed};
  }

  const Flow& flow_;
  std::span<const ContractMode> modes_;
  const Parts& parts_;  ///< of mode 0
  const InclusionProver& prover_;
  double speed_mps_;
};

std::array<double, verdict_count> shares_of(const std::array<std::size_t, verdict_count>& counts) {
  std::size_t sum = 0;
  for (const std::size_t n : counts) sum += n;
  std::array<double, verdict_count> shares{};
  for (std::size_t v = 0; v < verdict_count && sum > 0; ++v) {
    shares[v] = static_cast<double>(counts[v]) / static_cast<double>(sum);
  }
  return shares;
}

}  // namespace

ContractSurvey survey(const Flow& flow, const std::vector<bool>& is_free,
                      const std::vector<bool>& is_usable, std::span<const ContractMode> modes,
                      const InclusionProver& prover, double speed_least_mps,
                      const SurveyOptions& options, const std::function<IsAtRisk()>& make_search) {
  const Grid& grid = flow.grid;
  std::size_t cells = 0;
  std::size_t usable = 0;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    if (flow.kind[i] != CellKind::ordinary) continue;
    ++cells;
    usable += is_usable[i] ? 1 : 0;
  }
  ContractSurvey made;
  if (cells == 0) return made;
  constexpr std::size_t fewest = 1000;  // fewer say nothing of shares, and the checker refuses them
  const std::size_t samples_asked = std::max(options.samples, fewest);
  const std::size_t per_cell = (samples_asked + cells - 1) / cells;
  const std::size_t per_usable = usable == 0 ? 0 : (samples_asked + usable - 1) / usable;
  std::vector<Tally> rows(static_cast<std::size_t>(grid.ny));
  const Surveyor surveyor(flow, modes, prover, speed_least_mps);
  for_ranges(rows.size(), 4, [&](std::size_t a, std::size_t b) {
    const IsAtRisk no_search;
    const IsAtRisk is_at_risk = make_search ? make_search() : no_search;
    for (std::size_t row = a; row < b; ++row) {
      for (int ix = 0; ix < grid.nx; ++ix) {
        const Cell cell{ix, static_cast<int>(row)};
        const std::size_t i = grid.index(cell);
        if (flow.kind[i] != CellKind::ordinary) continue;
        const bool looks = options.search_all || is_usable[i];
        const IsAtRisk& search = looks ? is_at_risk : no_search;
        Random random(options.seed * 0x9e3779b97f4a7c15U + i);
        for (std::size_t k = 0; k < (is_usable[i] ? per_usable : per_cell); ++k) {
          const Vec2 offset{random.unit(), random.unit()};
          const double heading_rad = random.uniform(-pi, pi);
          surveyor.look(cell, offset, heading_rad, {k < per_cell, is_free[i], is_usable[i], looks},
                        search, rows[row]);
        }
      }
    }
  });
  Tally total;
  for (const Tally& row : rows) total.add(row);
  made.shares.samples = cells * per_cell;
  std::array<std::size_t, verdict_count> all{};
  std::size_t free_states = 0;
  for (std::size_t v = 0; v < verdict_count; ++v) {
    all[v] = total.free[v] + total.buffer[v];
    free_states += total.free[v];
  }
  const auto samples = static_cast<double>(made.shares.samples);
  made.shares.all = shares_of(all);
  made.shares.free = shares_of(total.free);
  made.shares.buffer = shares_of(total.buffer);
  made.shares.usable = shares_of(total.usable);
  made.shares.usable_samples = usable * per_usable;
  made.shares.at_risk = static_cast<double>(total.at_risk) / samples;
  if (free_states > 0) {
    made.shares.at_risk_free =
        static_cast<double>(total.at_risk_free) / static_cast<double>(free_states);
  }
  made.shares.worst_time_s = total.worst_time_s;
  if (modes.size() > 1) {
    total.by_mode.resize(modes.size(), 0);
    for (const std::size_t n : total.by_mode) {
      made.shares.reach_by_mode.push_back(static_cast<double>(n) / samples);
    }
  }
  for (const auto& [place, count] : total.waiting) {
    made.chokes.push_back(
        {grid.cell_at(place.first), place.second, static_cast<double>(count) / samples});
  }
  std::stable_sort(made.chokes.begin(), made.chokes.end(),
                   [](const Choke& x, const Choke& y) { return x.share > y.share; });
  if (made.chokes.size() > options.most_chokes) made.chokes.resize(options.most_chokes);
  return made;
}

}  // namespace fairway
