#include "fairway/report/contours.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <utility>

#include "fairway/base/error.hpp"

namespace fairway {
namespace {

// An edge of the lattice has one number: 2 * sample for the edge to the right of a sample, and one
// more for the edge above it.
using Edge = std::int64_t;

class Squares {
 public:
  Squares(int nx, int ny, std::span<const float> value, double level)
      : nx_(nx), ny_(ny), value_(value), level_(level) {}

  /// Each crossed edge with the one or two edges that the line goes on to.
  std::map<Edge, std::array<Edge, 2>> links() const {
    std::map<Edge, std::array<Edge, 2>> links;
    for (int iy = 0; iy + 1 < ny_; ++iy)
      for (int ix = 0; ix + 1 < nx_; ++ix)
        for (const auto& [a, b] : pieces(ix, iy)) {
          if (a == none) continue;
          join(links, a, b);
          join(links, b, a);
        }
    return links;
  }

  Vec2 crossing(Edge edge) const {
    const auto sample = static_cast<std::size_t>(edge / 2);
    const double x = static_cast<double>(sample % static_cast<std::size_t>(nx_));
    const double y = static_cast<double>(sample / static_cast<std::size_t>(nx_));
    const bool upwards = edge % 2 == 1;
    const double here = value_[sample];
    const double there = value_[sample + (upwards ? static_cast<std::size_t>(nx_) : 1U)];
    const double t = (level_ - here) / (there - here);
    return upwards ? Vec2{x, y + t} : Vec2{x + t, y};
  }

  static constexpr Edge none = -1;

 private:
  static void join(std::map<Edge, std::array<Edge, 2>>& links, Edge from, Edge to) {
    auto& ends = links.try_emplace(from, std::array<Edge, 2>{none, none}).first->second;
    (ends[0] == none ? ends[0] : ends[1]) = to;
  }

  /// The line's pieces in the square whose lower left sample is (ix, iy): none, one or two.
  std::array<std::pair<Edge, Edge>, 2> pieces(int ix, int iy) const {
    const Edge s = static_cast<Edge>(iy) * nx_ + ix;
    const auto at = [&](Edge sample) {
      return static_cast<double>(value_[static_cast<std::size_t>(sample)]);
    };
    const std::array<double, 4> v{at(s), at(s + 1), at(s + 1 + nx_), at(s + nx_)};
    std::array<std::pair<Edge, Edge>, 2> found{{{none, none}, {none, none}}};
    int mask = 0;
    for (int k = 0; k < 4; ++k) {
      if (!std::isfinite(v[static_cast<std::size_t>(k)])) return found;
      mask |= v[static_cast<std::size_t>(k)] >= level_ ? 1 << k : 0;
    }
    if (mask == 0 || mask == 15) return found;
    const std::array<Edge, 4> side{2 * s, 2 * (s + 1) + 1, 2 * (s + nx_), 2 * s + 1};
    if (mask == 5 || mask == 10) {  // a saddle: the middle decides which corners belong together
      const bool middle_above = 0.25 * (v[0] + v[1] + v[2] + v[3]) >= level_;
      const bool cut_off_first = (mask == 5) != middle_above;  // corners 0 and 2 stand alone
      found[0] = {side[0], cut_off_first ? side[3] : side[1]};
      found[1] = {side[2], cut_off_first ? side[1] : side[3]};
      return found;
    }
    Edge* end = &found[0].first;
    for (int k = 0; k < 4; ++k) {
      const bool crossed = ((mask >> k) & 1) != ((mask >> ((k + 1) % 4)) & 1);
      if (!crossed) continue;
      *end = side[static_cast<std::size_t>(k)];
      end = &found[0].second;
    }
    return found;
  }

  int nx_;
  int ny_;
  std::span<const float> value_;
  double level_;
};

}  // namespace

std::vector<std::vector<Vec2>> contour_lines(int nx, int ny, std::span<const float> value,
                                             double level) {
  require(nx >= 0 && ny >= 0 &&
              value.size() == static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny),
          "a lattice has nx * ny samples");
  const Squares squares(nx, ny, value, level);
  const auto links = squares.links();
  std::vector<std::vector<Vec2>> lines;
  std::set<Edge> drawn;
  const auto follow = [&](Edge first) {
    std::vector<Vec2> line;
    Edge previous = Squares::none;
    Edge edge = first;
    while (edge != Squares::none && drawn.insert(edge).second) {
      line.push_back(squares.crossing(edge));
      const auto& ends = links.at(edge);
      const Edge next = ends[0] == previous ? ends[1] : ends[0];
      if (next == first) line.push_back(line.front());
      previous = edge;
      edge = next;
    }
    lines.push_back(std::move(line));
  };
  for (const auto& [edge, ends] : links)  // lines that end at the rim, from one of their ends
    if (ends[1] == Squares::none && !drawn.contains(edge)) follow(edge);
  for (const auto& [edge, ends] : links)
    if (!drawn.contains(edge)) follow(edge);
  return lines;
}

}  // namespace fairway
