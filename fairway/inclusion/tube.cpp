#include "fairway/inclusion/tube.hpp"

#include <algorithm>
#include <cmath>

#include "fairway/base/parallel.hpp"

namespace fairway {
namespace {

double heading_of(Vec2 direction) { return std::atan2(direction.y, direction.x); }

double distance_to(const PathPiece& piece, Vec2 place) {
  const double along = std::clamp(dot(place - piece.from, piece.tangent()), 0.0, piece.length_m);
  return norm(place - piece.at(along));
}

}  // namespace

Tube::Tube(const Parts& parts, const Grid& grid, const PathLocator& path, double widest_m)
    : length_m_(path.length_m()),
      closed_(path.path().closed),
      distance_m_(parts.size(), outside),
      station_m_(parts.size(), 0.0F),
      tangents_(parts.size()) {
  std::vector<double> heading_rad;
  for_pieces(path.path(), [&](const PathPiece& piece) {
    heading_rad.push_back(heading_of(piece.tangent()));
    pieces_.push_back(piece);
  });
  double station_m = 0.0;
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    const double before = heading_rad[(i + pieces_.size() - 1) % pieces_.size()];
    if (closed_ || i > 0) {
      corner_.emplace_back(station_m,
                           std::abs(std::remainder(heading_rad[i] - before, whole_turn_rad)));
    }
    station_m += pieces_[i].length_m;
  }
  const double half_m = std::sqrt(0.5) * parts.part_m() * (1.0 + place_slack);
  for_ranges(static_cast<std::size_t>(parts.ny()), 1, [&](std::size_t a, std::size_t b) {
    for (std::size_t iy = a; iy < b; ++iy) {
      for (int ix = 0; ix < parts.nx(); ++ix) {
        const Vec2 middle{grid.x0_m + (ix + 0.5) * parts.part_m(),
                          grid.y0_m + (static_cast<double>(iy) + 0.5) * parts.part_m()};
        const PathFrame frame = path.frame(middle);
        const double most_m = std::abs(frame.offset_m) + half_m;
        if (most_m > widest_m) continue;
        const std::size_t part = parts.index({ix, static_cast<int>(iy)});
        distance_m_[part] = std::nextafter(static_cast<float>(most_m), outside);
        station_m_[part] = static_cast<float>(frame.station_m);
        // The nearest point of any place of the part lies so near the middle.
        HeadingArc arc{heading_of(frame.tangent), 0.0};
        const double reach_m = most_m + half_m;
        for (std::size_t i = 0; i < pieces_.size(); ++i) {
          if (distance_to(pieces_[i], middle) <= reach_m) arc = arc.with({heading_rad[i], 0.0});
        }
        tangents_[part] = arc;
      }
    }
  });
}

double Tube::off_rad(std::size_t part, const HeadingArc& headings) const {
  const HeadingArc& t = tangents_[part];
  const double middles = headings.lo_rad + 0.5 * headings.width_rad - t.lo_rad - 0.5 * t.width_rad;
  return std::abs(std::remainder(middles, whole_turn_rad)) +
         0.5 * (headings.width_rad + t.width_rad);
}

double Tube::turning_rad(double from_m, double to_m) const {
  double sum = 0.0;
  for (const auto& [station_m, rad] : corner_) {
    if (station_m >= from_m && station_m <= to_m) sum += rad;
  }
  return sum;
}

Vec2 Tube::place_m(double station_m) const {
  for (const PathPiece& piece : pieces_) {
    if (station_m <= piece.length_m) return piece.at(std::max(station_m, 0.0));
    station_m -= piece.length_m;
  }
  return pieces_.back().to;
}

double Tube::ahead_m(double from_m, double to_m) const {
  const double ahead = to_m - from_m;
  return closed_ ? std::remainder(ahead, length_m_) : ahead;
}

}  // namespace fairway
