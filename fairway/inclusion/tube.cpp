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

/// The pieces of a path that come near square tiles of a plane.
class NearPieces {
 public:
  /// Tiles cover nx by ny parts; pieces up to `near_m` away are near.
  NearPieces(const Parts& parts, const Grid& grid, const std::vector<PathPiece>& pieces,
             double near_m)
      : side_(static_cast<int>(std::clamp(0.5 * near_m / parts.part_m(), 1.0, 64.0))),
        nx_((parts.nx() + side_ - 1) / side_),
        ny_((parts.ny() + side_ - 1) / side_),
        near_(static_cast<std::size_t>(nx_) * static_cast<std::size_t>(ny_)) {
    const double tile_m = side_ * parts.part_m();
    const auto tile_of = [&](double from_origin_m, int count) {
      return static_cast<int>(std::clamp(std::floor(from_origin_m / tile_m), 0.0, count - 1.0));
    };
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      const auto& [a, b, length_m] = pieces[i];
      const int x0 = tile_of(std::min(a.x, b.x) - near_m - grid.x0_m, nx_);
      const int x1 = tile_of(std::max(a.x, b.x) + near_m - grid.x0_m, nx_);
      const int y0 = tile_of(std::min(a.y, b.y) - near_m - grid.y0_m, ny_);
      const int y1 = tile_of(std::max(a.y, b.y) + near_m - grid.y0_m, ny_);
      for (int y = y0; y <= y1; ++y) {
        for (int x = x0; x <= x1; ++x) {
          const Vec2 middle{grid.x0_m + (x + 0.5) * tile_m, grid.y0_m + (y + 0.5) * tile_m};
          if (distance_to(pieces[i], middle) > near_m + tile_m) continue;
          near_[index(x, y)].push_back(i);
        }
      }
    }
  }

  const std::vector<std::size_t>& near(PartPlace part) const {
    return near_[index(part.ix / side_, part.iy / side_)];
  }

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(nx_) +
           static_cast<std::size_t>(x);
  }

  int side_;  // of a tile, in parts
  int nx_;
  int ny_;
  std::vector<std::vector<std::size_t>> near_;  // [tiles]
};

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
  const NearPieces tiles(parts, grid, pieces_, widest_m + 2.0 * half_m);
  for_ranges(static_cast<std::size_t>(parts.ny()), 1, [&](std::size_t a, std::size_t b) {
    for (std::size_t iy = a; iy < b; ++iy) {
      for (int ix = 0; ix < parts.nx(); ++ix) {
        const PartPlace place{ix, static_cast<int>(iy)};
        const std::vector<std::size_t>& near = tiles.near(place);
        if (near.empty()) continue;
        const Vec2 middle{grid.x0_m + (ix + 0.5) * parts.part_m(),
                          grid.y0_m + (static_cast<double>(iy) + 0.5) * parts.part_m()};
        const PathFrame frame = path.frame(middle);
        const double most_m = std::abs(frame.offset_m) + half_m;
        if (most_m > widest_m) continue;
        const std::size_t part = parts.index(place);
        distance_m_[part] = std::nextafter(static_cast<float>(most_m), outside);
        station_m_[part] = static_cast<float>(frame.station_m);
        // The nearest point of any place of the part lies so near the middle.
        HeadingArc arc{heading_of(frame.tangent), 0.0};
        const double reach_m = most_m + half_m;
        for (const std::size_t i : near) {
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
