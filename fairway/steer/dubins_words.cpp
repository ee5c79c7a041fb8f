#include "fairway/steer/dubins_words.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "fairway/base/error.hpp"
#include "fairway/base/parallel.hpp"
#include "fairway/steer/dubins_cases.hpp"

namespace fairway {

namespace dubins {

Parts lsl_parts(const Pair& p) {
  const Vec2 ll = p.ll();
  const double straight = std::sqrt(norm2(ll));
  if (straight <= p.near) return {p.left, 0.0, 0.0};  // one circle: any direction would do
  const double turn = left_turn(p.u0, ll);
  if (!is_passed(p, ll)) {
    const double last = p.left - turn + two_pi;
    return {turn, straight, last < 0.0 ? last + two_pi : last};
  }
  if (turn <= p.left) return {turn, straight, p.left - turn};
  // Passed by rounding alone: whichever turn has vanished.
  return turn - p.left < two_pi - turn ? Parts{p.left, straight, 0.0}
                                       : Parts{0.0, straight, p.left};
}

Parts lsr_parts(const Pair& p) {
  const Vec2 lr = p.lr();
  const double square = crossing_square(p, lr);
  if (!(square >= 0.0)) return {};
  const double straight = std::sqrt(square);
  const double turn = lsr_turn(p, lr, straight);
  return {turn, straight, lsr_last(p, turn)};
}

namespace {

/// Near |ll| = 4 the three centres are nearly in line and the length of LRL grows as the root of
/// what is missing: the rounding of `ll` would cost half the digits. So it is worked out again from
/// the poses, in long double.
ThreeCircles in_more_digits(const Pair& p) {
  using Real = long double;
  const Real r = p.turn_radius_m;
  const Real x = (static_cast<Real>(p.to_m.x) - p.from_m.x) / r -
                 (std::sin(static_cast<Real>(p.h1)) - std::sin(static_cast<Real>(p.h0)));
  const Real y = (static_cast<Real>(p.to_m.y) - p.from_m.y) / r +
                 (std::cos(static_cast<Real>(p.h1)) - std::cos(static_cast<Real>(p.h0)));
  const Real length = std::sqrt(x * x + y * y);
  const Real missing = 16.0L - (x * x + y * y);
  return {{static_cast<double>(x), static_cast<double>(y)},
          static_cast<double>(length),
          static_cast<double>(length / 4.0L),
          static_cast<double>(missing < 0.0L ? -1.0L : std::sqrt(missing) / 4.0L)};
}

ThreeCircles three_circles(const Pair& p) {
  const Vec2 ll = p.ll();
  const double length = std::sqrt(norm2(ll));
  return is_nearly_straight(length) ? in_more_digits(p) : three_circles_of(ll, length);
}

}  // namespace

double lrl_length(const Pair& p) {
  const ThreeCircles of = three_circles(p);
  if (!(of.cosine >= 0.0) || of.length == 0.0) return std::numeric_limits<double>::infinity();
  return lrl_length(p, of);
}

Parts lrl_parts(const Pair& p) {
  const ThreeCircles of = three_circles(p);
  if (!(of.cosine >= 0.0) || of.length == 0.0) return {};
  const MiddleCircle m = middle_circle(p, of);
  const double turn = left_turn(p.u0, m.touch);
  if (!m.is_both) {
    const double last = m.both - turn + two_pi;
    return {turn, m.middle, last < two_pi ? last : last - two_pi};
  }
  if (turn <= m.both) return {turn, m.middle, m.both - turn};
  return turn - m.both < two_pi - turn ? Parts{m.both, m.middle, 0.0}
                                       : Parts{0.0, m.middle, m.both};
}

namespace {

Pair pair_between(const State& from, const State& to, double turn_radius_m) {
  return pair_of(from.position_m.x, from.position_m.y, from.heading.rad(), to.position_m.x,
                 to.position_m.y, to.heading.rad(), turn_radius_m);
}

Parts parts_of(DubinsWord word, const Pair& pair) {
  switch (word) {
    case DubinsWord::LSL:
      return lsl_parts(pair);
    case DubinsWord::RSR:
      return lsl_parts(mirrored(pair));
    case DubinsWord::LSR:
      return lsr_parts(pair);
    case DubinsWord::RSL:
      return lsr_parts(mirrored(pair));
    case DubinsWord::RLR:
      return lrl_parts(mirrored(pair));
    case DubinsWord::LRL:
      return lrl_parts(pair);
  }
  return {};
}

struct Best {
  double length;
  DubinsWord word;
};

void improve(Best& best, double length, DubinsWord word) {
  if (length < best.length) best = {length, word};
}

/// Takes LSR (or its mirror image) when it is shorter. Its turns differ by the headings'
/// difference, so they come to that at least.
void try_crossing(Best& best, const Pair& pair, Vec2 between, DubinsWord word) {
  const double square = crossing_square(pair, between);
  if (!(square >= 0.0)) return;
  const double straight = std::sqrt(square);
  if (straight + std::min(pair.left, pair.right) >= best.length) return;
  const double turn = lsr_turn(pair, between, straight);
  improve(best, straight + turn + lsr_last(pair, turn), word);
}

Best shortest(const Pair& pair) {
  const Pair mirror = mirrored(pair);
  Best best{lsl_length(pair), DubinsWord::LSL};
  improve(best, lsl_length(mirror), DubinsWord::RSR);
  try_crossing(best, pair, pair.lr(), DubinsWord::LSR);
  try_crossing(best, mirror, mirror.lr(), DubinsWord::RSL);
  if (best.length <= pi) return best;  // shorter than the middle arc of RLR and LRL alone
  if (lrl_bound(std::sqrt(norm2(mirror.ll()))) < best.length) {
    improve(best, lrl_length(mirror), DubinsWord::RLR);
  }
  if (lrl_bound(std::sqrt(norm2(pair.ll()))) < best.length) {
    improve(best, lrl_length(pair), DubinsWord::LRL);
  }
  return best;
}

DubinsPath path_of(const State& from, double turn_radius_m, DubinsWord word, const Parts& parts) {
  return {from,
          turn_radius_m,
          word,
          {parts.first * turn_radius_m, parts.middle * turn_radius_m, parts.last * turn_radius_m}};
}

}  // namespace
}  // namespace dubins

const char* name_of(DubinsWord word) {
  constexpr std::array<const char*, 6> names{"LSL", "RSR", "LSR", "RSL", "RLR", "LRL"};
  return names[static_cast<std::size_t>(word)];
}

bool can_steer(const State& from, const State& to, double turn_radius_m) {
  // Not a number and infinity fail every comparison they should.
  const double farthest_m = farthest_radii * turn_radius_m;
  return turn_radius_m > 0.0 && std::isfinite(turn_radius_m) &&
         std::isfinite(1.0 / turn_radius_m) && std::isfinite(from.heading.rad()) &&
         std::isfinite(to.heading.rad()) &&
         std::abs(to.position_m.x - from.position_m.x) <= farthest_m &&
         std::abs(to.position_m.y - from.position_m.y) <= farthest_m;
}

double shortest_length_m(const State& from, const State& to, double turn_radius_m) {
  require(can_steer(from, to, turn_radius_m), "poses are finite, the turning radius is positive");
  return turn_radius_m * dubins::shortest(dubins::pair_between(from, to, turn_radius_m)).length;
}

DubinsPath shortest_path(const State& from, const State& to, double turn_radius_m) {
  require(can_steer(from, to, turn_radius_m), "poses are finite, the turning radius is positive");
  const dubins::Pair pair = dubins::pair_between(from, to, turn_radius_m);
  const DubinsWord word = dubins::shortest(pair).word;
  return dubins::path_of(from, turn_radius_m, word, dubins::parts_of(word, pair));
}

std::optional<DubinsPath> path_of_word(DubinsWord word, const State& from, const State& to,
                                       double turn_radius_m) {
  require(can_steer(from, to, turn_radius_m), "poses are finite, the turning radius is positive");
  const auto parts = dubins::parts_of(word, dubins::pair_between(from, to, turn_radius_m));
  if (!std::isfinite(parts.first)) return std::nullopt;
  return dubins::path_of(from, turn_radius_m, word, parts);
}

State driven(const State& from, double length_m, double per_m) {
  const double turn = length_m * per_m;
  if (turn == 0.0)
    return {from.position_m + length_m * fast_unit(from.heading.rad()), from.heading};
  // The chord, along the middle heading: no difference of nearly equal vectors.
  const Heading middle = Heading::from_rad(from.heading.rad() + 0.5 * turn);
  const double half = 0.5 * turn;
  const double chord_m = length_m * (std::sin(half) / half);
  return {from.position_m + chord_m * fast_unit(middle.rad()),
          Heading::from_rad(from.heading.rad() + turn)};
}

State pose_at(const DubinsPath& path, double length_m) {
  State at = path.start;
  double left_m = std::max(0.0, length_m);
  for (int i = 0; i < 3; ++i) {
    const double part_m = std::min(left_m, path.part_m[static_cast<std::size_t>(i)]);
    if (part_m > 0.0) at = driven(at, part_m, turn_of(path.word, i) / path.turn_radius_m);
    left_m -= part_m;
  }
  return at;
}

int turn_at(const DubinsPath& path, double length_m) {
  for (int i = 0; i < 2; ++i) {
    const double part_m = path.part_m[static_cast<std::size_t>(i)];
    if (length_m < part_m) return turn_of(path.word, i);
    length_m -= part_m;
  }
  return turn_of(path.word, 2);
}

State end_of(const DubinsPath& path) {
  State at = path.start;
  for (int i = 0; i < 3; ++i) {
    const double part_m = path.part_m[static_cast<std::size_t>(i)];
    if (part_m > 0.0) at = driven(at, part_m, turn_of(path.word, i) / path.turn_radius_m);
  }
  return at;
}

std::vector<State> sampled(const DubinsPath& path, double step_m) {
  require(step_m > 0.0, "the step is positive");
  std::vector<State> poses{path.start};
  for (int i = 0; i < 3; ++i) {
    const double part_m = path.part_m[static_cast<std::size_t>(i)];
    if (!(part_m > 0.0)) continue;
    const auto pieces = static_cast<int>(std::ceil(part_m / step_m));
    const State begin = poses.back();
    for (int k = 1; k <= pieces; ++k) {
      const double at_m = k == pieces ? part_m : part_m * k / pieces;
      poses.push_back(driven(begin, at_m, turn_of(path.word, i) / path.turn_radius_m));
    }
  }
  return poses;
}

void shortest_paths(std::span<const State> from, std::span<const State> to, double turn_radius_m,
                    std::span<DubinsPath> paths) {
  require(from.size() == to.size() && from.size() == paths.size(), "the arrays are equally long");
  for_ranges(paths.size(), 1024, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      paths[i] = shortest_path(from[i], to[i], turn_radius_m);
    }
  });
}

}  // namespace fairway
