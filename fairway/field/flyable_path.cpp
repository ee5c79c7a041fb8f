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

/// The path's vertices, with points in between at most `step_m` apart. Of vertices nearer to one
/// another than half of that one stays: work that goes from neighbour to neighbour would not end.
std::vector<Vec2> points_on(const PathMission& path, double step_m) {
  std::vector<Vec2> points;
  const auto is_near = [&](Vec2 at) {
    return !points.empty() && norm(at - points.back()) < 0.5 * step_m;
  };
  for_pieces(path, [&](const PathPiece& piece) {
    const double parts = std::max(1.0, std::ceil(piece.length_m / step_m));
    for (double k = 0.0; k < parts; ++k) {
      const Vec2 at = piece.at(k / parts * piece.length_m);
      if (!is_near(at)) points.push_back(at);
    }
  });
  const Vec2 end = path.closed ? path.vertices_m.front() : path.vertices_m.back();
  while (points.size() > 1 && is_near(end)) points.pop_back();
  if (!path.closed) points.push_back(end);
  return points.size() < 2 ? path.vertices_m : points;
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

/// Moves `original` until it bends no more sharply than the radius, or no more can be done.
std::vector<Vec2> relaxed(const std::vector<Vec2>& original, bool closed, double radius_m) {
  std::vector<Vec2> p = original;
  const std::size_t n = p.size();
  if (n < 3) return p;
  const std::size_t first = closed ? 0 : 1;
  const std::size_t last = closed ? n : n - 1;
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
  return p;
}

/// How sharply points bend about one of them: the turn over its neighbours' neighbours, by length.
double bend_at(const std::vector<Vec2>& p, bool closed, std::size_t i) {
  constexpr std::size_t reach = 2;
  const std::size_t n = p.size();
  if (n <= 2 * reach || (!closed && (i < reach || i + reach >= n))) return 0.0;
  const Vec2 before = p[i] - p[(i + n - reach) % n];
  const Vec2 after = p[(i + reach) % n] - p[i];
  const double length_m = 0.5 * (norm(before) + norm(after));
  if (length_m == 0.0) return 0.0;
  return std::abs(std::atan2(cross(before, after), dot(before, after))) / length_m;
}

/// `softer` where its bends became gentler; `line` where room is short and they became sharper.
std::vector<Vec2> gentler(const std::vector<Vec2>& line, std::vector<Vec2> softer, bool closed,
                          double radius_m) {
  constexpr double gain = 0.95;
  const std::size_t n = line.size();
  const auto moved = [&](std::size_t i) { return norm(softer[i] - line[i]) > 1e-3 * radius_m; };
  std::vector<bool> is_moved(n);
  for (std::size_t i = 0; i < n; ++i) is_moved[i] = moved(i);
  const auto still = std::find(is_moved.begin(), is_moved.end(), false);
  if (still == is_moved.end()) return line;
  const auto start = static_cast<std::size_t>(still - is_moved.begin());
  const std::vector<Vec2> all_softer = softer;
  for (std::size_t k = start; k < start + n; ++k) {
    if (!is_moved[k % n] || is_moved[(k + n - 1) % n]) continue;
    double old_bend = 0.0;
    double new_bend = 0.0;
    std::size_t end = k;  // of the run of moved points that begins here
    for (; is_moved[end % n]; ++end) {
      old_bend = std::max(old_bend, bend_at(line, closed, end % n));
      new_bend = std::max(new_bend, bend_at(all_softer, closed, end % n));
    }
    if (new_bend < gain * old_bend) continue;
    for (std::size_t i = k; i < end; ++i) softer[i % n] = line[i % n];
  }
  return softer;
}

}  // namespace

PathMission flyable_path(const PathMission& path, double radius_m) {
  require(radius_m > 0.0, "flyable_path: a positive radius");
  PathMission out = path;
  out.vertices_m = relaxed(points_on(path, step_radii * radius_m), path.closed, radius_m);
  return out;
}

PathMission followed_line(const PathMission& path, double turn_radius_m) {
  constexpr double gentle_radii = 1.5;
  PathMission out = flyable_path(path, turn_radius_m);
  out.vertices_m =
      gentler(out.vertices_m, relaxed(out.vertices_m, path.closed, gentle_radii * turn_radius_m),
              path.closed, turn_radius_m);
  return out;
}

}  // namespace fairway
