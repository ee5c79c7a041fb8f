#include "fairway/behaviour/find_witness.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "fairway/base/random.hpp"
#include "fairway/behaviour/behaviour_pilot.hpp"
#include "fairway/behaviour/proved_ends.hpp"

namespace fairway {
namespace {

constexpr int no_parent = -1;

struct Node {
  BehaviourState state;
  BehaviourStep step;  ///< that led here
  int parent = no_parent;
};

/// Which bins of places, headings and held sides were seen: finer than those of the guide. A hash
/// of a bin may hide another one, at small loss.
class SeenBins {
 public:
  explicit SeenBins(double per_m) : per_m_(per_m), slots_(std::size_t{1} << 16) {}

  void clear() {
    if (++round_ == 0) {  // marks of old rounds would count again
      std::fill(slots_.begin(), slots_.end(), 0);
      round_ = 1;
    }
  }

  /// False when it was seen already.
  bool add(const BehaviourState& s) {
    const auto number = [](double v) {
      return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(v)));
    };
    std::uint64_t key = number(s.place.x * per_m_) * 0x9e3779b97f4a7c15ULL ^
                        number(s.place.y * per_m_) * 0xc2b2ae3d27d4eb4fULL ^
                        (number((s.heading_rad + pi) * (256.0 / two_pi)) * 3 +
                         static_cast<std::uint64_t>(s.held + 1)) *
                            0x165667b19e3779f9ULL;
    key ^= key >> 29;
    key *= 0xbf58476d1ce4e5b9ULL;
    key ^= key >> 32;
    std::uint64_t& slot = slots_[key % slots_.size()];
    const std::uint64_t mark = (key & ~0xffffULL) | round_;
    if (slot == mark) return false;
    slot = mark;
    return true;
  }

 private:
  double per_m_;
  std::uint16_t round_ = 0;
  std::vector<std::uint64_t> slots_;
};

}  // namespace

struct WitnessSearch::Work {
  const BehaviourChoices& choices;
  const FailureGuide& guide;
  SeenBins seen;
  std::vector<Node> nodes;
  std::array<std::vector<int>, 256> waiting;  ///< by level, the latest first
  BehaviourChoiceList list;
  BehaviourPilot pilot;

  bool accepts(const BehaviourFlight& flight) const {
    return is_witness(choices.flow(), choices.commands(), choices.contract(), flight);
  }

  void clear() {
    nodes.clear();
    seen.clear();
    for (auto& level : waiting) level.clear();
  }

  void add(const BehaviourState& state, const BehaviourStep& step, int parent) {
    if (!seen.add(state)) return;
    waiting[guide.level(state.place, state.heading_rad)].push_back(static_cast<int>(nodes.size()));
    nodes.push_back({state, step, parent});
  }

  BehaviourFlight flight_to(const State& start, int node, const BehaviourStep& last) const {
    BehaviourFlight flight{start, {last}};
    for (int at = node; nodes[static_cast<std::size_t>(at)].parent != no_parent;
         at = nodes[static_cast<std::size_t>(at)].parent) {
      flight.steps.push_back(nodes[static_cast<std::size_t>(at)].step);
    }
    std::reverse(flight.steps.begin(), flight.steps.end());
    return flight;
  }

  /// Tries all steps from a state; whether one fails.
  std::optional<BehaviourFlight> expand(const State& start, int node, Random& random) {
    const BehaviourState from = nodes[static_cast<std::size_t>(node)].state;
    choices.list(from, list);
    const int count = list.size();
    const auto first = static_cast<int>(random.below(static_cast<std::uint64_t>(count)));
    for (int k = 0; k < count; ++k) {
      const BehaviourChoice& choice = list[(first + k) % count];
      if (!choice.proved) continue;
      const CellKind met = choices.met(from.place, choice.end.place);
      if (met == CellKind::target) continue;
      if (met == CellKind::ordinary) {
        add(choice.end, choice.step, node);
        continue;
      }
      BehaviourFlight flight = flight_to(start, node, choice.step);
      if (accepts(flight)) return flight;
    }
    return {};
  }

  std::optional<BehaviourFlight> best_first(const State& start, const WitnessEffort& effort,
                                            Random& random) {
    clear();
    add(BehaviourState::of(start), {}, no_parent);
    int beyond = 0;
    for (int tried = 0; tried < effort.most_states; ++tried) {
      std::size_t level = 0;
      while (level < waiting.size() && waiting[level].empty()) ++level;
      if (level == waiting.size()) break;
      if (level == FailureGuide::never && ++beyond > effort.most_beyond) break;
      const int node = waiting[level].back();
      waiting[level].pop_back();
      if (auto flight = expand(start, node, random)) return flight;
    }
    return {};
  }

  std::optional<BehaviourFlight> by_adversaries(const State& start, int flights, Random& random) {
    static constexpr std::array turns{Adversary::greedy, Adversary::circling, Adversary::random,
                                      Adversary::greedy, Adversary::guided};
    // Far ones rarely fail that the search did not find.
    const double most_m = 25.0 * choices.contract().turn_radius_m.most;
    for (int k = 0; k < flights; ++k) {
      BehaviourFlight flight{start, {}};
      const Adversary adversary = turns[static_cast<std::size_t>(k) % turns.size()];
      const auto run = pilot.fly(start, adversary, random.bits(), most_m, &flight.steps);
      const bool failed = run.outcome == Outcome::collide || run.outcome == Outcome::leave;
      if (failed && accepts(flight)) return flight;
    }
    return {};
  }
};

WitnessSearch::WitnessSearch(const BehaviourChoices& choices, const FailureGuide& guide)
    : work_(new Work{choices,
                     guide,
                     SeenBins(2.0 * guide.bins_per_m()),
                     {},
                     {},
                     {},
                     BehaviourPilot(choices, &guide)}) {}
WitnessSearch::~WitnessSearch() = default;

std::optional<BehaviourFlight> WitnessSearch::find(const State& start, const WitnessEffort& effort,
                                                   std::uint64_t seed) {
  Work& work = *work_;
  const BehaviourFlight still{start, {}};
  if (work.accepts(still)) return still;
  const Flow& flow = work.choices.flow();
  if (flow.kind_at(flow.grid.cell_of(start.position_m)) != CellKind::ordinary) return {};
  Random random(seed);
  for (int k = 0; k < effort.searches; ++k) {
    if (auto flight = work.best_first(start, effort, random)) return flight;
  }
  const bool may_fail =
      work.guide.level(start.position_m, start.heading.rad()) != FailureGuide::never;
  return work.by_adversaries(start, may_fail ? effort.flights : effort.flights / 8, random);
}

}  // namespace fairway
