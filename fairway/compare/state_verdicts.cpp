#include "fairway/compare/state_verdicts.hpp"

#include "fairway/base/parallel.hpp"
#include "fairway/run/ask_certificate.hpp"
#include "fairway/run/ask_contract.hpp"

namespace fairway {
namespace {

Verdict seen_in(const MeasuredFlight& flight) {
  if (flight.succeeds) return Verdict::reach;
  if (flight.result.outcome != Outcome::reach) return static_cast<Verdict>(flight.result.outcome);
  return flight.measures.onward.after == After::leave ? Verdict::leave : Verdict::collide;
}

}  // namespace

std::vector<Verdict> verdicts_of(const Certificate& certificate, std::span<const State> states) {
  std::vector<Verdict> verdicts;
  verdicts.reserve(states.size());
  for (const runtime::Answer& answer : ask(certificate, states)) verdicts.push_back(answer.verdict);
  return verdicts;
}

std::vector<Verdict> verdicts_of(const ContractCertificate& certificate,
                                 std::span<const State> states) {
  const ContractQueries queries(certificate);
  std::vector<Verdict> verdicts(states.size());
  for_ranges(states.size(), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const ContractReply reply = queries.proved(states[i]);
      verdicts[i] = reply.follows ? Verdict::follow : reply.verdict;
    }
  });
  return verdicts;
}

std::vector<Verdict> seen_in(const MeasuredFlights& flown, const Plan& plan,
                             std::span<const State> states) {
  const std::vector<std::uint8_t> holding = holding_cells(plan);
  std::vector<Verdict> verdicts;
  verdicts.reserve(states.size());
  for (std::size_t i = 0; i < states.size(); ++i) {
    Verdict verdict = seen_in(flown.flights[i]);
    const Cell c = plan.grid.cell_of(states[i].position_m);
    if (verdict == Verdict::trapped && !holding.empty() && plan.grid.contains(c) &&
        holding[plan.grid.index(c)] != 0) {
      verdict = Verdict::hold;
    }
    verdicts.push_back(verdict);
  }
  return verdicts;
}

}  // namespace fairway
