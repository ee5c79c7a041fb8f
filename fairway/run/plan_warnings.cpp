#include "fairway/run/plan_warnings.hpp"

#include <variant>

#include <fmt/format.h>

#include "fairway/run/share_text.hpp"
#include "fairway/run/summary.hpp"

namespace fairway {

std::optional<std::string> cut_off_warning(const Plan& plan, const std::string& remedy) {
  const RegionCells cells = count_regions(plan);
  if (static_cast<double>(cells.unreachable) <=
      most_cut_off_unwarned * static_cast<double>(cells.free)) {
    return std::nullopt;
  }
  const std::string warning = fmt::format(
      "{} of the free cells ({} of {}) are cut off from the {}: no way through free cells leads "
      "there, so they have no command, and a vehicle there flies straight on.",
      percent_text(cells.unreachable, cells.free), grouped(cells.unreachable), grouped(cells.free),
      goal_word(plan));
  return remedy.empty() ? warning : warning + " " + remedy;
}

std::vector<std::string> plan_warnings(const ObstacleMap& map, const Plan& plan) {
  std::vector<std::string> warnings = map.warnings;
  if (auto warning = cut_off_warning(plan)) warnings.push_back(std::move(*warning));
  return warnings;
}

}  // namespace fairway
