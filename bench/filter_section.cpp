// The Gaussian filter of both components, against OpenCV's GaussianBlur, and at a wider sigma.
#include <fmt/core.h>

#include <cmath>
#include <cstddef>
#include <functional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "bench/blob_map.hpp"
#include "bench/opencv.hpp"
#include "bench/sections.hpp"
#include "fairway/base/heading.hpp"
#include "fairway/base/random.hpp"
#include "fairway/field/gaussian_filter.hpp"

namespace fairway::bench {
namespace {

// Unit vectors that turn randomly from cell to cell; none in obstacles.
VectorField wandering_field(const ObstacleMap& map) {
  VectorField field(map.obstacle.size());
  Random random(7);
  double heading = 0.0;
  for (std::size_t i = 0; i < field.x.size(); ++i) {
    heading += random.uniform(-0.3, 0.3);
    if (map.obstacle[i] != 0) continue;
    field.x[i] = static_cast<float>(std::cos(heading));
    field.y[i] = static_cast<float>(std::sin(heading));
  }
  return field;
}

// Our weights are not normalised: the factor is the square of their sum. OpenCV reflects at the
// map's edge, so cells near it are skipped.
void check_against(std::span<const float> peer, const VectorField& ours, const Grid& grid,
                   double sigma) {
  const int r = gaussian_half_width(sigma);
  double sum = 0.0;
  for (int k = -r; k <= r; ++k) sum += std::exp(-0.5 * k * k / (sigma * sigma));
  for (int iy = r; iy < grid.ny - r; ++iy) {
    for (int ix = r; ix < grid.nx - r; ++ix) {
      const std::size_t i = grid.index({ix, iy});
      const double dx =
          static_cast<double>(ours.x[i]) / (sum * sum) - static_cast<double>(peer[2 * i]);
      const double dy =
          static_cast<double>(ours.y[i]) / (sum * sum) - static_cast<double>(peer[2 * i + 1]);
      if (!(std::abs(dx) < 1e-5 && std::abs(dy) < 1e-5)) {
        throw std::runtime_error("Gaussian filter: differs from OpenCV's GaussianBlur");
      }
    }
  }
}

}  // namespace

std::vector<Row> filter_rows(const Settings& settings) {
  const ObstacleMap map = blob_map(settings.side, map_seed);
  const int nx = map.grid.nx;
  const int ny = map.grid.ny;
  const VectorField field = wandering_field(map);
  VectorField work;
  using Filter = std::function<void(VectorField&, double)>;
  const Filter over_all = [&](VectorField& f, double sigma) { gaussian_filter(f, nx, ny, sigma); };
  const Filter between_walls = [&](VectorField& f, double sigma) {
    gaussian_filter_between_walls(f, map.obstacle, nx, ny, sigma);
  };
  const auto run = [&](const Filter& filter, double sigma) {
    work = field;
    return timed([&] { filter(work, sigma); });
  };

  OpenCv opencv(settings.threads);
  run(over_all, 4.0);
  if (OpenCv::is_there()) {
    opencv.place_vectors(field.x, field.y, nx, ny);
    opencv.gaussian_blur(4.0, gaussian_half_width(4.0));
    check_against(opencv.blurred(), work, map.grid, 4.0);
    opencv.gaussian_blur_on_threads(4.0, gaussian_half_width(4.0));
    check_against(opencv.blurred(), work, map.grid, 4.0);
  }
  const auto blur = [&](double sigma) {
    return timed([&] { opencv.gaussian_blur(sigma, gaussian_half_width(sigma)); });
  };
  const auto blur_on_threads = [&](double sigma) {
    return timed([&] { opencv.gaussian_blur_on_threads(sigma, gaussian_half_width(sigma)); });
  };
  std::vector<Row> rows;
  for (const auto& [name, filter] : {std::pair{"Gaussian filter, whole map", over_all},
                                     std::pair{"Gaussian filter, between walls", between_walls}}) {
    const std::string at_4 = fmt::format("{}, sigma 4", name);
    if (OpenCv::is_there()) {
      const Medians took = interleaved(
          settings.repeats, [&] { return run(filter, 4.0); }, [&] { return blur(4.0); });
      rows.push_back(ratio_row(at_4, shown(took.ours), "OpenCV " + shown(took.peer),
                               took.ours.wall_s / took.peer.wall_s, 1.0, "<= 1"));
      const Medians threads = interleaved(
          settings.repeats, [&] { return run(filter, 4.0); }, [&] { return blur_on_threads(4.0); });
      rows.push_back(ratio_row("  OpenCV called on a band a thread", shown(threads.ours),
                               "OpenCV " + shown(threads.peer),
                               threads.ours.wall_s / threads.peer.wall_s, 1.0, "<= 1"));
    } else {
      rows.push_back(without_peer(at_4, shown(run(filter, 4.0)),
                                  "OpenCV was not there at build time", "<= 1"));
    }
    const Medians took = interleaved(
        settings.repeats, [&] { return run(filter, 16.0); }, [&] { return run(filter, 4.0); });
    rows.push_back(ratio_row(fmt::format("{}, sigma 16", name), shown(took.ours),
                             "at sigma 4 " + shown(took.peer), took.ours.wall_s / took.peer.wall_s,
                             1.5, "<= 1.5"));
    if (!OpenCv::is_there()) continue;
    const Medians threads = interleaved(
        settings.repeats, [&] { return run(filter, 16.0); }, [&] { return blur_on_threads(16.0); });
    rows.push_back({"  OpenCV at sigma 16, on a band a thread", shown(threads.ours),
                    "OpenCV " + shown(threads.peer),
                    fmt::format("{:.3f}", threads.ours.wall_s / threads.peer.wall_s)});
  }
  return rows;
}

}  // namespace fairway::bench
