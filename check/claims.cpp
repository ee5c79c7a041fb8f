#include "check/claims.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "check/tensors.hpp"

namespace fairway_check {
namespace {

/// Of all ordinary cells, of those for safe starts, of the others.
enum Portion { all_cells, free_cells, buffer_cells };
constexpr const char* portion_name[3]{"volume_fraction", "volume_fraction_free",
                                      "volume_fraction_buffer"};
/// What shares tell apart: verdicts, and `hold`, which is trapped by another name where the plan
/// holds.
constexpr std::size_t hold = verdict_count;
constexpr std::size_t word_count = verdict_count + 1;
/// Shares of the volume by portion and word.
using Shares = std::array<std::array<double, word_count>, 3>;

/// Too few for a meaningful share; no certificate is measured with fewer.
constexpr double least_samples = 1000.0;

struct Claims {
  Shares shares{};  ///< 0 without cells
  double samples = 0.0;
  double worst_time_s = 0.0;
  std::vector<double> reach_by_mode;  ///< [mode], the first in which states reach; or empty
};

/// Who reaches the core follows the path, or has reached the goal, where it stays.
const char* name_in(const nlohmann::json& record, std::size_t word) {
  if (word == hold) return "hold";
  const bool follows = record.contains("follow") && !record["follow"].contains("hold");
  return word == reach && follows ? "follow" : verdict_name[word];
}

/// Evidence that a record may have.
std::vector<double> reach_by_mode_in(const nlohmann::json& record, std::size_t modes) {
  if (!record.contains("reach_by_mode")) return {};
  const auto shares = record["reach_by_mode"].get<std::vector<double>>();
  require(shares.size() == modes, "reach_by_mode: expected a share for every mode");
  double sum = 0.0;
  for (const double share : shares) {
    require(share >= 0.0, "reach_by_mode: negative share");
    sum += share;
  }
  const double reaching = record.at("volume_fraction").at("reach");
  require(std::abs(sum - reaching) < 1e-9, "reach_by_mode: does not sum to the share that reaches");
  return shares;
}

Claims claims_of(const nlohmann::json& record, std::size_t modes) {
  Claims claims{.samples = record.at("samples"),
                .worst_time_s = record.at("worst_time_s"),
                .reach_by_mode = reach_by_mode_in(record, modes)};
  for (std::size_t p = 0; p < claims.shares.size(); ++p) {
    double sum = 0.0;
    const nlohmann::json& named = record.at(portion_name[p]);
    for (std::size_t v = 0; v < word_count; ++v) {
      // Only a plan that holds has a share that does.
      const double share =
          v == hold ? named.value("hold", 0.0) : named.at(name_in(record, v)).get<double>();
      require(share >= 0.0, "volume_fraction: negative share");
      sum += claims.shares[p][v] = share;
    }
    require(sum == 0.0 || std::abs(sum - 1.0) < 1e-9,
            "volume_fraction: the shares do not sum to 1");
    require(sum == 0.0 || claims.samples >= least_samples,
            "samples: the shares rest on too few, expected at least 1000");
  }
  require(claims.worst_time_s >= 0.0, "worst_time_s: is negative");
  return claims;
}

constexpr std::size_t states_at_once = 1 << 16;

/// What the leaves say about states drawn from all ordinary cells.
struct Measured {
  std::array<double, 3> states{};  // by Portion
  Shares shares{};
  double slower_than_claimed = 0.0;  // states that reach, with a bound above worst_time_s
  std::vector<double> reach_by_mode;
};

/// A share as it is claimed, by that many states, and as it was found.
struct Compared {
  double claimed;
  double found;
  double error = 0.0;  ///< the standard error of their difference
  bool apart = false;

