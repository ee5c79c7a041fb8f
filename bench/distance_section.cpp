// The exact distance transform with nearest features, against OpenCV's (which has no features).
#include <fmt/core.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <vector>

#include "bench/blob_map.hpp"
#include "bench/opencv.hpp"
#include "bench/sections.hpp"
#include "fairway/field/distance_transform.hpp"

namespace fairway::bench {
namespace {

void check_nearest(const ObstacleMap& map, const std::vector<std::int32_t>& squared,
                   const std::vector<std::uint32_t>& nearest) {
  for (std::size_t i = 0; i < squared.size(); ++i) {
    const Cell a = map.grid.cell_at(i);
    const Cell b = map.grid.cell_at(nearest[i]);
    const int dx = a.ix - b.ix;
    const int dy = a.iy - b.iy;
    if (map.obstacle[nearest[i]] == 0 || dx * dx + dy * dy != squared[i]) {
      throw std::runtime_error("distance transform: a nearest feature is not at its distance");
    }
  }
}

void check_against(std::span<const float> peer, const std::vector<std::int32_t>& squared) {
  for (std::size_t i = 0; i < squared.size(); ++i) {
    if (!(std::abs(std::sqrt(static_cast<double>(squared[i])) - static_cast<double>(peer[i])) <
          1e-3)) {
      throw std::runtime_error(
          fmt::format("distance transform: sqrt({}) here, {} by OpenCV", squared[i], peer[i]));
    }
  }
}

}  // namespace

std::vector<Row> distance_rows(const Settings& settings) {
  const char* name = "exact distance transform, with nearest feature";
  const ObstacleMap map = blob_map(settings.side, map_seed);
  std::vector<std::int32_t> squared(map.obstacle.size());
  std::vector<std::uint32_t> nearest(map.obstacle.size());
  const auto ours = [&] {
    return timed([&] {
      distance_transform(map.obstacle, map.grid.nx, map.grid.ny, {squared, nearest});
    });
  };
  ours();
  check_nearest(map, squared, nearest);
  if (!OpenCv::is_there()) {
    return {without_peer(name, shown(ours()), "OpenCV was not there at build time", "<= 1")};
  }
  OpenCv opencv(settings.threads);
  opencv.place_features(map.obstacle, map.grid.nx, map.grid.ny);
  opencv.distance_transform();
  check_against(opencv.distances(), squared);
  const Medians took = interleaved(settings.repeats, ours,
                                   [&] { return timed([&] { opencv.distance_transform(); }); });
  return {ratio_row(name, shown(took.ours), "OpenCV " + shown(took.peer),
                    took.ours.wall_s / took.peer.wall_s, 1.0, "<= 1")};
}

}  // namespace fairway::bench
