#include "fairway/compare/state_verdicts.hpp"

#include <cstddef>
#include <cstdint>
#include <utility>

#include "fairway/base/parallel.hpp"
#include "fairway/run/ask_certificate.hpp"
#include "fairway/run/ask_contract.hpp"
#include "fairway/run/flight_engine.hpp"

namespace fairway {
namespace {

Verdict seen_in(const FlightResult& result, After after) {
  if (result.outcome != Outcome::reach) return static_cast<Verdict>(result.outcome);
  return after == After::collide ? Verdict::collide
         : after == After::leave ? Verdict::leave
                                 : Verdict::reach;
}

/// Who is trapped in a holding place holds.
std::vector<Verdict> told(std::vector<Verdict> verdicts, const Plan& plan,
                          std::span<const State> states) {
  const std::vector<std::uint8_t> holding = holding_cells(plan);
  for (std::size_t i = 0; !holding.empty() && i < states.size(); ++i) {
    const Cell c = plan.grid.cell_of(states[i].position_m);
    if (verdicts[i] == Verdict::trapped && plan.grid.contains(c) &&
        holding[plan.grid.index(c)] != 0) {
      verdicts[i] = Verdict::hold;
    }
  }
  return verdicts;
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
  const bool follows = is_loop_to_follow(plan);
  std::vector<Verdict> verdicts;
  verdicts.reserve(states.size());
  for (const MeasuredFlight& flight : flown.flights) {
    verdicts.push_back(
        seen_in(flight.result, follows ? flight.measures.onward.after : After::none));
  }
  return told(std::move(verdicts), plan, states);
}

std::vector<Verdict> seen_from(std::span<const State> states, const Plan& plan) {
  const bool follows = is_loop_to_follow(plan);
  const FlightEngine engine(plan);
  std::vector<Verdict> verdicts(states.size());
  for_ranges(states.size(), 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (follows) {
        const Flight flight = engine.record(states[i], i, one_lap);
        verdicts[i] = seen_in(flight.result, flight.onward.after);
      } else {
        verdicts[i] = seen_in(engine.fly(states[i], i), After::none);
      }
    }
  });
  return told(std::move(verdicts), plan, states);
}

}  // namespace fairway
