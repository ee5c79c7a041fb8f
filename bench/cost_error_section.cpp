// Errors of the cost-to-go against the truth, next to those of first-order fast marching.
//
// The truth: in the plane and past one corner it is known exactly; on the blob map it is our own
// solver on a grid seven times finer, whose error is about a seventh of ours (docs/benchmarks.md
// compares it with scikit-fmm's second-order solver).
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "bench/blob_map.hpp"
#include "bench/distance_problem.hpp"
#include "bench/scikit_fmm.hpp"
#include "bench/sections.hpp"

namespace fairway::bench {
namespace {

struct Errors {
  double mean_cells = 0.0;
  double max_cells = 0.0;
};

// Over the cells outside the disc with a distance in both the truth and the result.
template <typename Number>
Errors errors_of(const std::vector<Number>& answer, const std::vector<double>& truth,
                 double radius_cells) {
  Errors errors;
  std::size_t count = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (!std::isfinite(truth[i]) || !std::isfinite(answer[i]) || truth[i] <= radius_cells) continue;
    const double error = std::abs(static_cast<double>(answer[i]) - truth[i]);
    errors.mean_cells += error;
    errors.max_cells = std::max(errors.max_cells, error);
    ++count;
  }
  errors.mean_cells /= static_cast<double>(std::max<std::size_t>(count, 1));
  return errors;
}

struct Trial {
  std::string name;
  DistanceProblem problem;
  std::vector<double> truth;
};

Trial open_plane(int side) {
  const auto cells = static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
  Trial trial{"open plane", {{}, side, side, {side / 3, side / 4}, 5.0}, {}};
  trial.problem.blocked.assign(cells, 0);
  for (int iy = 0; iy < side; ++iy) {
    for (int ix = 0; ix < side; ++ix) {
      trial.truth.push_back(std::hypot(ix - trial.problem.goal.ix, iy - trial.problem.goal.iy));
    }
  }
  return trial;
}

// Obstacle cells fill ix >= side / 2, iy <= side / 2; the shortest way to what they hide bends at
// the one corner of that quarter.
Trial one_corner(int side) {
  Trial trial{"past one corner", {{}, side, side, {side / 4, side / 4}, 5.0}, {}};
  const Vec2 goal{static_cast<double>(trial.problem.goal.ix),
                  static_cast<double>(trial.problem.goal.iy)};
  const Vec2 corner{side / 2 - 0.5, side / 2 + 0.5};
  for (int iy = 0; iy < side; ++iy) {
    for (int ix = 0; ix < side; ++ix) {
      const Vec2 p{static_cast<double>(ix), static_cast<double>(iy)};
      const bool blocked = ix >= side / 2 && iy <= side / 2;
      const bool hidden = p.x > corner.x && cross(corner - goal, p - goal) < 0.0;
      trial.problem.blocked.push_back(blocked ? 1 : 0);
      trial.truth.push_back(blocked  ? std::numeric_limits<double>::infinity()
                            : hidden ? norm(corner - goal) + norm(p - corner)
                                     : norm(p - goal));
    }
  }
  return trial;
}

Trial blobs(int side) {
  constexpr int finer = 7;  // odd: the centre of a cell is the centre of a fine cell
  const ObstacleMap map = blob_map(side, map_seed);
  const Cell goal = open_place(map, 10);
  Trial trial{"blob map", {map.obstacle, side, side, goal, 5.0}, {}};
  const int fine_side = finer * side;
  DistanceProblem fine{{}, fine_side, fine_side, {}, finer * 5.0};
  fine.goal = {finer * goal.ix + finer / 2, finer * goal.iy + finer / 2};
  fine.blocked.reserve(map.obstacle.size() * finer * finer);
  for (int iy = 0; iy < fine_side; ++iy) {
    for (int ix = 0; ix < fine_side; ++ix) {
      fine.blocked.push_back(map.obstacle[map.grid.index({ix / finer, iy / finer})]);
    }
  }
  const std::vector<float> answer = eikonal_answer(fine);
  const Grid fine_grid{fine_side, fine_side};
  for (int iy = 0; iy < side; ++iy) {
    for (int ix = 0; ix < side; ++ix) {
      const Cell middle{finer * ix + finer / 2, finer * iy + finer / 2};
      trial.truth.push_back(static_cast<double>(answer[fine_grid.index(middle)]) / finer);
    }
  }
  return trial;
}

std::vector<Row> rows_of(const Trial& trial, ScikitFmm& fmm) {
  const double radius = trial.problem.radius_cells;
  const Errors ours = errors_of(eikonal_answer(trial.problem), trial.truth, radius);
  const std::string mean = fmt::format("  mean error, {}", trial.name);
  const std::string worst = fmt::format("  largest error, {}", trial.name);
  const auto cells = [](double error) { return fmt::format("{:.4f} cells", error); };
  if (!fmm.is_there()) {
    return {without_peer(mean, cells(ours.mean_cells), fmm.why_absent(), "<= 1"),
            without_peer(worst, cells(ours.max_cells), fmm.why_absent(), "<= 1")};
  }
  std::vector<double> answer;
  fmm.pose(trial.problem);
  fmm.solve(1, &answer);
  const Errors peer = errors_of(answer, trial.truth, radius);
  return {ratio_row(mean, cells(ours.mean_cells), "scikit-fmm " + cells(peer.mean_cells),
                    ours.mean_cells / peer.mean_cells, 1.0, "<= 1"),
          ratio_row(worst, cells(ours.max_cells), "scikit-fmm " + cells(peer.max_cells),
                    ours.max_cells / peer.max_cells, 1.0, "<= 1")};
}

}  // namespace

std::vector<Row> cost_error_rows(const Settings& settings) {
  ScikitFmm fmm(settings.fmm_script);
  std::vector<Row> rows;
  const int side = settings.error_side;
  for (const Trial& trial : {open_plane(side), one_corner(side), blobs(side)}) {
    for (Row& row : rows_of(trial, fmm)) rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace fairway::bench
