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

Parts lsl_parts(const Pair<double>& p) {
  const Plane<double> ll = p.ll();
  const double straight = std::sqrt(norm2(ll));
  if (straight <= p.near) return {p.left, 0.0, 0.0};  // one circle: any direction fits
  const double turn = left_turn(p.u0, ll);
  if (!is_passed(p, ll)) {
    const double last = p.left - turn + two_pi;
    return {turn, straight, last < 0.0 ? last + two_pi : last};
  }
  if (turn <= p.left) return {turn, straight, p.left - turn};
  // Passed only because of rounding: whichever turn has vanished.
  return turn - p.left < two_pi - turn ? Parts{p.left, straight, 0.0}
                                       : Parts{0.0, straight, p.left};
}

Parts lsr_parts(const Pair<double>& p) {
  const Plane<double> lr = p.lr();
  const double square = crossing_square(p, lr);
  if (!(square >= 0.0)) return {};
  const double straight = std::sqrt(square);
  const double turn = lsr_turn(p, lr, straight);
  return {turn, straight, lsr_last(p, turn)};
}

namespace {

/// Near |ll| = 4 the three centres are nearly in line and the length of LRL grows as the root of
/// the difference: the rounding of `ll` would cost half the digits. So it is computed again from
/// the poses, in long double.
ThreeCircles<double> in_more_digits(const Poses& p) {
  using Real = long double;
  const Real r = p.turn_radius_m;
  const Real x = (static_cast<Real>(p.x1_m) - p.x0_m) / r -
                 (std::sin(static_cast<Real>(p.h1_rad)) - std::sin(static_cast<Real>(p.h0_rad)));
  const Real y = (static_cast<Real>(p.y1_m) - p.y0_m) / r +
                 (std::cos(static_cast<Real>(p.h1_rad)) - std::cos(static_cast<Real>(p.h0_rad)));
  const Real length = std::sqrt(x * x + y * y);
  const Real missing = 16.0L - (x * x + y * y);
  return {{static_cast<double>(x), static_cast<double>(y)},
          static_cast<double>(length),
          static_cast<double>(length / 4.0L),
          static_cast<double>(missing < 0.0L ? -1.0L : std::sqrt(missing) / 4.0L)};
}

/// The cosine is below 0 when there is no LRL.
ThreeCircles<double> three_circles(const Poses& poses, const Pair<double>& p) {
  const Plane<double> ll = p.ll();
  const double length = std::sqrt(norm2(ll));
  if (is_nearly_straight(length)) return in_more_digits(poses);
  if (!(length < 4.0) || length == 0.0) return {ll, length, 0.0, -1.0};
  return three_circles_of(ll, length);
}

}  // namespace

double lrl_length(const Poses& poses, const Pair<double>& p) {
  const ThreeCircles<double> of = three_circles(poses, p);
  return of.cosine >= 0.0 ? lrl_length(p, of) : std::numeric_limits<double>::infinity();
}

Parts lrl_parts(const Poses& poses, const Pair<double>& p) {
  const ThreeCircles<double> of = three_circles(poses, p);
  if (!(of.cosine >= 0.0)) return {};
  const MiddleCircle<double> m = middle_circle(p, of);
  const double turn = left_turn(p.u0, m.touch);
  if (!is_both(p, m)) {
    const double last = m.both - turn + two_pi;
    return {turn, m.middle, last < two_pi ? last : last - two_pi};
  }
  if (turn <= m.both) return {turn, m.middle, m.both - turn};
  return turn - m.both < two_pi - turn ? Parts{m.both, m.middle, 0.0}
                                       : Parts{0.0, m.middle, m.both};
}

