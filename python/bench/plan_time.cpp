// How long a plan takes in C++, for plan_overhead.py: plan_time FILE NX NY CELL GOAL_X GOAL_Y TURNS
// reads NX x NY bytes and prints the seconds of each of TURNS plans.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <variant>

#include "fairway/run/plan_map.hpp"

int main(int count, char** words) {
  if (count != 8) return 64;
  std::ifstream file(words[1], std::ios::binary);
  const std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>(file), {}};
  const int nx = std::atoi(words[2]);
  const int ny = std::atoi(words[3]);
  const double cell_m = std::atof(words[4]);
  const fairway::Vec2 goal_m{std::atof(words[5]), std::atof(words[6])};
  for (int turn = 0; turn < std::atoi(words[7]); ++turn) {
    const auto begin = std::chrono::steady_clock::now();
    fairway::ObstacleMap map;
    map.grid = {nx, ny, 0.0, 0.0, cell_m};
    map.obstacle = bytes;
    const auto answer =
        fairway::plan_map(map, {10.0, 3.0 * cell_m}, fairway::GoalMission{goal_m, {}}, {});
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begin;
    if (!std::holds_alternative<fairway::Plan>(answer)) return 1;
    std::printf("%.9f\n", wall.count());
  }
  return 0;
}
