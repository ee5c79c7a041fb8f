// The euclidean cost-to-go's solver, against scikit-fmm's first-order fast marching.
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <utility>
#include <vector>

#include "bench/blob_map.hpp"
#include "bench/distance_problem.hpp"
#include "bench/scikit_fmm.hpp"
#include "bench/sections.hpp"

namespace fairway::bench {
namespace {

// Two first-order solvers differ by both their errors: a few cells in a thousand.
void check_against(const std::vector<double>& peer, const std::vector<float>& ours) {
  for (std::size_t i = 0; i < ours.size(); ++i) {
    const bool both_finite = std::isfinite(ours[i]) && std::isfinite(peer[i]);
    if (std::isfinite(ours[i]) != std::isfinite(peer[i])) {
      throw std::runtime_error("cost-to-go: one solver reaches a cell that the other does not");
    }
    if (both_finite && std::abs(static_cast<double>(ours[i]) - peer[i]) > 5.0 + 0.02 * peer[i]) {
      throw std::runtime_error("cost-to-go: more than 2 % from scikit-fmm's distance");
    }
  }
}

}  // namespace

std::vector<Row> cost_rows(const Settings& settings) {
  const char* name = "cost-to-go (eikonal), obstacles and goal alone";
  ObstacleMap map = blob_map(settings.side, map_seed);
  DistanceProblem problem{std::move(map.obstacle), map.grid.nx, map.grid.ny, {}, 5.0};
  map.obstacle = problem.blocked;
  problem.goal = open_place(map, 10);
  std::vector<float> answer;
  const auto ours = [&] { return timed([&] { answer = eikonal_answer(problem); }); };
  ours();
  ScikitFmm fmm(settings.fmm_script);
  if (!fmm.is_there()) return {without_peer(name, shown(ours()), fmm.why_absent(), "<= 1/6")};
  fmm.pose(problem);
  std::vector<double> of_peer;
  fmm.solve(1, &of_peer);
  check_against(of_peer, answer);
  const Medians took = interleaved(settings.repeats, ours, [&] { return fmm.solve(1); });
  return {ratio_row(name, shown(took.ours), "scikit-fmm " + shown(took.peer),
                    took.ours.wall_s / took.peer.wall_s, 1.0 / 6.0, "<= 1/6")};
}

}  // namespace fairway::bench
