#include "fairway/run/at_risk_search.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "fairway/base/parallel.hpp"
#include "fairway/base/random.hpp"
#include "fairway/behaviour/find_witness.hpp"
#include "fairway/verify/verdict.hpp"

namespace fairway {
namespace {

enum class Answer : std::uint8_t { not_asked, not_found, found };

auto key_of(const State& state) {
  return std::tuple(state.position_m.y, state.position_m.x, state.heading.rad());
}

/// The share that `part` of the `asked` stand for, which are (a sample of) the undecided ones.
double scaled(double undecided, std::size_t part, std::size_t asked, bool all_asked) {
  if (asked == 0 || !(undecided > 0.0)) return 0.0;
  const auto count = static_cast<double>(part);
  const auto of = static_cast<double>(asked);
  // All: counted, not scaled, to the last bit.
  return all_asked ? count / std::round(of / undecided) : undecided * (count / of);
}

}  // namespace

std::function<IsAtRisk()> UndecidedStates::gatherer() {
  return [this]() -> IsAtRisk {
    return [this](const State& state) {
      const std::lock_guard lock(adding_);
      states_.push_back(state);
      return false;
    };
  };
}

std::vector<State> UndecidedStates::in_random_order(std::uint64_t seed) {
  std::sort(states_.begin(), states_.end(),
            [](const State& a, const State& b) { return key_of(a) < key_of(b); });
  Random random(seed);
  for (std::size_t i = states_.size(); i > 1; --i) {
    std::swap(states_[i - 1], states_[random.below(i)]);
  }
  return states_;
}

FailureSearch::FailureSearch(const ContractCertificate& certificate)
    : certificate_(certificate),
      choices_(certificate.flow(), certificate.contract),
      guide_(choices_) {}

RiskCount FailureSearch::count(const std::vector<State>& states, std::uint64_t seed,
                               const std::function<bool()>& go_on) const {
  RiskCount count;
  std::vector<Answer> answers(states.size(), Answer::not_asked);
  for_ranges(states.size(), 16, [&](std::size_t begin, std::size_t end) {
    WitnessSearch search(choices_, guide_);
    for (std::size_t i = begin; i < end && go_on(); ++i) {
      answers[i] = search.find(states[i], {}, seed) ? Answer::found : Answer::not_found;
    }
  });
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (answers[i] == Answer::not_asked) continue;
    const Cell cell = certificate_.grid.cell_of(states[i].position_m);
    const bool is_free = certificate_.grid.contains(cell) &&
                         certificate_.region[certificate_.grid.index(cell)] == Region::free;
    const std::size_t found = answers[i] == Answer::found ? 1 : 0;
    ++count.asked;
    count.at_risk += found;
    count.asked_free += is_free ? 1 : 0;
    count.at_risk_free += is_free ? found : 0;
  }
  return count;
}

bool add_at_risk(ContractShares& shares, std::size_t states, const RiskCount& found) {
  constexpr std::size_t fewest = 200;
  if (found.asked < std::min(states, fewest)) return false;
  constexpr auto open = static_cast<std::size_t>(Verdict::undecided);
  const bool all = found.asked == states;
  shares.at_risk = scaled(shares.all[open], found.at_risk, found.asked, all);
  shares.at_risk_free = scaled(shares.free[open], found.at_risk_free, found.asked_free, all);
  return true;
}

}  // namespace fairway
