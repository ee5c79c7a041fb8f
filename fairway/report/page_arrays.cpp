#include "fairway/report/page_arrays.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "fairway/base/error.hpp"
#include "fairway/base/heading.hpp"
#include "fairway/report/contours.hpp"
#include "fairway/report/streamlines.hpp"
#include "fairway/report/tube_outline.hpp"

namespace fairway {
namespace {

constexpr std::uint16_t none = 65535;

/// Lines on the grid, places as shares of its width and height in 65535ths.
struct GridLines {
  std::vector<std::uint16_t> x;
  std::vector<std::uint16_t> y;
  std::vector<std::uint32_t> begin;  // and the end of the last

  void add_to(PagePayload& payload, const std::string& name) const {
    std::vector<std::uint32_t> begins = begin;
    begins.push_back(static_cast<std::uint32_t>(x.size()));
    payload.add(name + "_x", {x.size()}, std::span<const std::uint16_t>(x), PageFilter::delta);
    payload.add(name + "_y", {y.size()}, std::span<const std::uint16_t>(y), PageFilter::delta);
    payload.add(name + "_begin", {begins.size()}, std::span<const std::uint32_t>(begins),
                PageFilter::delta);
  }
};

std::uint16_t share(double value, double of) {
  return static_cast<std::uint16_t>(std::lround(65535.0 * std::clamp(value / of, 0.0, 1.0)));
}

/// Leaves out vertices nearer than `tolerance` to the chord over them.
std::vector<Vec2> without_straight_vertices(const std::vector<Vec2>& line, double tolerance) {
  constexpr std::size_t longest_look_back = 64;
  std::vector<Vec2> kept{line.front()};
  std::size_t anchor = 0;
  for (std::size_t i = 1; i + 1 < line.size(); ++i) {
    const Vec2 chord = line[i + 1] - line[anchor];
    bool needed = i - anchor >= longest_look_back;
    for (std::size_t k = anchor + 1; k <= i && !needed; ++k) {
      needed = std::abs(cross(chord, line[k] - line[anchor])) > tolerance * norm(chord);
    }
    if (!needed) continue;
    kept.push_back(line[i]);
    anchor = i;
  }
  kept.push_back(line.back());
  return kept;
}

void add_streamlines(const Plan& plan, PagePayload& payload) {
  GridLines lines;
  const Grid& g = plan.grid;
  const double longer_m = std::max(g.width_m(), g.height_m());
  constexpr int across = 45;
  const auto field = longer_m > 0.0 ? evenly_spaced_streamlines(plan, longer_m / across)
                                    : std::vector<std::vector<Vec2>>{};
  for (const auto& line : field) {
    lines.begin.push_back(static_cast<std::uint32_t>(lines.x.size()));
    for (const Vec2 p : without_straight_vertices(line, longer_m / 10000.0)) {
      lines.x.push_back(share(p.x - g.x0_m, g.width_m()));
      lines.y.push_back(share(p.y - g.y0_m, g.height_m()));
    }
  }
  lines.add_to(payload, "streamline");
}

void add_contours(const Plan& plan, PagePayload& payload) {
  GridLines lines;
  const Grid& g = plan.grid;
  std::vector<float> levels;
  for (const double level_m : page_contour_levels_m(plan)) {
    for (const auto& line : contour_lines(g.nx, g.ny, plan.cost_m, level_m)) {
      lines.begin.push_back(static_cast<std::uint32_t>(lines.x.size()));
      levels.push_back(static_cast<float>(level_m));
      for (const Vec2 p : without_straight_vertices(line, std::max(g.nx, g.ny) / 5000.0)) {
        lines.x.push_back(share(p.x + 0.5, g.nx));
        lines.y.push_back(share(p.y + 0.5, g.ny));
      }
    }
  }
  lines.add_to(payload, "contour");
  payload.add("contour_level_m", {levels.size()}, levels);
}

double largest_finite_cost_m(const Plan& plan) {
  float largest = 0.0F;
  for (const float cost : plan.cost_m) {
    if (std::isfinite(cost)) largest = std::max(largest, cost);
  }
  return static_cast<double>(largest);
}

int middle(int block, int per, int cells) {
  const int begin = block * per;
  return begin + (std::min(begin + per, cells) - begin) / 2;
}

}  // namespace

Cell PageValues::cell_of(int ix, int iy, const Grid& grid) const {
  return {middle(ix, cells_per_value, grid.nx), middle(iy, cells_per_value, grid.ny)};
}

PageValues page_values(const Grid& grid) {
  constexpr int most_across = 1024;
  const int per = std::max(1, (std::max(grid.nx, grid.ny) + most_across - 1) / most_across);
  return {per, (grid.nx + per - 1) / per, (grid.ny + per - 1) / per};
}

double page_cost_step_m(const Plan& plan) {
  const double largest_m = largest_finite_cost_m(plan);
  return largest_m > 0.0 ? largest_m / (none - 1) : 1.0;
}

std::vector<double> page_contour_levels_m(const Plan& plan) {
  const double largest_m = largest_finite_cost_m(plan);
  if (!(largest_m > 0.0)) return {};
  constexpr double wanted = 12.0;
  double step_m = std::pow(10.0, std::floor(std::log10(largest_m / wanted)));
  for (const double times : {2.0, 2.5, 2.0}) {  // 1, 2, 5, 10
    if (largest_m / step_m > wanted) step_m *= times;
  }
  std::vector<double> levels;
  for (int k = 1; k * step_m < largest_m; ++k) levels.push_back(k * step_m);
  return levels;
}

std::uint16_t page_turn_code(double heading_rad) {
  const double turns = heading_rad / two_pi;
  return static_cast<std::uint16_t>(std::lround((turns < 0.0 ? turns + 1.0 : turns) * none) % none);
}

std::uint8_t page_mode_turn_code(double heading_rad) {
  constexpr int no_command = 255;
  if (!std::isfinite(heading_rad)) return no_command;
  const double turns = heading_rad / two_pi;
  const long code = std::lround((turns - std::floor(turns)) * no_command);
  return static_cast<std::uint8_t>(code % no_command);
}

void add_plan_arrays(const Plan& plan, PagePayload& payload) {
  const Grid& g = plan.grid;
  require(plan.heading_rad.size() == g.size() && plan.cost_m.size() == g.size() &&
              plan.region.size() == g.size(),
          "a plan's arrays have the size of its grid");
  const double step_m = page_cost_step_m(plan);
  const PageValues values = page_values(g);
  const auto nx = static_cast<std::size_t>(values.nx);
  const auto ny = static_cast<std::size_t>(values.ny);
  std::vector<std::uint8_t> region(nx * ny);
  std::vector<std::uint16_t> heading(nx * ny);
  std::vector<std::uint16_t> cost(nx * ny);
  for (std::size_t k = 0; k < nx * ny; ++k) {
    const std::size_t i =
        g.index(values.cell_of(static_cast<int>(k % nx), static_cast<int>(k / nx), g));
    region[k] = static_cast<std::uint8_t>(static_cast<int>(plan.region[i]) + 1);
    const auto heading_rad = static_cast<double>(plan.heading_rad[i]);
    heading[k] = std::isfinite(heading_rad) ? page_turn_code(heading_rad) : none;
    cost[k] = std::isfinite(plan.cost_m[i])
                  ? static_cast<std::uint16_t>(std::lround(plan.cost_m[i] / step_m))
                  : none;
  }
  payload.add("region", {ny, nx}, std::span<const std::uint8_t>(region));
  payload.add("heading", {ny, nx}, std::span<const std::uint16_t>(heading), PageFilter::delta);
  payload.add("cost", {ny, nx}, std::span<const std::uint16_t>(cost), PageFilter::delta);
  add_streamlines(plan, payload);
  add_contours(plan, payload);
}

void add_tube_arrays(const FollowProof& proof, const Grid& g, PagePayload& payload) {
  GridLines lines;
  const double step_m = 0.25 * g.cell_m;
  for (const auto& line : tube_outline(proof, step_m)) {
    lines.begin.push_back(static_cast<std::uint32_t>(lines.x.size()));
    for (const Vec2 p : without_straight_vertices(line, 0.1 * step_m)) {
      lines.x.push_back(share(p.x - g.x0_m, g.width_m()));
      lines.y.push_back(share(p.y - g.y0_m, g.height_m()));
    }
  }
  lines.add_to(payload, "tube");
}

void add_verdict_arrays(const VerdictMap& map, PagePayload& payload, const std::string& name,
                        const PageWitnesses* witnesses) {
  std::vector<std::uint8_t> code(map.heading_rad.size() * map.samples());
  require(map.kind.size() == map.samples() && map.verdict.size() == code.size(),
          "a verdict map's arrays fit its samples and headings");
  require(witnesses == nullptr || witnesses->at_risk.size() == code.size(),
          "states at risk are those of the verdict map");
  for (std::size_t h = 0; h < map.heading_rad.size(); ++h) {
    for (std::size_t i = 0; i < map.samples(); ++i) {
      code[h * map.samples() + i] = map.kind[i] == CellKind::obstacle ? page_obstacle
                                    : map.kind[i] == CellKind::target
                                        ? page_target
                                        : static_cast<std::uint8_t>(map.verdict_at(h, i));
    }
  }
  for (std::size_t k = 0; witnesses != nullptr && k < code.size(); ++k) {
    if (witnesses->at_risk[k] != 0) code[k] = page_at_risk;
  }
  payload.add_layers(
      name,
      {map.heading_rad.size(), static_cast<std::size_t>(map.ny), static_cast<std::size_t>(map.nx)},
      code);
  // For each sample, the number of headings with each verdict; a byte holds up to 255 headings.
  require(map.heading_rad.size() <= 255, "a page has at most 255 headings");
  std::vector<std::uint8_t> count(verdict_count * map.samples());
  for (std::size_t h = 0; h < map.heading_rad.size(); ++h) {
    for (std::size_t i = 0; i < map.samples(); ++i) {
      if (map.kind[i] != CellKind::ordinary) continue;
      ++count[static_cast<std::size_t>(map.verdict_at(h, i)) * map.samples() + i];
    }
  }
  payload.add(name + "_count",
              {verdict_count, static_cast<std::size_t>(map.ny), static_cast<std::size_t>(map.nx)},
              std::span<const std::uint8_t>(count));
}

void add_mode_arrays(const VerdictMap& map, const Plan& plan, PagePayload& payload) {
  if (map.mode.empty()) return;
  require(
      map.kind.size() == map.samples() && map.mode.size() == map.heading_rad.size() * map.samples(),
      "a verdict map's arrays fit its samples and headings");
  const auto nx = static_cast<std::size_t>(map.nx);
  const auto ny = static_cast<std::size_t>(map.ny);
  std::vector<std::uint8_t> code(map.mode.size());
  for (std::size_t k = 0; k < code.size(); ++k) {
    const CellKind kind = map.kind[k % map.samples()];
    code[k] = kind == CellKind::obstacle ? page_obstacle
              : kind == CellKind::target ? page_target
                                         : map.mode[k];
  }
  payload.add_layers("mode", {map.heading_rad.size(), ny, nx}, code);
  const std::size_t further = plan.further_modes();
  require(further + 1 == static_cast<std::size_t>(map.modes), "the verdicts are the plan's");
  std::vector<std::uint8_t> heading(further * map.samples());
  for (std::size_t mode = 0; mode < further; ++mode) {
    const float* field = plan.mode_heading_rad.data() + mode * plan.grid.size();
    for (std::size_t i = 0; i < map.samples(); ++i) {
      const auto rad = static_cast<double>(field[plan.grid.index(map.cell_of_sample(i))]);
      heading[mode * map.samples() + i] = page_mode_turn_code(rad);
    }
  }
  payload.add_layers("mode_heading", {further, ny, nx}, heading);
}

void add_flight_arrays(const PageContent& content, PagePayload& payload) {
  std::vector<float> x_m, y_m, heading_rad, length_m, curvature_per_m;
  const Grid& g = content.plan.grid;
  const auto add = [&](const std::vector<FlightSegment>& pieces) {
    for (const FlightSegment& piece : pieces) {
      x_m.push_back(static_cast<float>(piece.start.position_m.x - g.x0_m));
      y_m.push_back(static_cast<float>(piece.start.position_m.y - g.y0_m));
      heading_rad.push_back(static_cast<float>(piece.start.heading.rad()));
      length_m.push_back(static_cast<float>(piece.length_m));
      curvature_per_m.push_back(static_cast<float>(piece.curvature_per_m));
    }
  };
  for (const PageFlights& group : content.flights) {
    for (const Flight& flight : group.flights.first(std::min(group.most, group.flights.size()))) {
      add(flight.segments);
      add(flight.final_leg.segments);
    }
  }
  payload.add("piece_x_m", {x_m.size()}, x_m);
  payload.add("piece_y_m", {y_m.size()}, y_m);
  payload.add("piece_heading_rad", {heading_rad.size()}, heading_rad);
  payload.add("piece_length_m", {length_m.size()}, length_m);
  payload.add("piece_curvature_per_m", {curvature_per_m.size()}, curvature_per_m);
}

}  // namespace fairway
