// Shortest paths between two poses for a vehicle that cannot turn tighter than a radius (Dubins
// 1957): a turn, a straight line or a turn the other way, a turn. L turns left, R right, S goes
// straight; one of the six words is always the shortest.
//
// Properties that always hold, for finite poses no farther apart than 1e100 turning radii:
//   1. The length is the least of the six words'. Each angle is in [0, 2 pi): no extra loop.
//   2. The path ends at the goal: within 1e-12 (r + distance) in place, 1e-12 rad in heading
//      (observed: 7e-13 of each at most, nearly all of it where property 3 applies).
//   3. The length of a shortest path jumps by a loop where a turn shrinks to nothing and would
//      have to become negative: across the circles of least radius that touch the start. There
//      rounding must not decide. A word counts as feasible when it ends within `nearness` of
//      the goal: 1e-13 (r + distance). So its length is that of a shortest path to a pose that
//      near to the goal, which may be shorter by a loop than the one to the goal's own doubles.
//      Only LSL, RSR (a turn that vanishes) and LSR, RSL (circles that touch) need the allowance:
//      where a turn of another word vanishes, the path left over is one of these.
//   4. Of equally long words the first in the enumeration's order is taken.
//   5. Mirroring both poses swaps L and R; driving backwards reverses the word.
// Formulas: ours, from the centres of the circles (paper 3, Eq. 2). With D between the centres of a
// first and a last circle of one sense, LSL and RSR are |D| + (the turn between the headings): the
// only angle needed is the headings' difference. LSR and RSL need one arc tangent each, and only
// when |h1 - h0| + sqrt(D^2 - 4) does not rule them out already.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "fairway/vehicle/vehicle.hpp"

namespace fairway {

enum class DubinsWord : std::uint8_t { LSL, RSR, LSR, RSL, RLR, LRL };

inline constexpr std::array<DubinsWord, 6> dubins_words{DubinsWord::LSL, DubinsWord::RSR,
                                                        DubinsWord::LSR, DubinsWord::RSL,
                                                        DubinsWord::RLR, DubinsWord::LRL};

/// "LSL" and so on.
[[nodiscard]] const char* name_of(DubinsWord word);

/// +1 left, 0 straight, -1 right; `part` 0, 1, 2.
[[nodiscard]] constexpr int turn_of(DubinsWord word, int part) {
  constexpr std::array<std::array<std::int8_t, 3>, 6> turns{
      {{1, 0, 1}, {-1, 0, -1}, {1, 0, -1}, {-1, 0, 1}, {-1, 1, -1}, {1, -1, 1}}};
  return turns[static_cast<std::size_t>(word)][static_cast<std::size_t>(part)];
}

struct DubinsPath {
  State start;
  double turn_radius_m = 1.0;
  DubinsWord word = DubinsWord::LSL;
  std::array<double, 3> part_m{};  ///< lengths of the three parts, >= 0

  double length_m() const { return part_m[0] + part_m[1] + part_m[2]; }
};

/// One of the three parts of a path.
struct DubinsPart {
  double length_m = 0.0;         ///< >= 0
  int turn = 0;                  ///< +1 left, 0 straight, -1 right
  double curvature_per_m = 0.0;  ///< left positive
};

/// In the order they are driven.
[[nodiscard]] constexpr std::array<DubinsPart, 3> parts_of(const DubinsPath& path) {
  const auto part = [&](int i) {
    const int turn = turn_of(path.word, i);
    return DubinsPart{path.part_m[static_cast<std::size_t>(i)], turn, turn / path.turn_radius_m};
  };
  return {part(0), part(1), part(2)};
}

/// The farthest that poses may be apart, in turning radii.
inline constexpr double farthest_radii = 1e100;
/// The least radius that can be divided by.
inline constexpr double least_radius_m = 1e-300;

/// Whether every number is finite, the radius positive and the distance within `farthest_radii`.
[[nodiscard]] bool can_steer(const State& from, const State& to, double turn_radius_m);

/// can_steer(), and no coordinates farther apart than `most_radii` <= farthest_radii.
[[nodiscard]] bool is_within_radii(const State& from, const State& to, double turn_radius_m,
                                   double most_radii);

/// All below throw PreconditionViolation unless can_steer().
[[nodiscard]] double shortest_length_m(const State& from, const State& to, double turn_radius_m);
[[nodiscard]] DubinsPath shortest_path(const State& from, const State& to, double turn_radius_m);

/// The path of one word, or none when it does not exist for these circles.
[[nodiscard]] std::optional<DubinsPath> path_of_word(DubinsWord word, const State& from,
                                                     const State& to, double turn_radius_m);

/// Where the vehicle is after `length_m` of the path, 0 .. its length; beyond it stays at the end.
[[nodiscard]] State pose_at(const DubinsPath& path, double length_m);
[[nodiscard]] State end_of(const DubinsPath& path);

/// After `length_m` of driving with signed curvature `per_m`, left positive.
[[nodiscard]] State driven(const State& from, double length_m, double per_m);

/// Poses at most `step_m` > 0 apart, both ends and both joins among them.
[[nodiscard]] std::vector<State> sampled(const DubinsPath& path, double step_m);

/// Poses as arrays of one length: metres, metres, radians in (-pi, pi].
struct PoseArrays {
  std::span<const double> x_m;
  std::span<const double> y_m;
  std::span<const double> heading_rad;
};

/// shortest_length_m() for every pair, on all threads; `length_m` is as long as the others. The
/// same for any number of threads and any vector width; may differ from one pair at a time by
/// rounding, 4e-15 (r + distance). A pair that cannot be steered gives NaN.
void shortest_lengths_m(const PoseArrays& from, const PoseArrays& to, double turn_radius_m,
                        std::span<double> length_m);
void shortest_paths(std::span<const State> from, std::span<const State> to, double turn_radius_m,
                    std::span<DubinsPath> paths);

}  // namespace fairway
