#include "fairway/report/draw_ceiling.hpp"

#include <algorithm>
#include <cmath>

#include "fairway/base/error.hpp"
#include "fairway/report/share_panels.hpp"

namespace fairway {
namespace {

constexpr std::size_t parts = 1000;  // of a cell's states
constexpr int most_across = 250;

CellKind kind_of(Region region) {
  if (region == Region::obstacle) return CellKind::obstacle;
  return region == Region::goal ? CellKind::target : CellKind::ordinary;
}

double kept(const VerdictMap& plan, std::size_t sample) {
  const auto reach = static_cast<std::size_t>(Verdict::reach);
  return static_cast<double>(plan.count[sample][reach]) / plan.states_per_sample;
}

}  // namespace

Picture draw_ceiling(const Ceiling& ceiling, const std::vector<Region>& region,
                     const VerdictPictureOptions& options, const VerdictMap* plan) {
  require(region.size() == ceiling.grid.size() && ceiling.levels > 0,
          "a ceiling that was found, and its cells");
  require(plan == nullptr || (plan->grid == ceiling.grid && plan->states_per_sample > 0),
          "verdicts on the same cells, of states of each");
  VerdictMap map = plan != nullptr ? *plan : VerdictMap::over(ceiling.grid, 1, most_across);
  std::vector<std::size_t> inside(map.samples());
  std::vector<std::size_t> lost(map.samples());
  for (std::size_t i = 0; i < map.samples(); ++i) {
    const std::size_t cell = ceiling.grid.index(map.cell_of_sample(i));
    map.kind[i] = kind_of(region[cell]);
    if (map.kind[i] != CellKind::ordinary) continue;
    double could = 0.0;
    double could_not = 0.0;
    for (int k = 0; k < ceiling.headings; ++k) {
      const std::size_t bin = static_cast<std::size_t>(k) * region.size() + cell;
      could += static_cast<double>(ceiling.inside[bin]) / ceiling.headings;
      could_not += static_cast<double>(ceiling.lost[bin]) / ceiling.headings;
    }
    if (plan != nullptr) could = kept(*plan, i);
    inside[i] = static_cast<std::size_t>(std::lround(could * parts));
    lost[i] = std::min(parts - inside[i], static_cast<std::size_t>(std::lround(could_not * parts)));
  }
  using Names = decltype(SharePanels::names);
  const SharePanels shares{
      plan != nullptr ? Names{"proved of this plan", "no control could", "neither"}
                      : Names{"some control could", "no control could", "between the bounds"},
      parts, "of the states of a cell", [&](std::size_t sample, std::size_t panel) {
        if (map.kind[sample] != CellKind::ordinary) return std::size_t{0};
        if (panel == 0) return inside[sample];
        if (panel == 1) return lost[sample];
        return parts - inside[sample] - lost[sample];
      }};
  return draw_share_panels(map, shares, options);
}

}  // namespace fairway
