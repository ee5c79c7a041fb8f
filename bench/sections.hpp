// The sections of the benchmark table. Each checks that results agree before timing anything, and
// throws std::runtime_error when they do not.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/table.hpp"

namespace fairway::bench {

struct Settings {
  int side = 4096;                                         ///< cells along a side of the map
  int error_side = 1024;                                   ///< the same, for measuring errors
  std::vector<int> sides = {512, 1024, 2048, 4096, 8192};  ///< for the whole pipeline
  int repeats = 5;
  int threads = 2;
  int flights = 2048;
  int bitmap_side = 20;  ///< and ten times that
  int bitmap_samples = 200;
  std::string program;     ///< this program, started again for one whole pipeline
  std::string fmm_script;  ///< scikit_fmm_peer.py
};

inline constexpr std::uint64_t map_seed = 1;

[[nodiscard]] std::vector<Row> distance_rows(const Settings& settings);
[[nodiscard]] std::vector<Row> cost_rows(const Settings& settings);
[[nodiscard]] std::vector<Row> cost_error_rows(const Settings& settings);
[[nodiscard]] std::vector<Row> filter_rows(const Settings& settings);
[[nodiscard]] std::vector<Row> pipeline_rows(const Settings& settings);
[[nodiscard]] std::vector<Row> flight_rows(const Settings& settings);
[[nodiscard]] std::vector<Row> bitmap_rows(const Settings& settings);
[[nodiscard]] std::vector<Row> steer_rows(const Settings& settings);
[[nodiscard]] std::vector<Row> certified_rows(const Settings& settings);
[[nodiscard]] std::vector<Row> modes_rows(const Settings& settings);
[[nodiscard]] std::vector<Row> contract_rows(const Settings& settings);

/// One whole pipeline in this process, which must not have done anything else. Prints a line
/// "WALL_S CPU_S BYTES_BEFORE BYTES_AT_PEAK SHARE", where SHARE is that of the safe-start cells
/// that can reach the goal.
void run_one_field(int side);

/// One backward reachable set in this process. Prints a line "WALL_S CPU_S STATES BYTES_STORED
/// BYTES_AT_PEAK SHARE", where SHARE is that of the configuration volume.
void run_one_bitmap(int side, int samples);

}  // namespace fairway::bench
