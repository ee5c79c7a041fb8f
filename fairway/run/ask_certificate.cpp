#include "fairway/run/ask_certificate.hpp"

#include <cstddef>

#include "fairway/base/parallel.hpp"
#include "fairway/vehicle/modes.hpp"
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

namespace {

/// What is known beside the cells' middles.
VerdictLayer layer_at(const Certificate& certificate, Heading heading) {
  const std::vector<runtime::Answer> answers =
      ask(certificate, states_asked_at(certificate.grid, heading));
  VerdictLayer layer{heading, {}, {}};
  layer.verdict.reserve(answers.size());
  layer.mode.reserve(answers.size());
  for (const runtime::Answer& answer : answers) {
    const bool reaches = answer.verdict == Verdict::reach;
    layer.verdict.push_back(answer.verdict);
    layer.mode.push_back(reaches ? static_cast<std::uint8_t>(answer.mode) : no_mode);
  }
  return layer;
}

}  // namespace

std::vector<Verdict> verdicts_at(const Certificate& certificate, Heading heading) {
  return layer_at(certificate, heading).verdict;
}

std::vector<std::uint8_t> modes_at(const Certificate& certificate, Heading heading) {
  return layer_at(certificate, heading).mode;
}

std::vector<VerdictLayer> verdict_layers(const Certificate& certificate,
                                         std::span<const Heading> headings) {
  std::vector<VerdictLayer> layers;
  for (const Heading heading : headings) {
    layers.push_back(layer_at(certificate, heading));
    if (certificate.further_modes() == 0) layers.back().mode.clear();
  }
  return layers;
}

}  // namespace fairway
