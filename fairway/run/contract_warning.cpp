#include "fairway/run/contract_warning.hpp"

#include <algorithm>
#include <bitset>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "fairway/base/heading.hpp"
#include "fairway/base/number_text.hpp"
#include "fairway/base/parallel.hpp"
#include "fairway/vehicle/filled_commands.hpp"

namespace fairway {
namespace {

constexpr int degrees = 360;
using Commands = std::bitset<degrees>;

/// The smallest arc that holds them, in degrees.
int width_of(const Commands& commands) {
  int first = 0;
  while (first < degrees && !commands[static_cast<std::size_t>(first)]) ++first;
  int gap = 0;
  int since = 0;
  for (int i = first + 1; i <= first + degrees; ++i) {
    ++since;
    if (!commands[static_cast<std::size_t>(i % degrees)]) continue;
    gap = std::max(gap, since);
    since = 0;
  }
  return degrees - gap;
}

/// Commands of all cells, to the degree; -1 for none.
std::vector<int> whole_degrees(const Plan& plan) {
  std::vector<int> all;
  for (const float command : filled_commands(plan.grid, plan.heading_rad.data())) {
    const double angle = static_cast<double>(command) * (180.0 / pi) + 180.0;
    all.push_back(std::isnan(command) ? -1 : static_cast<int>(angle) % degrees);
  }
  return all;
}

bool is_wild(const Grid& grid, const std::vector<int>& command, Cell cell, double error_m,
             double widest_deg) {
  // From the middle of the cell to the near side of another.
  const double reach = error_m / grid.cell_m;
  const auto apart = [](int between) { return std::max(0.0, std::abs(between) - 0.5); };
  const int far = static_cast<int>(std::min(reach + 0.5, 1e6));
  Commands allowed;
  for (int iy = std::max(0, cell.iy - far); iy <= std::min(grid.ny - 1, cell.iy + far); ++iy) {
    for (int ix = std::max(0, cell.ix - far); ix <= std::min(grid.nx - 1, cell.ix + far); ++ix) {
      if (std::hypot(apart(ix - cell.ix), apart(iy - cell.iy)) > reach) continue;
      const int degree = command[grid.index({ix, iy})];
      if (degree < 0) return true;  // no cell has a command
      allowed.set(static_cast<std::size_t>(degree));
    }
    if (allowed.any() && width_of(allowed) >= widest_deg) return true;
  }
  return false;
}

double wild_share(const Plan& plan, const std::vector<int>& command, double error_m,
                  double widest_deg) {
  std::vector<std::size_t> cells;
  for (std::size_t i = 0; i < plan.grid.size(); ++i) {
    if (plan.region[i] == Region::free || plan.region[i] == Region::buffer) cells.push_back(i);
  }
  if (cells.empty()) return 0.0;
  constexpr std::size_t most = 2000;
  const std::size_t asked = std::min(cells.size(), most);
  std::vector<std::uint8_t> wild(asked);
  for_ranges(asked, 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const Cell cell = plan.grid.cell_at(cells[k * cells.size() / asked]);
      wild[k] = is_wild(plan.grid, command, cell, error_m, widest_deg) ? 1 : 0;
    }
  });
  return static_cast<double>(std::count(wild.begin(), wild.end(), 1)) / static_cast<double>(asked);
}

/// Between commands; wider, and the part is wild (inclusion/parts.hpp).
double widest_deg(const VehicleContract& c) {
  const double widest = std::min(pi - c.side_uncertain_rad, 2.0 * c.hold_side_rad);
  return (widest - 2.0 * c.heading_error_rad) * (180.0 / pi);
}

/// One that leaves at most a hundredth of the cells wild.
double error_that_would_do(const Plan& plan, const VehicleContract& contract,
                           const std::vector<int>& command) {
  constexpr double hardly = 0.01;
  double low = 0.0;
  double high = contract.command_error_m + contract.look_ahead_m;
  constexpr int halvings = 12;
  for (int i = 0; i < halvings; ++i) {
    const double middle = 0.5 * (low + high);
    (wild_share(plan, command, middle, widest_deg(contract)) <= hardly ? low : high) = middle;
  }
  return low;
}

}  // namespace

double wild_share(const Plan& plan, const VehicleContract& contract) {
  return wild_share(plan, whole_degrees(plan), contract.command_error_m + contract.look_ahead_m,
                    widest_deg(contract));
}

bool is_wild_everywhere(const Plan& plan, const VehicleContract& contract) {
  return wild_share(plan, contract) >= 1.0;
}

std::optional<std::string> contract_warning(const Plan& plan, const VehicleContract& contract) {
  const double share = wild_share(plan, contract);
  if (share <= most_wild_unwarned) return std::nullopt;
  const bool looks_ahead = contract.look_ahead_m > 0.0;
  std::string warning = fmt::format(
      "The contract is too wide for this plan: at {} of the cells it allows commands so far apart "
      "that a vehicle may turn either way, and nothing can be proved there. command_error_m{} is "
      "{:g} m, which mixes the commands of many cells",
      whole_percent_text(share), looks_ahead ? " and look_ahead_m together" : "",
      contract.command_error_m + contract.look_ahead_m);
  const double enough = error_that_would_do(plan, contract, whole_degrees(plan));
  if (enough <= 0.0) return warning + ".";
  return warning +
         fmt::format("; {:g} m would leave hardly any such cell.", rounded_down(enough, 2));
}

}  // namespace fairway
