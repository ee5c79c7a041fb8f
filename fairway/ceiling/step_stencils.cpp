#include "fairway/ceiling/step_stencils.hpp"

#include <algorithm>
#include <cmath>

#include "fairway/base/heading.hpp"
#include "fairway/base/vec2.hpp"

namespace fairway {
namespace {

// Far above all rounding of a few hundred sums of numbers of the size of 1.
constexpr double slack = 1e-9;
constexpr int directions = 48;
constexpr int pieces = 400;
constexpr double looked_at = 3.3;  // nodes about the middle of a step's ends

using Polygon = std::vector<Vec2>;

Vec2 turned(Vec2 v, double rad) {
  const double c = std::cos(rad);
  const double s = std::sin(rad);
  return {v.x * c - v.y * s, v.x * s + v.y * c};
}

/// The corners of the polygon that lies within `support[i]` along each of the directions.
Polygon corners(const std::vector<double>& support) {
  Polygon found;
  const std::size_t n = support.size();
  for (std::size_t i = 0; i < n; ++i) {
    const double a = two_pi * static_cast<double>(i) / static_cast<double>(n);
    const double b = two_pi * static_cast<double>(i + 1) / static_cast<double>(n);
    const double p = support[i];
    const double q = support[(i + 1) % n];
    const double area = std::sin(b - a);
    found.push_back(
        {(p * std::sin(b) - q * std::sin(a)) / area, (q * std::cos(a) - p * std::cos(b)) / area});
  }
  return found;
}

double greatest_cosine(double lo, double hi) {
  if (two_pi * std::ceil(lo / two_pi) <= hi) return 1.0;
  return std::max(std::cos(lo), std::cos(hi));
}

/// Holds where a step ends that begins in bin 0 at the origin and ends `turned_bins` bins on. Its
/// heading t after the begin lies between the least and greatest that both ends allow, so that
/// along a direction it gains at most the integral of the greatest cosine.
Polygon ends_of_every_control(const BallLattice& l, int turned_bins) {
  std::vector<double> support(directions);
  const double first = turned_bins * l.bin_rad;
  const double last = (turned_bins + 1) * l.bin_rad;
  const double piece = l.step / pieces;
  for (int i = 0; i < directions; ++i) {
    const double along = two_pi * i / directions;
    double gained = 0.0;
    for (int q = 0; q < pieces; ++q) {
      // Headings change by less than a piece's length within half a piece of its middle.
      const double t = (q + 0.5) * piece;
      const double hi = std::min(l.bin_rad + t, last + l.step - t) + 0.5 * piece;
      const double lo = std::max(-t, first - (l.step - t)) - 0.5 * piece;
      gained += greatest_cosine(lo - along, hi - along) * piece;
    }
    support[static_cast<std::size_t>(i)] = gained + slack;
  }
  return corners(support);
}

/// Holds where the constant turn to `turned_bins` bins on ends: an arc of the bin's width about
/// the origin, between its ends and where their tangents meet.
Polygon ends_of_constant_turn(const BallLattice& l, int turned_bins) {
  const double turn = turned_bins * l.bin_rad;
  Vec2 end{l.step, 0.0};
  if (turned_bins != 0) {
    const double radius = l.step / turn;
    end = {radius * std::sin(turn), radius * (1.0 - std::cos(turn))};
  }
  const double half = 0.5 * l.bin_rad;
  return {end, turned(end, 2.0 * half), turned((1.0 / std::cos(half)) * end, half)};
}

/// The nodes worth asking: for every direction in which a claim may end near the step's ends, the
/// one that loses least.
std::vector<StepEnd> stencil(const BallLattice& l, Polygon ends, double heading_rad) {
  Vec2 middle;
  for (Vec2& end : ends) {
    end = turned(end, heading_rad);
    middle = middle + (1.0 / static_cast<double>(ends.size())) * end;
  }
  std::vector<StepEnd> near;
  const int columns = static_cast<int>(std::lround(middle.x / l.spacing));
  const int rows = static_cast<int>(std::lround(middle.y / l.spacing));
  for (int j = rows - 4; j <= rows + 4; ++j) {
    for (int i = columns - 4; i <= columns + 4; ++i) {
      const Vec2 node{i * l.spacing, j * l.spacing};
      if (norm(middle - node) > looked_at * l.spacing) continue;
      double cost = 0.0;
      for (const Vec2 end : ends) cost = std::max(cost, norm(end - node));
      near.push_back(
          {i, j, static_cast<Radius>(std::ceil((cost + slack) * units_per_turn_radius))});
    }
  }
  std::vector<bool> used(near.size());
  for (int g = 0; g < 64; ++g) {
    const Vec2 unit = turned({1.0, 0.0}, two_pi * g / 64);
    std::size_t best = 0;
    double least = 1e9;
    for (std::size_t q = 0; q < near.size(); ++q) {
      const Vec2 node{near[q].columns * l.spacing, near[q].rows * l.spacing};
      double needed = -1e9;
      for (const Vec2 end : ends) needed = std::max(needed, dot(unit, end - node));
      const double lost = 1.02 * near[q].cost - needed * units_per_turn_radius;
      if (lost < least) {
        least = lost;
        best = q;
      }
    }
    used[best] = true;
  }
  std::vector<StepEnd> kept;
  for (std::size_t q = 0; q < near.size(); ++q) {
    if (used[q]) kept.push_back(near[q]);
  }
  return kept;
}

template <typename EndsOf>
StepStencils stencils(const BallLattice& l, const EndsOf& ends_of) {
  StepStencils all;
  all.ends.resize(static_cast<std::size_t>(l.headings));
  all.reach.resize(static_cast<std::size_t>(l.headings));
  for (int d = -l.turn_bins; d <= l.turn_bins; ++d) {
    const Polygon ends = ends_of(l, d);
    for (int k = 0; k < l.headings; ++k) {
      auto kept = stencil(l, ends, k * l.bin_rad);
      auto& reach = all.reach[static_cast<std::size_t>(k)];
      for (const StepEnd& end : kept) {
        reach.left = std::min(reach.left, end.columns);
        reach.right = std::max(reach.right, end.columns);
        reach.down = std::min(reach.down, end.rows);
        reach.up = std::max(reach.up, end.rows);
      }
      all.ends[static_cast<std::size_t>(k)].push_back(std::move(kept));
    }
  }
  return all;
}

}  // namespace

StepStencils steps_of_every_control(const BallLattice& lattice) {
  return stencils(lattice, ends_of_every_control);
}
StepStencils steps_of_constant_turns(const BallLattice& lattice) {
  return stencils(lattice, ends_of_constant_turn);
}

}  // namespace fairway
