#include "fairway/vehicle/path_troubles.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "fairway/base/error.hpp"
#include "fairway/base/heading.hpp"
#include "fairway/base/number_text.hpp"

namespace fairway {
namespace {

using Kind = PathTrouble::Kind;

constexpr double flat_radii = 0.02;  // vertices nearer to a line than this are left out
// What that leaves of a smooth curve may lack this much: legs of a circle of radius r that bulge by
// flat_radii turn by sqrt(8 flat_radii), and a leg of no length between two of them lacks half.
constexpr double slack_radii = 0.2;
constexpr double degrees = 180.0 / pi;

/// A kept vertex. At the ends of an open path nothing turns.
struct Corner {
  std::size_t vertex;
  Vec2 at;
  double turn_rad = 0.0;
  double needs_m = 0.0;  ///< of each leg, to round it
  double leg_m = 0.0;    ///< to the next
};

double distance_to_piece(Vec2 p, Vec2 a, Vec2 b) {
  const Vec2 u = b - a;
  const double square = norm2(u);
  if (square == 0.0) return norm(p - a);
  return norm(p - a - std::clamp(dot(p - a, u) / square, 0.0, 1.0) * u);
}

/// Marks what Douglas and Peucker keep of points begin .. end (1973).
void keep_between(const std::vector<Vec2>& points, std::size_t begin, std::size_t end,
                  double flat_m, std::vector<bool>& kept) {
  std::vector<std::pair<std::size_t, std::size_t>> open{{begin, end}};
  while (!open.empty()) {
    const auto [first, last] = open.back();
    open.pop_back();
    double farthest_m = flat_m;
    std::size_t split = first;
    for (std::size_t k = first + 1; k < last; ++k) {
      const double d = distance_to_piece(points[k], points[first], points[last]);
      if (d > farthest_m) {
        farthest_m = d;
        split = k;
      }
    }
    if (split == first) continue;
    kept[split] = true;
    open.emplace_back(first, split);
    open.emplace_back(split, last);
  }
}

/// Of a closed path the first again at the end.
std::vector<Corner> kept_vertices(const PathMission& path, double flat_m) {
  std::vector<Vec2> points = path.vertices_m;
  if (path.closed) points.push_back(points.front());
  std::vector<bool> kept(points.size(), false);
  kept.front() = kept.back() = true;
  std::size_t middle = points.size() - 1;
  if (path.closed) {  // from its first vertex to the farthest and back
    for (std::size_t k = 0; k < points.size(); ++k) {
      if (norm2(points[k] - points[0]) > norm2(points[middle] - points[0])) middle = k;
    }
    kept[middle] = true;
    keep_between(points, middle, points.size() - 1, flat_m, kept);
  }
  keep_between(points, 0, middle, flat_m, kept);
  std::vector<Corner> corners;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const bool new_place = corners.empty() || corners.back().at != points[k];
    if (kept[k] && new_place) corners.push_back({k, points[k]});
  }
  return corners;
}

std::vector<Corner> corners_of(const PathMission& path, double turn_radius_m) {
  std::vector<Corner> corners = kept_vertices(path, flat_radii * turn_radius_m);
  const std::size_t n = corners.size();
  for (std::size_t i = 0; i + 1 < n; ++i)
    corners[i].leg_m = norm(corners[i + 1].at - corners[i].at);
  const auto turn = [&](Corner& corner, const Corner& before, const Corner& after) {
    corner.turn_rad = Heading::of(corner.at - before.at).turn_to(Heading::of(after.at - corner.at));
    corner.needs_m = turn_radius_m * std::tan(0.5 * std::min(std::abs(corner.turn_rad), 3.1415));
  };
  for (std::size_t i = 1; i + 1 < n; ++i) turn(corners[i], corners[i - 1], corners[i + 1]);
  if (path.closed && n > 2) {
    turn(corners[0], corners[n - 2], corners[1]);
    corners[n - 1].turn_rad = corners[0].turn_rad;
    corners[n - 1].needs_m = corners[0].needs_m;
  }
  return corners;
}

std::string metres(double m) { return length_text(m) + " m"; }

/// Looks for what a vehicle cannot fly along corners in the order of travel.
class Search {
 public:
  Search(const PathMission& path, double turn_radius_m)
      : closed_(path.closed),
        vertices_(path.vertices_m.size()),
        radius_m_(turn_radius_m),
        slack_m_(slack_radii * turn_radius_m),
        corners_(corners_of(path, turn_radius_m)),
        sharp_(corners_.size(), false) {}

