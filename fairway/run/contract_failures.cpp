#include "fairway/run/contract_failures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "fairway/base/random.hpp"
#include "fairway/behaviour/proved_ends.hpp"
#include "fairway/simulate/exact_flight.hpp"
#include "fairway/vehicle/filled_commands.hpp"

namespace fairway {
namespace {

/// In the order of lists: how a state fails.
enum class Kind : std::uint8_t { collide, leave, trapped, risk_collide, risk_leave, undecided };
constexpr std::size_t kinds = 6;
constexpr std::array<const char*, kinds> kind_names{
    "proved to collide",    "proved to leave the map",    "proved to be trapped",
    "at risk: may collide", "at risk: may leave the map", "undecided"};

StartGround ground_of(const ContractCertificate& c, std::size_t cell) {
  if (std::isnan(c.heading_rad[cell])) return StartGround::cut_off;
  return c.region[cell] == Region::buffer ? StartGround::buffer : StartGround::safe_start;
}

void append_sampled(const Grid& grid, const std::vector<std::size_t>& cells, std::uint64_t seed,
                    std::size_t first, std::vector<State>& states) {
  constexpr std::size_t draws = 4000;
  if (cells.empty()) return;
  for (std::size_t k = first; k < first + draws; ++k) {
    Random random = Random::stream(seed, k);
    const Vec2 corner = grid.corner(grid.cell_at(cells[random.below(cells.size())]));
    const Vec2 at{corner.x + random.unit() * grid.cell_m, corner.y + random.unit() * grid.cell_m};
    states.push_back({at, Heading::from_rad(random.uniform(-pi, pi))});
  }
}

std::vector<State> candidates(const ContractCertificate& c, std::uint64_t seed) {
  std::vector<std::size_t> ordinary;
  std::vector<std::size_t> safe;
  for (std::size_t i = 0; i < c.kind.size(); ++i) {
    if (c.kind[i] != CellKind::ordinary) continue;
    ordinary.push_back(i);
    if (ground_of(c, i) == StartGround::safe_start) safe.push_back(i);
  }
  constexpr std::size_t other_streams = std::size_t{1} << 32U;
  std::vector<State> states;
  append_sampled(c.grid, safe, seed, other_streams, states);
  append_sampled(c.grid, ordinary, seed, 0, states);
  return states;
}

/// "reach" last, which is none.
std::size_t rank_of(const ContractFailure& failure) {
  switch (failure.reply.verdict) {
    case Verdict::collide:
      return 0;
    case Verdict::leave:
      return 1;
    case Verdict::trapped:
      return 2;
    case Verdict::undecided:
    case Verdict::reach:
    case Verdict::follow:
    case Verdict::hold:
      break;
  }
  return failure.reply.witness ? 3 : 4;
}

double length_of(const Flight& flight) {
  double length_m = 0.0;
  for (const FlightSegment& piece : flight.segments) length_m += piece.length_m;
  return length_m;
}

/// Flights from one ground, each of the longest of its kind.
class Shown {
 public:
  /// `exact`: under `commands`, those of all cells.
  Shown(const ContractCertificate& certificate, const std::vector<float>& commands,
        const ExactFlights& exact)
      : c_(certificate), commands_(commands), exact_(exact) {}

  void look(const ContractFailure& failure) {
    if (failure.reply.verdict == Verdict::undecided && !failure.reply.witness) return;
    Flight flight = failure.reply.witness ? witness_flight(*failure.reply.witness)
                                          : exact_.record(failure.start);
    const std::size_t kind =
        failure.reply.witness
            ? static_cast<std::size_t>(
                  flight.result.outcome == Outcome::collide ? Kind::risk_collide : Kind::risk_leave)
            : rank_of(failure);
    if (has_[kind] && length_of(flight) <= length_of(longest_[kind])) return;
    has_[kind] = true;
    longest_[kind] = std::move(flight);
  }
  /// Of kinds that `all` does not have yet.
  void add_to(NamedFlights& all) {
    for (std::size_t k = 0; k < kinds; ++k) {
      const bool shown =
          std::find(all.names.begin(), all.names.end(), kind_names[k]) != all.names.end();
      if (!has_[k] || shown) continue;
      all.flights.push_back(std::move(longest_[k]));
      all.names.emplace_back(kind_names[k]);
    }
  }

 private:
  Flight witness_flight(const BehaviourFlight& witness) const {
    Flight flight;
    flight.start = witness.start;
    flight.segments = segments_of(witness, c_.vehicle.speed_mps);
    const ProvedEnds ends = proved_ends(c_.flow(), commands_, c_.contract, witness);
    flight.result = {ends.may_be(Verdict::collide) ? Outcome::collide : Outcome::leave,
                     ends.length_m / c_.vehicle.speed_mps, ends.length_m};
    return flight;
  }

  const ContractCertificate& c_;
  const std::vector<float>& commands_;
  const ExactFlights& exact_;
  std::array<bool, kinds> has_{};
  std::array<Flight, kinds> longest_;
};

}  // namespace

std::vector<ContractFailure> contract_failures(const ContractCertificate& certificate,
                                               std::size_t of_each, std::uint64_t seed) {
  const std::vector<State> states = candidates(certificate, seed);
  std::vector<ContractReply> replies = ask(certificate, states);
  std::vector<ContractFailure> failures;
  for (std::size_t i = 0; i < states.size(); ++i) {
    const Cell cell = certificate.grid.cell_of(states[i].position_m);
    if (is_safe(replies[i].verdict) || !certificate.grid.contains(cell)) continue;
    const std::size_t at = certificate.grid.index(cell);
    if (certificate.kind[at] != CellKind::ordinary) continue;
    failures.push_back({states[i], std::move(replies[i]), ground_of(certificate, at)});
  }
  const auto key = [](const ContractFailure& f) { return std::pair(f.ground, rank_of(f)); };
  std::stable_sort(failures.begin(), failures.end(),
                   [&](const auto& a, const auto& b) { return key(a) < key(b); });
  std::vector<ContractFailure> kept;
  std::size_t alike = 0;
  for (ContractFailure& failure : failures) {
    alike = !kept.empty() && key(kept.back()) == key(failure) ? alike + 1 : 1;
    if (alike <= of_each) kept.push_back(std::move(failure));
  }
  return kept;
}

std::string contract_failures_csv(const std::vector<ContractFailure>& failures) {
  std::string text = "x_m,y_m,heading_rad,verdict,start\n";
  for (const ContractFailure& f : failures) {
    const Vec2 p = f.start.position_m;
    text += fmt::format("{},{},{},{},{}\n", p.x, p.y, f.start.heading.rad(), f.reply.word(),
                        name_of(f.ground));
  }
  return text;
}

NamedFlights failing_flights(const ContractCertificate& certificate, Plan plan,
                             const std::vector<ContractFailure>& failures) {
  // Under a contract a cell without a command has that of the nearest.
  plan.heading_rad = filled_commands(plan.grid, plan.heading_rad.data());
  const ExactFlights exact(plan);
  NamedFlights shown;
  for (const StartGround ground : start_grounds_in_order) {
    Shown of_ground(certificate, plan.heading_rad, exact);
    for (const ContractFailure& failure : failures) {
      if (failure.ground == ground) of_ground.look(failure);
    }
    of_ground.add_to(shown);
  }
  return shown;
}

}  // namespace fairway
