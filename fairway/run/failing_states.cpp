#include "fairway/run/failing_states.hpp"

#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "fairway/base/heading.hpp"
#include "fairway/base/random.hpp"
#include "fairway/verify/ask_modes.hpp"
#include "fairway/verify/images.hpp"

namespace fairway {
namespace {

StartGround ground_of(const Certificate& certificate, std::size_t cell) {
  if (std::isnan(certificate.heading_rad[cell]) || certificate.flow().holds(cell))
    return StartGround::cut_off;
  return certificate.region[cell] == Region::buffer ? StartGround::buffer : StartGround::safe_start;
}

Place place_of(const State& state) {
  return {state.position_m.x, state.position_m.y, state.heading.rad()};
}

/// `count` states, uniform over the cells and all headings, of random streams from `first` on.
void append_sampled(const Grid& grid, const std::vector<std::size_t>& cells, std::uint64_t seed,
                    std::size_t first, std::size_t count, std::vector<Place>& states) {
  if (cells.empty()) return;
  for (std::size_t k = first; k < first + count; ++k) {
    Random random = Random::stream(seed, k);
    const Vec2 corner = grid.corner(grid.cell_at(cells[random.below(cells.size())]));
    states.push_back({corner.x + random.unit() * grid.cell_m,
                      corner.y + random.unit() * grid.cell_m, random.uniform(-pi, pi)});
  }
}

std::vector<Place> candidates(const Certificate& certificate, std::uint64_t seed,
                              std::span<const State> flown) {
  std::vector<std::size_t> ordinary;
  std::vector<std::size_t> commanded;
  for (std::size_t i = 0; i < certificate.kind.size(); ++i) {
    if (certificate.kind[i] != CellKind::ordinary) continue;
    ordinary.push_back(i);
    if (ground_of(certificate, i) == StartGround::safe_start) commanded.push_back(i);
  }
  constexpr std::size_t draws = 200'000;
  std::vector<Place> states;
  states.reserve(flown.size() + 2 * draws);
  for (const State& state : flown) states.push_back(place_of(state));
  append_sampled(certificate.grid, commanded, seed, draws, draws, states);
  append_sampled(certificate.grid, ordinary, seed, 0, draws, states);
  return states;
}

bool is_brought_by_a_further_mode(const Certificate& certificate, const Place& s) {
  return certificate.further_modes() > 0 &&
         ask_all_modes(certificate.view(), s.x_m, s.y_m, s.heading_rad).verdict == Verdict::reach;
}

}  // namespace

std::vector<FailingState> failing_states(const Certificate& certificate, std::size_t of_each,
                                         std::uint64_t seed, std::span<const State> flown) {
  const std::vector<Place> states = candidates(certificate, seed, flown);
  if (states.empty()) return {};
  const ImageStore images =
      state_images(certificate.flow(), states, usual_most_crossings, [] { return true; });
  std::array<std::array<std::vector<FailingState>, verdict_count>, start_grounds_in_order.size()>
      found;
  for (std::size_t k = 0; k < states.size(); ++k) {
    const Verdict proved = verdicts_of(images[k], certificate.sections.view()).only();
    const State start{{states[k].x_m, states[k].y_m}, Heading::from_rad(states[k].heading_rad)};
    const Cell at = certificate.grid.cell_of(start.position_m);
    const Verdict verdict = certificate.flow().told(proved, at);
    if (is_safe(verdict) || !certificate.grid.contains(at)) continue;
    const std::size_t cell = certificate.grid.index(at);
    if (certificate.kind[cell] != CellKind::ordinary) continue;
    if (is_brought_by_a_further_mode(certificate, states[k])) continue;
    const StartGround ground = ground_of(certificate, cell);
    auto& alike = found[static_cast<std::size_t>(ground)][static_cast<std::size_t>(verdict)];
    if (alike.size() < of_each) alike.push_back({start, verdict, ground, k < flown.size()});
  }
  std::vector<FailingState> failing;
  for (const auto& by_verdict : found) {
    for (const Verdict verdict : verdicts_in_order) {
      const auto& alike = by_verdict[static_cast<std::size_t>(verdict)];
      failing.insert(failing.end(), alike.begin(), alike.end());
    }
  }
  return failing;
}

std::vector<State> failing_starts(std::span<const State> starts,
                                  std::span<const FlightResult> results) {
  std::vector<State> failing;
  for (std::size_t i = 0; i < starts.size(); ++i) {
    if (results[i].outcome != Outcome::reach) failing.push_back(starts[i]);
  }
  return failing;
}

std::string failing_states_csv(const std::vector<FailingState>& states) {
  std::string text = "x_m,y_m,heading_rad,verdict,start\n";
  for (const FailingState& state : states) {
    const Vec2 p = state.start.position_m;
    text += fmt::format("{},{},{},{},{}\n", p.x, p.y, state.start.heading.rad(),
                        name_of(state.verdict), name_of(state.ground));
  }
  return text;
}

}  // namespace fairway