  void sharp_vertices(std::vector<PathTrouble>& troubles) {
    const std::size_t last = corners_.size() - 1;
    for (std::size_t i = closed_ ? 0 : 1; i < last; ++i) {
      const double before_m = corners_[i > 0 ? i - 1 : last - 1].leg_m;
      const double room_m = std::min(before_m, corners_[i].leg_m);
      if (corners_[i].needs_m <= room_m + slack_m_) continue;
      sharp_[i] = true;
      if (i == 0) sharp_[last] = true;
      const double turn_deg = std::abs(corners_[i].turn_rad) * degrees;
      std::string why =
          fmt::format("that takes {} of the legs on both sides, and one of them has {}",
                      metres(corners_[i].needs_m), metres(room_m));
      if (turn_deg > 179.0) why = "the path turns back on itself there";
      troubles.push_back({Kind::sharp_vertex, vertex(i), vertex(i),
                          fmt::format("vertex {} at {} turns by {:.0f} degrees and cannot be "
                                      "rounded with a turning radius of {}: {}",
                                      vertex(i) + 1, place_text(corners_[i].at), turn_deg,
                                      metres(radius_m_), why)});
    }
  }

  void short_legs(std::vector<PathTrouble>& troubles) const {
    for (std::size_t i = 0; i + 1 < corners_.size(); ++i) {
      if (!is_short(i)) continue;
      std::size_t end = i;
      std::size_t worst = i;
      while (end + 1 < corners_.size() && is_short(end)) {
        if (lacks_m(end) > lacks_m(worst)) worst = end;
        ++end;
      }
      const std::string which = end == i + 1 ? fmt::format("the leg from vertex {} to {} is",
                                                           vertex(i) + 1, vertex(end) + 1)
                                             : fmt::format("the {} legs from vertex {} to {} are",
                                                           end - i, vertex(i) + 1, vertex(end) + 1);
      troubles.push_back(
          {Kind::short_leg, vertex(i), vertex(end),
           fmt::format("{} too short for the turns at both ends: from {} on there are {} where a "
                       "turning radius of {} takes {}",
                       which, place_text(corners_[worst].at), metres(corners_[worst].leg_m),
                       metres(radius_m_),
                       metres(corners_[worst].needs_m + corners_[worst + 1].needs_m))});
      i = end;
    }
  }

  /// Turns one way that come faster than the vehicle can fly them, each small.
  void narrow_bends(std::vector<PathTrouble>& troubles) const {
    const std::size_t last = corners_.size() - 1;
    for (std::size_t i = closed_ ? 0 : 1; i < last;) {
      double debt_m = 0.0;
      double largest_m = 0.0;
      double most_m = 0.0;
      double turn_rad = 0.0;
      double length_m = 0.0;
      std::size_t k = i;
      bool told = false;
      for (; k < last; ++k) {
        told = told || sharp_[k] || is_short(k);
        debt_m += 2.0 * corners_[k].needs_m;
        largest_m = std::max(largest_m, 2.0 * corners_[k].needs_m);
        most_m = std::max(most_m, debt_m - largest_m);
        turn_rad += std::abs(corners_[k].turn_rad);
        const bool same_way = corners_[k].turn_rad * corners_[k + 1].turn_rad > 0.0;
        if (!same_way || debt_m <= corners_[k].leg_m) break;
        debt_m -= corners_[k].leg_m;
        length_m += corners_[k].leg_m;
      }
      if (most_m > slack_m_ && !told) {
        const std::size_t end = std::min(k, last);
        troubles.push_back(
            {Kind::narrow_bend, vertex(i), vertex(end),
             fmt::format("from vertex {} at {} to vertex {} the path turns by {:.0f} degrees "
                         "within {}, where a turning radius of {} takes {}",
                         vertex(i) + 1, place_text(corners_[i].at), vertex(end) + 1,
                         turn_rad * degrees, metres(length_m), metres(radius_m_),
                         metres(radius_m_ * turn_rad))});
      }
      i = std::max(k, i) + 1;
    }
  }

