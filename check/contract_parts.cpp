#include "check/contract_parts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include <tbb/parallel_for.h>

#include "check/tensors.hpp"

namespace fairway_check {
namespace {

using std::numbers::pi;

constexpr double reach_slack = 4.0 * touch;  // of a part's side
constexpr double arc_slack = 4.0 * angle_slack;

/// Rows of the nearest commands in a column, at or below (`step` 1) or at or above (-1) each cell.
std::vector<int> nearest_rows(const std::vector<float>& command, int nx, int ny, int step) {
  std::vector<int> row(command.size(), -1);
  for (int x = 0; x < nx; ++x) {
    int last = -1;
    for (int y = step > 0 ? 0 : ny - 1; y >= 0 && y < ny; y += step) {
      const auto i =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(nx) + static_cast<std::size_t>(x);
      if (!std::isnan(command[i])) last = y;
      row[i] = last;
    }
  }
  return row;
}

/// The commands around `first` that have been seen: as angles from it.
struct Fan {
  float first = NAN;
  double least = 0.0;
  double most = 0.0;

  void add(float command) {
    if (std::isnan(first)) first = command;
    const double turn =
        std::remainder(static_cast<double>(command) - static_cast<double>(first), 2.0 * pi);
    least = std::min(least, turn);
    most = std::max(most, turn);
  }
  /// Commands that fit into less than 180 degrees lie from `least` to `most`; others never do.
  Arc widened(double by) const {
    if (std::isnan(first) || !(most - least + 2.0 * by < pi)) return {};
    return {static_cast<double>(first) + least - by, most - least + 2.0 * by};
  }
};

/// Cells from..to (within the grid) whose closed squares are within `reach` of [low, high], all in
/// cells; and the distance along this axis.
double gap(int cell, double low, double high) {
  return std::max({0.0, low - (cell + 1), cell - high});
}

}  // namespace

Contract contract_of(const nlohmann::json& c) {
  const auto number = [&c](const char* key, double least, double most) {
    const double value = c.at(key).get<double>();
    require(value >= least && value <= most, std::string("contract: ") + key + ": out of range");
    return value;
  };
  const auto range = [&c](const char* key) {
    const auto ends = c.at(key).get<std::vector<double>>();
    require(ends.size() == 2 && ends[0] > 0.0 && ends[0] <= ends[1] && ends[1] <= 1e15,
            std::string("contract: ") + key + ": expected [least, most], both positive");
    return ends;
  };
  const std::vector<double> radius = range("turn_radius_m");
  const std::vector<double> speed = range("speed_mps");
  const double wind = number("wind_mps", 0.0, 0.999 * speed[0]);
  const double part = wind / speed[0];
  return {.command_error = number("command_error_m", 0.0, 1e15) + number("look_ahead_m", 0.0, 1e15),
          .heading_error = number("heading_error_rad", 0.0, pi),
          .estimate_error = number("command_error_m", 0.0, 1e15),
          .least_radius = radius[0] * (1.0 - part) * (1.0 - part),
          .most_radius = radius[1] * (1.0 + part) * (1.0 + part),
          .least_speed = speed[0] - wind,
          .most_speed = speed[1] + wind,
          .hold_side = number("hold_side_rad", 0.0, pi),
          .side_uncertain = number("side_uncertain_rad", 0.0, pi)};
}

std::vector<float> filled(const std::vector<float>& command_rad, int nx, int ny) {
  const std::vector<int> below = nearest_rows(command_rad, nx, ny, 1);
  const std::vector<int> above = nearest_rows(command_rad, nx, ny, -1);
  std::vector<float> all = command_rad;
  const auto index = [nx](int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(nx) + static_cast<std::size_t>(x);
  };
  tbb::parallel_for(0, ny, [&](int y) {
    for (int x = 0; x < nx; ++x) {
      if (!std::isnan(all[index(x, y)])) continue;
      std::int64_t nearest = std::numeric_limits<std::int64_t>::max();
      std::size_t from = 0;
      const auto offer = [&](int at_x, int at_y) {
        if (at_y < 0) return;
        const std::int64_t dx = at_x - x;
        const std::int64_t dy = at_y - y;
        const std::int64_t away = dx * dx + dy * dy;
        const std::size_t i = index(at_x, at_y);
        if (away > nearest || (away == nearest && i > from)) return;
        nearest = away;
        from = i;
      };
      for (int dx = 0; dx < nx && std::int64_t{dx} * dx <= nearest; ++dx) {
        for (const int at : {x - dx, x + dx}) {
          if (at < 0 || at >= nx) continue;
          offer(at, below[index(at, y)]);
          offer(at, above[index(at, y)]);
        }
      }
      if (nearest < std::numeric_limits<std::int64_t>::max()) {
        all[index(x, y)] = command_rad[from];
      }
    }
  });
  return all;
}

Parts parts_of(const Loop& loop, double cell_m, int per_cell, const Contract& contract) {
  Parts parts{.per_cell = per_cell,
              .nx = loop.nx * per_cell,
              .ny = loop.ny * per_cell,
              .side_m = cell_m / per_cell,
              .kind = {},
              .arc = {}};
  const std::size_t count = loop.kind.size() * static_cast<std::size_t>(per_cell * per_cell);
  parts.kind.resize(count);
  parts.arc.resize(count);
  const std::vector<float> command = filled(loop.command_rad, loop.nx, loop.ny);
  const double reach = contract.command_error / cell_m + reach_slack / per_cell;
  const double wide = contract.heading_error + arc_slack;
  tbb::parallel_for(0, parts.ny, [&](int y) {
    for (int x = 0; x < parts.nx; ++x) {
      const std::size_t i = parts.index({x, y});
      parts.kind[i] = loop.kind[loop.index({x / per_cell, y / per_cell})];
      if (parts.kind[i] != ordinary) continue;
      const double west = static_cast<double>(x) / per_cell;
      const double south = static_cast<double>(y) / per_cell;
      const double east = static_cast<double>(x + 1) / per_cell;
      const double north = static_cast<double>(y + 1) / per_cell;
      const auto first = [](double at) { return static_cast<int>(std::max(0.0, std::floor(at))); };
      const auto last = [](double at, int n) {
        return static_cast<int>(std::min(n - 1.0, std::floor(at)));
      };
      Fan fan;
      for (int cy = first(south - reach); cy <= last(north + reach, loop.ny); ++cy) {
        for (int cx = first(west - reach); cx <= last(east + reach, loop.nx); ++cx) {
          const double dx = gap(cx, west, east);
          const double dy = gap(cy, south, north);
          if (dx * dx + dy * dy <= reach * reach) fan.add(command[loop.index({cx, cy})]);
        }
      }
      parts.arc[i] = fan.widened(wide);
    }
  });
  return parts;
}

}  // namespace fairway_check
