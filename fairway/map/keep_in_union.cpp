#include "fairway/map/keep_in_union.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include <ogr_geometry.h>

#include "fairway/base/error.hpp"
#include "fairway/base/heading.hpp"
#include "fairway/map/gdal_session.hpp"

namespace fairway {

namespace {

std::unique_ptr<OGRLinearRing> ogr_ring(const std::vector<Vec2>& ring) {
  auto result = std::make_unique<OGRLinearRing>();
  for (const Vec2 p : ring) result->addPoint(p.x, p.y);
  result->closeRings();
  return result;
}

std::unique_ptr<OGRPolygon> ogr_polygon(const FencePolygon& polygon) {
  auto result = std::make_unique<OGRPolygon>();
  for (const auto& ring : polygon.rings_m) result->addRingDirectly(ogr_ring(ring).release());
  return result;
}

// Corners on the circle: the polygon lies inside, its edges at most r (1 - cos(pi / n)) away.
FencePolygon inscribed(const FenceCircle& circle, double sagitta_m) {
  const double half_angle = std::acos(std::clamp(1.0 - sagitta_m / circle.radius_m, -1.0, 1.0));
  const double wanted = std::ceil(pi / std::max(half_angle, 1e-6));
  const int corners = static_cast<int>(std::clamp(wanted, 16.0, 65536.0));
  FencePolygon result;
  auto& ring = result.rings_m.emplace_back();
  for (int i = 0; i < corners; ++i) {
    const double angle = two_pi * i / corners;
    ring.push_back({circle.center_m.x + circle.radius_m * std::cos(angle),
                    circle.center_m.y + circle.radius_m * std::sin(angle)});
  }
  return result;
}

void take_rings(const OGRGeometry& geometry, FencePolygon& result) {
  if (wkbFlatten(geometry.getGeometryType()) == wkbPolygon) {
    for (const OGRLinearRing* ring : *geometry.toPolygon()) {
      auto& out = result.rings_m.emplace_back();
      for (int i = 0; i + 1 < ring->getNumPoints(); ++i)
        out.push_back({ring->getX(i), ring->getY(i)});
    }
  } else if (OGR_GT_IsSubClassOf(wkbFlatten(geometry.getGeometryType()), wkbGeometryCollection)) {
    for (const OGRGeometry* part : *geometry.toGeometryCollection()) take_rings(*part, result);
  }
}

}  // namespace

FencePolygon keep_in_union(const std::vector<FencePolygon>& polygons,
                           const std::vector<FenceCircle>& circles, double sagitta_m) {
  const GdalSession session;
  std::unique_ptr<OGRGeometry> all = std::make_unique<OGRMultiPolygon>();
  const auto add = [&](const FencePolygon& polygon) {
    const auto next = ogr_polygon(polygon);
    all.reset(all->Union(next.get()));
    if (!all) throw InputError("keep-in fences", "cannot be joined: " + session.message());
  };
  for (const auto& polygon : polygons) add(polygon);
  for (const auto& circle : circles) add(inscribed(circle, sagitta_m));
  FencePolygon result;
  take_rings(*all, result);
  return result;
}

}  // namespace fairway