 private:
  std::size_t vertex(std::size_t corner) const { return corners_[corner].vertex % vertices_; }
  double lacks_m(std::size_t leg) const {
    return corners_[leg].needs_m + corners_[leg + 1].needs_m - corners_[leg].leg_m;
  }
  bool is_short(std::size_t leg) const {
    return !sharp_[leg] && !sharp_[leg + 1] && lacks_m(leg) > slack_m_;
  }

  bool closed_;
  std::size_t vertices_;
  double radius_m_;
  double slack_m_;
  std::vector<Corner> corners_;
  std::vector<bool> sharp_;
};

/// Of the smallest circle around all vertices, one hundredth too large at most (Badoiu and Clarkson
/// 2003).
double enclosing_radius_m(const std::vector<Vec2>& points) {
  Vec2 center = points.front();
  double radius_m = 0.0;
  constexpr int steps = 400;
  for (int k = 1; k <= steps; ++k) {
    const Vec2 far = *std::max_element(points.begin(), points.end(), [&](Vec2 a, Vec2 b) {
      return norm2(a - center) < norm2(b - center);
    });
    const double far_m = norm(far - center);
    radius_m = k == 1 ? far_m : std::min(radius_m, far_m);
    center = center + (1.0 / (k + 1)) * (far - center);
  }
  return radius_m;
}

void add_crossings(const PathMission& path, std::vector<PathTrouble>& troubles) {
  const std::vector<PathCrossing> crossings = path_crossings(path);
  if (crossings.empty()) return;
  const auto name = [&](std::size_t piece) {
    return fmt::format("{} to {}", piece + 1, (piece + 1) % path.vertices_m.size() + 1);
  };
  const PathCrossing& first = crossings.front();
  const std::string more =
      crossings.size() == 1 ? "" : fmt::format(", and {} more times", crossings.size() - 1);
  troubles.push_back(
      {Kind::crossing, first.first_piece, first.second_piece,
       fmt::format("the path meets itself at {}, where the legs from vertex {} and from vertex {} "
                   "have a point in common{}: a cell has one command, so that flights leave parts "
                   "of the path out",
                   place_text(first.position_m), name(first.first_piece), name(first.second_piece),
                   more)});
}

}  // namespace

std::vector<PathTrouble> path_troubles(const PathMission& path, double turn_radius_m) {
  require(path.vertices_m.size() >= 2, "a path has at least two vertices");
  require(turn_radius_m > 0.0, "the turning radius is positive");
  std::vector<PathTrouble> troubles;
  const double extent_m = enclosing_radius_m(path.vertices_m);
  if (extent_m < turn_radius_m) {
    troubles.push_back(
        {Kind::fits_into_a_turn, 0, path.vertices_m.size() - 1,
         fmt::format("the path fits into a circle of radius {}, less than the turning radius of "
                     "{}: flights may circle around it for ever",
                     metres(extent_m), metres(turn_radius_m))});
  }
  Search search(path, turn_radius_m);
  search.sharp_vertices(troubles);
  search.short_legs(troubles);
  search.narrow_bends(troubles);
  add_crossings(path, troubles);
  return troubles;
}

}  // namespace fairway
