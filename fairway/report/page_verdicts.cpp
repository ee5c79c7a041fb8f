#include "fairway/report/page_verdicts.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

namespace fairway {
namespace {

/// [heading][mode]: how many samples each mode serves.
std::vector<std::vector<std::size_t>> mode_counts(const VerdictMap& map) {
  std::vector<std::vector<std::size_t>> counts(
      map.heading_rad.size(), std::vector<std::size_t>(static_cast<std::size_t>(map.modes)));
  for (std::size_t h = 0; h < counts.size(); ++h) {
    for (std::size_t i = 0; i < map.samples(); ++i) {
      const std::uint8_t mode = map.mode_at(h, i);
      if (map.kind[i] == CellKind::ordinary && mode < counts[h].size()) ++counts[h][mode];
    }
  }
  return counts;
}

}  // namespace

std::string page_verdicts_json(const VerdictMap& map, const PageWitnesses* witnesses) {
  using nlohmann::json;
  // The offset of place_m() from the middle of a cell, which is the same for all.
  const Vec2 middle = map.grid.center(map.cell_of_sample(0));
  const Vec2 offset = map.place_m(0) - middle;
  json counts = json::array();
  for (std::size_t h = 0; h < map.heading_rad.size(); ++h) {
    std::array<std::size_t, verdict_count> count{};
    for (std::size_t i = 0; i < map.samples(); ++i) {
      if (map.kind[i] == CellKind::ordinary)
        ++count[static_cast<std::size_t>(map.verdict_at(h, i))];
    }
    counts.push_back(count);
  }
  json info = {{"nx", map.nx},
               {"ny", map.ny},
               {"cells_per_sample", map.cells_per_sample},
               {"heading_rad", map.heading_rad},
               {"offset_m", {offset.x, offset.y}},
               {"count", std::move(counts)}};
  if (!map.mode.empty()) info["mode_count"] = mode_counts(map);
  if (witnesses != nullptr) {
    std::vector<std::size_t> at_risk(map.heading_rad.size());
    for (std::size_t k = 0; k < witnesses->at_risk.size(); ++k) {
      at_risk[k / map.samples()] += witnesses->at_risk[k];
    }
    info["at_risk"] = at_risk;
    info["not_searched"] = witnesses->not_searched;
  }
  return info.dump();
}

}  // namespace fairway
