#include "fairway/map/geodetic_fences.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "fairway/base/error.hpp"
#include "fairway/map/simple_polygon.hpp"
#include "fairway/map/tangent_plane.hpp"

namespace fairway {

namespace {

constexpr double straightness_m = 1e-3;

std::string shown_point(GeodeticPoint p) {
  return fmt::format("latitude {:.7f}, longitude {:.7f}", p.latitude_deg, p.longitude_deg);
}

std::string shown_edge(const GeodeticPolygon& polygon, std::size_t r, std::size_t edge) {
  const GeodeticRing& ring = polygon.rings[r];
  const std::size_t next = (edge + 1) % ring.points.size();
  const std::string of_ring =
      polygon.rings.size() > 1 ? fmt::format(" of ring {}", r) : std::string();
  if (!ring.lines.empty())
    return fmt::format("the edge from line {} to line {}", ring.lines[edge], ring.lines[next]);
  return fmt::format("edge {} (vertex {} to {}){}", edge, edge, next, of_ring);
}

// Equal neighbouring vertices do not form an edge.
void drop_repeated(GeodeticRing& ring) {
  GeodeticRing kept;
  for (std::size_t i = 0; i < ring.points.size(); ++i) {
    if (!kept.points.empty() && kept.points.back() == ring.points[i]) continue;
    kept.points.push_back(ring.points[i]);
    if (!ring.lines.empty()) kept.lines.push_back(ring.lines[i]);
  }
  while (kept.points.size() > 1 && kept.points.back() == kept.points.front()) {
    kept.points.pop_back();
    if (!kept.lines.empty()) kept.lines.pop_back();
  }
  ring = std::move(kept);
}

void require_simple(const GeodeticPolygon& polygon) {
  std::vector<std::vector<Vec2>> rings;
  for (const GeodeticRing& ring : polygon.rings) {
    auto& degrees = rings.emplace_back();
    for (const GeodeticPoint p : ring.points) degrees.push_back({p.longitude_deg, p.latitude_deg});
  }
  if (const auto contact = find_contact(rings))
    throw InputError(polygon.where,
                     fmt::format("the polygon crosses or touches itself: {} meets {} at {}",
                                 shown_edge(polygon, contact->first_ring, contact->first_edge),
                                 shown_edge(polygon, contact->second_ring, contact->second_edge),
                                 shown_point({contact->at.y, contact->at.x})));
}

std::vector<GeodeticPolygon> checked_polygons(const GeodeticFences& fences) {
  std::vector<GeodeticPolygon> polygons = fences.polygons;
  for (GeodeticPolygon& polygon : polygons) {
    for (std::size_t r = 0; r < polygon.rings.size(); ++r) {
      for (const GeodeticPoint p : polygon.rings[r].points) require_geodetic(polygon.where, p);
      drop_repeated(polygon.rings[r]);
      if (polygon.rings[r].points.size() < 3)
        throw InputError(polygon.where,
                         fmt::format("ring {} has {} different vertices, expected at least 3", r,
                                     polygon.rings[r].points.size()));
    }
    require_simple(polygon);
  }
  return polygons;
}

// The smallest box in degrees around everything.
struct Box {
  GeodeticPoint low{std::numeric_limits<double>::infinity(),
                    std::numeric_limits<double>::infinity()};
  GeodeticPoint high{-std::numeric_limits<double>::infinity(),
                     -std::numeric_limits<double>::infinity()};

  void hold(GeodeticPoint p) {
    low = {std::min(low.latitude_deg, p.latitude_deg),
           std::min(low.longitude_deg, p.longitude_deg)};
    high = {std::max(high.latitude_deg, p.latitude_deg),
            std::max(high.longitude_deg, p.longitude_deg)};
  }
  GeodeticPoint center() const {
    return {0.5 * (low.latitude_deg + high.latitude_deg),
            0.5 * (low.longitude_deg + high.longitude_deg)};
  }
};

// Calls visit(where, point) for every point in a file.
template <typename Visit>
void for_each_point(const GeodeticFences& fences, const Visit& visit) {
  for (const auto& polygon : fences.polygons)
    for (const auto& ring : polygon.rings)
      for (const GeodeticPoint p : ring.points) visit(polygon.where, p);
  for (const auto& circle : fences.circles) visit(circle.where, circle.center);
  for (const GeodeticPoint p : fences.places)
    visit(fences.inputs.empty() ? std::string() : fences.inputs.front().path + ": mission", p);
}

double farthest_m(const GeodeticFences& fences, const TangentPlane& plane) {
  double farthest = 0.0;
  for_each_point(fences, [&](const std::string&, GeodeticPoint p) {
    farthest = std::max(farthest, norm(plane.to_plane_m(p)));
  });
  return farthest;
}

TangentPlane choose_plane(const GeodeticFences& fences, std::optional<GeodeticPoint> reference,
                          FenceSet& result) {
  Box box;
  for_each_point(fences, [&](const std::string& where, GeodeticPoint p) {
    require_geodetic(where, p);
    box.hold(p);
  });
  if (box.high.longitude_deg - box.low.longitude_deg > 180.0)
    throw InputError(fences.inputs.empty() ? "map" : fences.inputs.front().path,
                     "spans more than 180 degrees of longitude; maps across the antimeridian are "
                     "not supported");
  if (reference) {
    require_geodetic("map reference", *reference);
    return TangentPlane(*reference);
  }
  if (fences.home) {
    require_geodetic("home position", *fences.home);
    const TangentPlane at_home(*fences.home);
    if (farthest_m(fences, at_home) <= tangent_plane_limit_m) return at_home;
    result.warnings.push_back(fmt::format(
        "The home position ({}) is more than {} km from the map; the centre of the map is the "
        "origin instead.",
        shown_point(*fences.home), tangent_plane_limit_m / 1e3));
  }
  return TangentPlane(box.center());
}

class PlaneBuilder {
 public:
  explicit PlaneBuilder(const TangentPlane& plane) : plane_(plane) {}

