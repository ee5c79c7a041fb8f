// Shortest Dubins lengths against OMPL's, and a step of either steering law. One thread; CPU time,
// which other processes do not lengthen much.
#include <fmt/core.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench/ompl.hpp"
#include "bench/sections.hpp"
#include "fairway/base/random.hpp"
#include "fairway/steer/clf_law.hpp"
#include "fairway/steer/dubins_words.hpp"
#include "fairway/steer/shortest_law.hpp"

namespace fairway::bench {
namespace {

struct Pairs {
  std::vector<State> from;
  std::vector<State> to;
  std::array<std::vector<double>, 6> columns;
};

Pairs random_pairs(double size, std::size_t count) {
  Random random(6);
  Pairs pairs;
  const auto pose = [&] {
    const Vec2 p{random.uniform(0.0, size), random.uniform(0.0, size)};
    return State{p, Heading::from_rad(random.uniform(-pi, pi))};
  };
  const auto keep = [&](const State& s, std::vector<State>& states, std::size_t column) {
    states.push_back(s);
    pairs.columns[column].push_back(s.position_m.x);
    pairs.columns[column + 1].push_back(s.position_m.y);
    pairs.columns[column + 2].push_back(s.heading.rad());
  };
  for (std::size_t i = 0; i < count; ++i) {
    keep(pose(), pairs.from, 0);
    keep(pose(), pairs.to, 3);
  }
  return pairs;
}

double worst_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double worst = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) worst = std::max(worst, std::abs(a[i] - b[i]));
  return worst;
}

/// Nanoseconds of CPU for each of `count`, the median of alternating runs; the first warms up.
std::vector<double> nanoseconds(const Settings& settings, std::size_t count,
                                const std::vector<std::function<void()>>& works) {
  constexpr int again = 10;
  std::vector<std::vector<double>> runs(works.size());
  for (int repeat = 0; repeat <= settings.repeats; ++repeat) {
    for (std::size_t k = 0; k < works.size(); ++k) {
      const Took took = timed([&] {
        for (int i = 0; i < again; ++i) works[k]();
      });
      if (repeat > 0) runs[k].push_back(took.cpu_s * 1e9 / again / static_cast<double>(count));
    }
  }
  std::vector<double> medians;
  for (std::vector<double>& run : runs) medians.push_back(median(run));
  return medians;
}

std::vector<Row> length_rows(const Settings& settings, double size, std::size_t count) {
  const Pairs pairs = random_pairs(size, count);
  const auto& c = pairs.columns;
  std::vector<double> one(count);
  std::vector<double> batch(count);
  std::vector<double> peer(count);
  const Ompl ompl(pairs.from, pairs.to, 1.0);
  const auto ns =
      nanoseconds(settings, count,
                  {[&] {
                     for (std::size_t i = 0; i < count; ++i) {
                       one[i] = shortest_length_m(pairs.from[i], pairs.to[i], 1.0);
                     }
                   },
                   [&] {
                     shortest_lengths_m({c[0], c[1], c[2]}, {c[3], c[4], c[5]}, 1.0, batch);
                   },
                   [&] { ompl.distances(peer); }});
  if (worst_difference(one, batch) > 1e-12) throw std::runtime_error("steer: the batch differs");
  // OMPL treats angles within 1e-6 of a full turn as zero, and uses float functions.
  if (Ompl::is_there() && worst_difference(one, peer) > 1e-5) {
    throw std::runtime_error("steer: OMPL's lengths differ");
  }
  const std::string in_box = fmt::format("poses in a box of {:g} r", size);
  const std::string shown_one = fmt::format("{:.1f} ns", ns[0]);
  const std::string shown_batch = fmt::format("{:.1f} ns", ns[1]);
  const std::string single_name = "shortest Dubins length, " + in_box;
  const std::string batch_name = "  many at once, one core";
  if (!Ompl::is_there()) {
    const char* why = "OMPL was not there at build time";
    return {without_peer(single_name, shown_one, why, "<= 1/4"),
            without_peer(batch_name, shown_batch, why, "<= 1/8")};
  }
  const std::string shown_peer = fmt::format("OMPL {:.1f} ns", ns[2]);
  return {ratio_row(single_name, shown_one, shown_peer, ns[0] / ns[2], 0.25, "<= 1/4"),
          ratio_row(batch_name, shown_batch, shown_peer, ns[1] / ns[2], 0.125, "<= 1/8")};
}

/// Steps of many flights in turn, each with its own law.
template <typename Law>
double step_ns(const Settings& settings, std::size_t count, const Law& law) {
  const Pairs pairs = random_pairs(10.0, count);
  std::vector<State> states = pairs.from;
  std::vector<Law> laws(count, law);
  std::vector<double> curvature(count);
  constexpr int steps = 50;
  std::vector<double> runs;
  for (int repeat = 0; repeat <= settings.repeats; ++repeat) {
    states = pairs.from;
    laws.assign(count, law);
    double cpu_s = 0.0;
    for (int k = 0; k < steps; ++k) {
      cpu_s += timed([&] {
                 for (std::size_t i = 0; i < count; ++i) {
                   curvature[i] = laws[i].curvature_per_m(states[i], pairs.to[i], 1.0, 0.02);
                 }
               }).cpu_s;
      for (std::size_t i = 0; i < count; ++i) states[i] = driven(states[i], 0.02, curvature[i]);
    }
    if (repeat > 0) runs.push_back(cpu_s * 1e9 / steps / static_cast<double>(count));
  }
  return median(runs);
}

}  // namespace

std::vector<Row> steer_rows(const Settings& settings) {
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const auto count = static_cast<std::size_t>(settings.flights) * 10;
  std::vector<Row> rows;
  for (const double size : {1.0, 4.0, 40.0}) {
    for (Row& row : length_rows(settings, size, count)) rows.push_back(std::move(row));
  }
  const double clf_ns = step_ns(settings, count, ClfLaw());
  const double shortest_ns = step_ns(settings, count, ShortestLaw({{0.02, 0.02}, 0.02}));
  rows.push_back(at_most_row("a step of the shortest law", fmt::format("{:.0f} ns", shortest_ns),
                             shortest_ns, 200.0));
  rows.push_back(
      at_most_row("a step of paper 3's law", fmt::format("{:.0f} ns", clf_ns), clf_ns, 200.0));
  return rows;
}

}  // namespace fairway::bench