namespace {

Poses poses_of(const State& from, const State& to, double turn_radius_m) {
  return {from.position_m.x, from.position_m.y, from.heading.rad(), to.position_m.x,
          to.position_m.y,   to.heading.rad(),  turn_radius_m};
}

/// Both headings at once.
Pair<double> quick_pair_of(const Poses& p) {
  const Plane<Two> u = fast_angle::unit(Two{p.h0_rad, p.h1_rad});
  return pair_of(p, {u.x[0], u.y[0]}, {u.x[1], u.y[1]});
}

Parts parts_of(DubinsWord word, const Poses& poses, const Pair<double>& pair) {
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
      return lrl_parts(mirrored(poses), mirrored(pair));
    case DubinsWord::LRL:
      return lrl_parts(poses, pair);
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

/// Takes LSR or RSL when it is shorter. Their turns differ by the headings' difference, so their
/// sum is at least that.
void try_crossing(Best& best, const Pair<double>& pair, const Pair<Two>& both) {
  constexpr double none = std::numeric_limits<double>::infinity();
  const Plane<Two> lr = both.lr();
  const Two square = crossing_square(both, lr);
  // x - x: zero, for numbers and vectors alike. NOLINTNEXTLINE(misc-redundant-expression)
  const Two straight = root(square < 0.0 ? square - square : square);
  const Two least = straight + std::min(pair.left, pair.right);
  const bool lsr = (square[0] >= 0.0) & (least[0] < best.length);
  const bool rsl = (square[1] >= 0.0) & (least[1] < best.length);
  if (!(lsr | rsl)) return;
  const Two turn = lsr_turn(both, lr, straight);
  const Two length = straight + turn + lsr_last(both, turn);
  improve(best, lsr ? length[0] : none, DubinsWord::LSR);
  improve(best, rsl ? length[1] : none, DubinsWord::RSL);
}

void try_three_turns(Best& best, const Poses& poses, const Pair<double>& pair,
                     const Pair<Two>& both) {
  constexpr double none = std::numeric_limits<double>::infinity();
  const Plane<Two> ll = both.ll();
  const Two length = root(norm2(ll));
  const bool lrl = lrl_bound(length[0]) < best.length;
  const bool rlr = lrl_bound(length[1]) < best.length;
  if (!(lrl | rlr)) return;
  if (is_nearly_straight(length[0]) || is_nearly_straight(length[1])) [[unlikely]] {
    improve(best, lrl_length(mirrored(poses), mirrored(pair)), DubinsWord::RLR);
    improve(best, lrl_length(poses, pair), DubinsWord::LRL);
    return;
  }
  const auto possible = (length < 4.0) & (length > 0.0);
  const Two of = lrl_length(both, three_circles_of(ll, possible ? length : length * 0.0 + 1.0));
  improve(best, rlr && possible[1] ? of[1] : none, DubinsWord::RLR);
  improve(best, lrl && possible[0] ? of[0] : none, DubinsWord::LRL);
}

Best shortest(const Poses& poses, const Pair<double>& pair) {
  const Pair<Two> both = both_ways(pair);
  const Two same = lsl_length(both);
  Best best{same[0], DubinsWord::LSL};
  improve(best, same[1], DubinsWord::RSR);
  try_crossing(best, pair, both);
  // Shorter than the middle arc of RLR and LRL alone?
  if (best.length > pi) try_three_turns(best, poses, pair, both);
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

bool is_within_radii(const State& from, const State& to, double turn_radius_m, double most_radii) {
  // NaN and infinity fail every comparison, as they should.
  const double farthest_m = most_radii * turn_radius_m;
  return turn_radius_m > 0.0 && std::isfinite(turn_radius_m) && turn_radius_m >= least_radius_m &&
         std::isfinite(from.heading.rad()) && std::isfinite(to.heading.rad()) &&
         std::abs(to.position_m.x - from.position_m.x) <= farthest_m &&
         std::abs(to.position_m.y - from.position_m.y) <= farthest_m;
}

bool can_steer(const State& from, const State& to, double turn_radius_m) {
  return is_within_radii(from, to, turn_radius_m, farthest_radii);
}

double shortest_length_m(const State& from, const State& to, double turn_radius_m) {
  require(can_steer(from, to, turn_radius_m), "poses are finite, the turning radius is positive");
  const dubins::Poses poses = dubins::poses_of(from, to, turn_radius_m);
  return turn_radius_m * dubins::shortest(poses, dubins::quick_pair_of(poses)).length;
}

DubinsPath shortest_path(const State& from, const State& to, double turn_radius_m) {
  require(can_steer(from, to, turn_radius_m), "poses are finite, the turning radius is positive");
  const dubins::Poses poses = dubins::poses_of(from, to, turn_radius_m);
  const dubins::Pair<double> pair = dubins::quick_pair_of(poses);
  const DubinsWord word = dubins::shortest(poses, pair).word;
  return dubins::path_of(from, turn_radius_m, word, dubins::parts_of(word, poses, pair));
}

std::optional<DubinsPath> path_of_word(DubinsWord word, const State& from, const State& to,
                                       double turn_radius_m) {
  require(can_steer(from, to, turn_radius_m), "poses are finite, the turning radius is positive");
  const dubins::Poses poses = dubins::poses_of(from, to, turn_radius_m);
  const auto parts = dubins::parts_of(word, poses, dubins::quick_pair_of(poses));
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
  for (const DubinsPart& part : parts_of(path)) {
    const double part_m = std::min(left_m, part.length_m);
    if (part_m > 0.0) at = driven(at, part_m, part.curvature_per_m);
    left_m -= part_m;
  }
  return at;
}

State end_of(const DubinsPath& path) {
  State at = path.start;
  for (const DubinsPart& part : parts_of(path)) {
    if (part.length_m > 0.0) at = driven(at, part.length_m, part.curvature_per_m);
  }
  return at;
}

std::vector<State> sampled(const DubinsPath& path, double step_m) {
  require(step_m > 0.0, "the step is positive");
  std::vector<State> poses{path.start};
  for (const DubinsPart& part : parts_of(path)) {
    if (!(part.length_m > 0.0)) continue;
    const auto pieces = static_cast<int>(std::ceil(part.length_m / step_m));
    const State begin = poses.back();
    for (int k = 1; k <= pieces; ++k) {
      const double at_m = k == pieces ? part.length_m : part.length_m * k / pieces;
      poses.push_back(driven(begin, at_m, part.curvature_per_m));
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
