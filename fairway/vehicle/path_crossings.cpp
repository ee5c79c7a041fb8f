#include <algorithm>
#include <cmath>
#include <optional>

#include "fairway/vehicle/path_geometry.hpp"
#include "fairway/vehicle/path_troubles.hpp"

namespace fairway {
namespace {

struct Piece {
  Vec2 from;
  Vec2 to;
  std::size_t number;
  double left() const { return std::min(from.x, to.x); }
  double right() const { return std::max(from.x, to.x); }
};

std::vector<Piece> pieces_of(const PathMission& path) {
  std::vector<Piece> pieces;
  const std::vector<Vec2>& v = path.vertices_m;
  require(v.size() >= 2, "a path has at least two vertices");
  const std::size_t count = path.closed ? v.size() : v.size() - 1;
  for (std::size_t k = 0; k < count; ++k) {
    const Vec2 to = v[(k + 1) % v.size()];
    if (to != v[k]) pieces.push_back({v[k], to, k});
  }
  return pieces;
}

/// The first point of `a` that lies on `b`.
std::optional<Vec2> shared_point(const Piece& a, const Piece& b) {
  const Vec2 u = a.to - a.from;
  const Vec2 w = b.to - b.from;
  const Vec2 d = b.from - a.from;
  const double across = cross(u, w);
  const double sizes = norm(u) * norm(w);
  if (std::abs(across) > 1e-12 * sizes) {
    const double s = cross(d, w) / across;
    const double t = cross(d, u) / across;
    if (s < 0.0 || s > 1.0 || t < 0.0 || t > 1.0) return std::nullopt;
    return a.from + s * u;
  }
  if (std::abs(cross(d, u)) > 1e-12 * norm(u) * (norm(d) + norm(u))) return std::nullopt;
  const double begin = dot(d, u) / norm2(u);
  const double end = dot(d + w, u) / norm2(u);
  const double low = std::max(0.0, std::min(begin, end));
  if (low > std::min(1.0, std::max(begin, end))) return std::nullopt;
  return a.from + low * u;
}

/// Of two pieces that follow each other: whether the second runs back over the first.
bool runs_back(const Piece& before, const Piece& after) {
  const Vec2 u = before.to - before.from;
  const Vec2 w = after.to - after.from;
  return std::abs(cross(u, w)) <= 1e-12 * norm(u) * norm(w) && dot(u, w) < 0.0;
}

}  // namespace

std::vector<PathCrossing> path_crossings(const PathMission& path) {
  const std::vector<Piece> pieces = pieces_of(path);
  std::vector<std::size_t> by_left(pieces.size());
  for (std::size_t k = 0; k < pieces.size(); ++k) by_left[k] = k;
  std::sort(by_left.begin(), by_left.end(), [&](std::size_t a, std::size_t b) {
    return pieces[a].left() != pieces[b].left() ? pieces[a].left() < pieces[b].left() : a < b;
  });
  std::vector<PathCrossing> found;
  const auto look_at = [&](std::size_t a, std::size_t b) {
    if (a > b) std::swap(a, b);
    const bool joined = path.closed && a == 0 && b + 1 == pieces.size();
    const Piece& first = pieces[a];
    const Piece& second = pieces[b];
    if (b == a + 1 || joined) {
      const bool back = joined && b != a + 1 ? runs_back(second, first) : runs_back(first, second);
      if (back) found.push_back({first.number, second.number, joined ? first.from : first.to});
      return;
    }
    if (const auto point = shared_point(first, second)) {
      found.push_back({first.number, second.number, *point});
    }
  };
  for (std::size_t i = 0; i < by_left.size(); ++i) {
    for (std::size_t j = i + 1; j < by_left.size(); ++j) {
      if (pieces[by_left[j]].left() > pieces[by_left[i]].right()) break;
      look_at(by_left[i], by_left[j]);
    }
  }
  std::sort(found.begin(), found.end(), [](const PathCrossing& a, const PathCrossing& b) {
    return a.first_piece != b.first_piece ? a.first_piece < b.first_piece
                                          : a.second_piece < b.second_piece;
  });
  return found;
}

}  // namespace fairway