  Vec2 point(const std::string& where, GeodeticPoint p, double radius_m = 0.0) {
    const Vec2 at = plane_.to_plane_m(p);
    if (!(norm(at) + radius_m <= tangent_plane_limit_m))
      throw InputError(where,
                       fmt::format("{} is {:.0f} km from the reference point ({}), expected "
                                   "at most {} km; are latitude and longitude swapped?",
                                   shown_point(p), (norm(at) + radius_m) / 1e3,
                                   shown_point(plane_.reference()), tangent_plane_limit_m / 1e3));
    // The bound for the far side of a circle: the same function at a point that far away.
    const GeodeticPoint far = radius_m > 0.0 ? plane_.from_plane({0.0, norm(at) + radius_m}) : p;
    disc_error_m_ = std::max(disc_error_m_, plane_.worst_error_m(far));
    return at;
  }

  FencePolygon polygon(const GeodeticPolygon& source) {
    FencePolygon result;
    for (const GeodeticRing& ring : source.rings) {
      auto& out = result.rings_m.emplace_back();
      for (std::size_t i = 0; i < ring.points.size(); ++i) {
        const GeodeticPoint from = ring.points[i];
        const GeodeticPoint to = ring.points[(i + 1) % ring.points.size()];
        const Vec2 from_m = point(source.where, from);
        out.push_back(from_m);
        divide(out, from, from_m, to, point(source.where, to), 16);
      }
    }
    return result;
  }

  double worst_error_m() const { return disc_error_m_ + bend_error_m_; }

 private:
  // An edge straight in degrees is curved in the plane: halve it until the curve is small.
  void divide(std::vector<Vec2>& out, GeodeticPoint from, Vec2 from_m, GeodeticPoint to, Vec2 to_m,
              int depth) {
    const GeodeticPoint middle{0.5 * (from.latitude_deg + to.latitude_deg),
                               0.5 * (from.longitude_deg + to.longitude_deg)};
    const Vec2 middle_m = plane_.to_plane_m(middle);
    const double bend_m = norm(middle_m - 0.5 * (from_m + to_m));
    if (bend_m <= straightness_m || depth == 0) {
      bend_error_m_ = std::max(bend_error_m_, bend_m);
      return;
    }
    divide(out, from, from_m, middle, middle_m, depth - 1);
    out.push_back(middle_m);
    divide(out, middle, middle_m, to, to_m, depth - 1);
  }

  const TangentPlane& plane_;
  double disc_error_m_ = 0.0;
  double bend_error_m_ = 0.0;
};

}  // namespace

void require_geodetic(const std::string& where, GeodeticPoint point) {
  if (!(std::abs(point.latitude_deg) <= 90.0))
    throw InputError(where, fmt::format("latitude {} is out of range, expected degrees from -90 to "
                                        "90",
                                        point.latitude_deg));
  if (!(std::abs(point.longitude_deg) <= 180.0))
    throw InputError(where, fmt::format("longitude {} is out of range, expected degrees from -180 "
                                        "to 180",
                                        point.longitude_deg));
}

FenceSet in_tangent_plane(const GeodeticFences& fences, std::optional<GeodeticPoint> reference) {
  FenceSet result;
  result.inputs = fences.inputs;
  result.warnings = fences.warnings;
  for (const auto& circle : fences.circles)
    if (!std::isfinite(circle.radius_m) || circle.radius_m <= 0.0)
      throw InputError(circle.where,
                       fmt::format("the radius is {}, expected metres above 0", circle.radius_m));
  const std::vector<GeodeticPolygon> polygons = checked_polygons(fences);
  const TangentPlane plane = choose_plane(fences, reference, result);
  PlaneBuilder builder(plane);
  for (const auto& polygon : polygons)
    (polygon.keep_in ? result.keep_in : result.keep_out).push_back(builder.polygon(polygon));
  for (const auto& circle : fences.circles)
    (circle.keep_in ? result.keep_in_circles : result.keep_out_circles)
        .push_back({builder.point(circle.where, circle.center, circle.radius_m), circle.radius_m});
  for (std::size_t i = 0; i < fences.places.size(); ++i)
    result.places_m.push_back(
        builder.point(fences.inputs.empty() ? "mission" : fences.inputs.front().path + ": mission",
                      fences.places[i]));
  result.geo = GeoReference{plane.reference().latitude_deg, plane.reference().longitude_deg,
                            builder.worst_error_m()};
  return result;
}

}  // namespace fairway