  Compared(double claimed_, double there, double found_, double here)
      : claimed(claimed_), found(found_) {
    const double both = (claimed * there + found * here) / (there + here);
    error = std::sqrt(both * (1.0 - both) * (1.0 / here + 1.0 / there));
    // A share close to zero is only known to a few states, in either sample.
    apart = std::abs(claimed - found) > 5.0 * error + 5.0 / here + 5.0 / there;
  }
  std::string text(const std::string& name) const {
    return fmt::format("{} is claimed as {:.6f}, measured as {:.6f} +- {:.6f}", name, claimed,
                       found, error);
  }
};

struct State {
  std::size_t cell;
  double x, y;  // in cells, from its centre
  double heading_rad;
};

State drawn(std::mt19937_64& random, const std::vector<std::size_t>& cells) {
  const auto unit = [&random] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  State state{cells[random() % cells.size()], unit() - 0.5, unit() - 0.5, 0.0};
  state.heading_rad = std::numbers::pi * (2.0 * unit() - 1.0);
  return state;
}

/// Adds what is told of some of the sampled states.
void add(Measured& m, const ClaimedCells& of, double worst_time_s, const std::vector<State>& states,
         const TellState& tell) {
  std::vector<Told> found(states.size());
  tbb::parallel_for(std::size_t{0}, states.size(), [&](std::size_t i) {
    const auto [cell, x, y, heading_rad] = states[i];
    found[i] = tell(cell, x, y, heading_rad);
  });
  for (std::size_t i = 0; i < states.size(); ++i) {
    const std::size_t cell = states[i].cell;
    const Told& told = found[i];
    const bool holds = told.verdict == trapped && !of.holding.empty() && of.holding[cell] != 0;
    const std::size_t word = holds ? hold : static_cast<std::size_t>(told.verdict);
    m.slower_than_claimed += told.verdict == reach && told.worst_s > worst_time_s ? 1.0 : 0.0;
    m.reach_by_mode[told.mode] += told.verdict == reach ? 1.0 : 0.0;
    for (const Portion portion : {all_cells, of.region[cell] == 0 ? free_cells : buffer_cells}) {
      m.states[portion] += 1.0;
      m.shares[portion][word] += 1.0;
    }
  }
}

Measured measure(const ClaimedCells& of, std::size_t samples, double worst_time_s,
                 const TellState& tell) {
  std::vector<std::size_t> cells;
  for (std::size_t i = 0; i < of.loop.kind.size(); ++i) {
    if (of.loop.kind[i] == ordinary) cells.push_back(i);
  }
  Measured m;
  m.reach_by_mode.assign(of.modes, 0.0);
  std::mt19937_64 random(1);
  for (std::size_t left = cells.empty() ? 0 : samples; left > 0;) {
    std::vector<State> states(std::min(left, states_at_once));
    for (State& state : states) state = drawn(random, cells);
    add(m, of, worst_time_s, states, tell);
    left -= states.size();
  }
  for (std::size_t p = 0; p < m.shares.size(); ++p) {
    for (double& share : m.shares[p]) share /= std::max(1.0, m.states[p]);
  }
  for (double& share : m.reach_by_mode) share /= std::max(1.0, m.states[all_cells]);
  return m;
}

}  // namespace

std::string defect_of_claims(const nlohmann::json& record, const ClaimedCells& of,
                             std::size_t samples, bool may_prove_more, const TellState& tell,
                             nlohmann::ordered_json& report) {
  const Claims claims = claims_of(record, of.modes);
  const Measured m = measure(of, samples, claims.worst_time_s, tell);
  report["samples"] = m.states[all_cells];
  for (std::size_t v = 0; v < word_count; ++v) {
    if (v == hold && of.holding.empty()) continue;
    report["measured_fraction"][name_in(record, v)] = m.shares[all_cells][v];
  }
  for (std::size_t p = 0; p < m.shares.size(); ++p) {
    const double here = m.states[p];
    const double there = claims.samples * here / std::max(1.0, m.states[all_cells]);
    if (here < 100.0) continue;
    for (std::size_t v = 0; v < word_count; ++v) {
      const Compared share(claims.shares[p][v], there, m.shares[p][v], here);
      const bool is_modest = may_prove_more && (share.claimed < share.found) == (v != undecided);
      if (is_modest || !share.apart) continue;
      return fmt::format("{}: {}", portion_name[p], share.text(name_in(record, v)));
    }
  }
  const double drawn = m.states[all_cells];
  for (std::size_t k = 0; k < claims.reach_by_mode.size() && drawn >= 100.0; ++k) {
    const Compared share(claims.reach_by_mode[k], claims.samples, m.reach_by_mode[k], drawn);
    if (share.apart) return "reach_by_mode: " + share.text(fmt::format("mode {}", k));
  }
  // None of the states behind the claim was slower: that has a probability of exp(-20) if a share
  // of 20 / samples is. Allow as many of the states drawn here as such a share gives, and some
  // for chance.
  const double slow = 20.0 * m.states[all_cells] / std::max(1.0, claims.samples);
  const bool slower = m.slower_than_claimed > slow + 5.0 * std::sqrt(slow) + 5.0;
  return slower ? "worst_time_s: too many sampled states are slower" : "";
}

}  // namespace fairway_check
