// The one table of `make bench`: one row per claim, and whether it holds.
#pragma once

#include <string>
#include <vector>

#include "bench/stopwatch.hpp"

namespace fairway::bench {

struct Row {
  std::string name;
  std::string ours;
  std::string peer = "";
  std::string ratio = "";
  std::string target = "";
  std::string verdict = "";  ///< "holds", "FALLS SHORT", "not measured", or nothing without target
};

/// ours / peer must be at most `limit` (shown as `target`).
[[nodiscard]] Row ratio_row(std::string name, std::string ours, std::string peer, double ratio,
                            double limit, std::string target);
/// A value of ours alone, which must be at most, or at least, `limit`.
[[nodiscard]] Row at_most_row(std::string name, std::string ours, double value, double limit);
[[nodiscard]] Row at_least_row(std::string name, std::string ours, double value, double limit);
/// The peer is not on this machine.
[[nodiscard]] Row without_peer(std::string name, std::string ours, std::string why,
                               std::string target);

/// "123.4 ms"; "12.34 s (1.0 cores)" includes how many cores were busy.
[[nodiscard]] std::string shown(const Took& took);

void print_table(const std::vector<Row>& rows);

}  // namespace fairway::bench
