#include "bench/table.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

namespace fairway::bench {
namespace {

std::string verdict(bool holds) { return holds ? "holds" : "FALLS SHORT"; }

std::array<std::string, 6> fields(const Row& row) {
  return {row.name, row.ours, row.peer, row.ratio, row.target, row.verdict};
}

}  // namespace

Row ratio_row(std::string name, std::string ours, std::string peer, double ratio, double limit,
              std::string target) {
  return {std::move(name),   std::move(ours),        std::move(peer), fmt::format("{:.3f}", ratio),
          std::move(target), verdict(ratio <= limit)};
}

Row at_most_row(std::string name, std::string ours, double value, double limit) {
  return {std::move(name),        std::move(ours), "", "", fmt::format("<= {:g}", limit),
          verdict(value <= limit)};
}

Row at_least_row(std::string name, std::string ours, double value, double limit) {
  return {std::move(name),        std::move(ours), "", "", fmt::format(">= {:g}", limit),
          verdict(value >= limit)};
}

Row without_peer(std::string name, std::string ours, std::string why, std::string target) {
  return {std::move(name), std::move(ours), std::move(why), "", std::move(target), "not measured"};
}

std::string shown(const Took& took) {
  const double cores = took.wall_s > 0.0 ? took.cpu_s / took.wall_s : 0.0;
  if (took.wall_s < 1.0) return fmt::format("{:.1f} ms ({:.2f} cores)", 1e3 * took.wall_s, cores);
  return fmt::format("{:.2f} s ({:.2f} cores)", took.wall_s, cores);
}

void print_table(const std::vector<Row>& rows) {
  std::vector<std::array<std::string, 6>> lines = {
      {"what", "ours", "peer", "ratio", "target", "verdict"}};
  for (const Row& row : rows) lines.push_back(fields(row));
  std::array<std::size_t, 6> width{};
  for (const auto& line : lines) {
    for (std::size_t i = 0; i < line.size(); ++i) width[i] = std::max(width[i], line[i].size());
  }
  for (std::size_t l = 0; l < lines.size(); ++l) {
    for (std::size_t i = 0; i < 6; ++i) fmt::print("| {:<{}} ", lines[l][i], width[i]);
    fmt::print("|\n");
    if (l > 0) continue;
    for (const std::size_t w : width) fmt::print("|{}", std::string(w + 2, '-'));
    fmt::print("|\n");
  }
}

}  // namespace fairway::bench
