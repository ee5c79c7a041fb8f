#include "fairway/run/ask_certificate.hpp"

#include <cstddef>

#include "fairway/base/parallel.hpp"
#include "fairway/verify/verdict_map.hpp"

namespace fairway {

std::vector<runtime::Answer> ask(const Certificate& certificate, std::span<const State> states) {
  runtime::Certificate view;
  view.look_into(certificate.view());
  std::vector<runtime::Answer> answers(states.size());
  for_ranges(states.size(), 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const State& s = states[i];
      answers[i] = view.query(s.position_m.x, s.position_m.y, s.heading.rad());
    }
  });
  return answers;
}

std::vector<State> states_asked_at(const Grid& grid, Heading heading) {
  constexpr double aside_rad = 0.0005;  // verdict_map.hpp, property 2
  const Heading asked = Heading::from_rad(heading.rad() + aside_rad);
  VerdictMap places;
  places.grid = grid;
  places.nx = grid.nx;
  places.ny = grid.ny;
  std::vector<State> states(grid.size());
  for (std::size_t i = 0; i < states.size(); ++i) states[i] = {places.place_m(i), asked};
  return states;
}

std::vector<Verdict> verdicts_at(const Certificate& certificate, Heading heading) {
  const std::vector<runtime::Answer> answers =
      ask(certificate, states_asked_at(certificate.grid, heading));
  std::vector<Verdict> verdicts(answers.size());
  for (std::size_t i = 0; i < verdicts.size(); ++i) verdicts[i] = answers[i].verdict;
  return verdicts;
}

std::vector<VerdictLayer> verdict_layers(const Certificate& certificate,
                                         std::span<const Heading> headings) {
  std::vector<VerdictLayer> layers;
  for (const Heading heading : headings) {
    layers.push_back({heading, verdicts_at(certificate, heading)});
  }
  return layers;
}

}  // namespace fairway
