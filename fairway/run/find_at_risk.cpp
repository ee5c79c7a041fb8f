#include "fairway/run/find_at_risk.hpp"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "fairway/base/parallel.hpp"
#include "fairway/base/random.hpp"
#include "fairway/run/ask_contract.hpp"

namespace fairway {
namespace {

/// States, numbered heading * samples + sample, in an order without pattern.
std::vector<std::size_t> shuffled(std::vector<std::size_t> states) {
  const auto rank = [](std::size_t state) {
    std::uint64_t mixed = state;
    return splitmix64(mixed);
  };
  std::sort(states.begin(), states.end(),
            [&](std::size_t a, std::size_t b) { return rank(a) < rank(b); });
  return states;
}

/// Whether some part of the cell has leaves.
bool claims_something(const ContractCertificate& c, Cell cell) {
  if (!c.follow) return true;
  const int k = c.parts_per_cell;
  for (int iy = cell.iy * k; iy < (cell.iy + 1) * k; ++iy) {
    for (int ix = cell.ix * k; ix < (cell.ix + 1) * k; ++ix) {
      const std::size_t part =
          static_cast<std::size_t>(iy) * static_cast<std::size_t>(c.grid.nx * k) +
          static_cast<std::size_t>(ix);
      if (c.verdicts.first[4 * part] < c.verdicts.first[4 * part + 4]) return true;
    }
  }
  return false;
}

}  // namespace

PageWitnesses find_at_risk(const ContractCertificate& certificate, const VerdictMap& map,
                           const AtRiskOptions& options) {
  PageWitnesses found;
  found.at_risk.assign(map.verdict.size(), 0);
  std::vector<std::size_t> open;
  for (std::size_t k = 0; k < map.verdict.size(); ++k) {
    const bool is_state = map.kind[k % map.samples()] == CellKind::ordinary;
    if (!is_state || map.verdict[k] != Verdict::undecided) continue;
    if (claims_something(certificate, map.cell_of_sample(k % map.samples()))) open.push_back(k);
  }
  if (open.empty()) return found;
  if (open.size() > options.most_searches) {
    found.not_searched = open.size() - options.most_searches;
    open = shuffled(std::move(open));
    open.resize(options.most_searches);
    std::sort(open.begin(), open.end());
  }
  const ContractQueries queries(certificate);
  queries.prepare_searches();
  std::vector<std::optional<BehaviourFlight>> flights(open.size());
  for_ranges(open.size(), 4, [&](std::size_t begin, std::size_t end) {
    WitnessSearch search = queries.search();
    for (std::size_t i = begin; i < end; ++i) {
      const State start{map.place_m(open[i] % map.samples()),
                        Heading::from_rad(map.heading_rad[open[i] / map.samples()])};
      flights[i] = search.find(start);
    }
  });

  std::vector<std::size_t> at_risk;  // indices into `open`
  for (std::size_t i = 0; i < open.size(); ++i) {
    if (!flights[i]) continue;
    found.at_risk[open[i]] = 1;
    at_risk.push_back(i);
  }
  std::vector<std::size_t> kept;
  std::size_t steps = 0;
  for (const std::size_t i : shuffled(at_risk)) {
    const std::size_t its = flights[i]->steps.size();
    if (its > options.longest_steps || steps + its > options.most_steps) continue;
    steps += its;
    kept.push_back(i);
  }
  std::sort(kept.begin(), kept.end());
  for (const std::size_t i : kept) {
    PageWitness witness{open[i] / map.samples(), open[i] % map.samples(), Verdict::collide,
                        queries.explained(*flights[i])};
    const Cell end = map.grid.cell_of(witness.behaviour.end.position_m);
    if (!map.grid.contains(end)) witness.end = Verdict::leave;
    found.shown.push_back(std::move(witness));
  }
  return found;
}

}  // namespace fairway
