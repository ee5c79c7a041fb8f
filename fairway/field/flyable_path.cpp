#include "fairway/field/flyable_path.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "fairway/base/error.hpp"
#include "fairway/base/heading.hpp"
#include "fairway/vehicle/path_geometry.hpp"

namespace fairway {
namespace {

constexpr double step_radii = 0.125;
constexpr double still_radii = 1e-4;  // movements below this end the work
constexpr int most_sweeps = 400;

/// The path's vertices without repetitions, with points in between at most `step_m` apart.
std::vector<Vec2> points_on(const PathMission& path, double step_m) {
  std::vector<Vec2> points;
  for_pieces(path, [&](const PathPiece& piece) {
    const double parts = std::max(1.0, std::ceil(piece.length_m / step_m));
    for (double k = 0.0; k < parts; ++k) points.push_back(piece.at(k / parts * piece.length_m));
  });
  if (!path.closed) points.push_back(path.vertices_m.back());
  return points;
}

/// Where the middle one of three points lies when the bend through it has radius `radius_m`: on
/// the arc over the other two. Itself when the bend is no sharper.
Vec2 on_arc(Vec2 a, Vec2 b, Vec2 c, double radius_m) {
  const Vec2 chord = c - a;
  const double half_m = 0.5 * norm(chord);
  if (half_m == 0.0 || half_m >= radius_m) return b;
  const double turn = cross(b - a, c - b);
  const double turned = std::atan2(turn, dot(b - a, c - b));
  if (std::abs(std::sin(turned)) <= half_m / radius_m && std::abs(turned) <= pi / 2) return b;
  const double rise_m = radius_m - std::sqrt(radius_m * radius_m - half_m * half_m);
  const Vec2 outward = (turn > 0.0 ? -0.5 : 0.5) / half_m * left_of(chord);
  return a + 0.5 * chord + rise_m * outward;
}

}  // namespace

PathMission flyable_path(const PathMission& path, double radius_m) {
  require(radius_m > 0.0, "flyable_path: a positive radius");
  const std::vector<Vec2> original = points_on(path, step_radii * radius_m);
  PathMission out = path;
  std::vector<Vec2>& p = out.vertices_m;
  p = original;
  const std::size_t n = p.size();
  if (n < 3) return out;
  const std::size_t first = path.closed ? 0 : 1;
  const std::size_t last = path.closed ? n : n - 1;
  double moved_m = radius_m;
  for (int sweep = 0; sweep < most_sweeps && moved_m > still_radii * radius_m; ++sweep) {
    moved_m = 0.0;
    for (std::size_t k = first; k < last; ++k) {
      const std::size_t i = sweep % 2 == 0 ? k : last - 1 - (k - first);
      const Vec2 to = on_arc(p[(i + n - 1) % n], p[i], p[(i + 1) % n], radius_m);
      if (norm(to - original[i]) > radius_m) continue;
      moved_m = std::max(moved_m, norm(to - p[i]));
      p[i] = to;
    }
  }
  return out;
}

}  // namespace fairway
