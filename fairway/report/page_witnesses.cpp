#include "fairway/report/page_witnesses.hpp"

#include <algorithm>
#include <span>

#include "fairway/base/error.hpp"
#include "fairway/report/page_arrays.hpp"

namespace fairway {
namespace {

/// The cell of a place; of one outside the grid, the nearest.
std::uint32_t cell_code(const Grid& grid, Vec2 place) {
  const Cell cell = grid.cell_of(place);
  return static_cast<std::uint32_t>(
      grid.index({std::clamp(cell.ix, 0, grid.nx - 1), std::clamp(cell.iy, 0, grid.ny - 1)}));
}

}  // namespace

void add_witness_arrays(const VerdictMap& map, const PageWitnesses& witnesses,
                        PagePayload& payload) {
  const std::size_t headings = map.heading_rad.size();
  require(witnesses.at_risk.size() == headings * map.samples(),
          "states at risk are those of the verdict map");
  std::vector<std::uint8_t> count(map.samples());
  for (std::size_t k = 0; k < witnesses.at_risk.size(); ++k) {
    count[k % map.samples()] += witnesses.at_risk[k];
  }
  payload.add("contract_at_risk_count",
              {static_cast<std::size_t>(map.ny), static_cast<std::size_t>(map.nx)},
              std::span<const std::uint8_t>(count));

  std::vector<std::uint32_t> sample, begin{0}, cell;
  std::vector<std::uint8_t> heading, end;
  std::vector<float> length_m, curvature_per_m;
  std::vector<std::uint16_t> command;
  for (const PageWitness& witness : witnesses.shown) {
    require(witness.heading < headings && witness.sample < map.samples(),
            "a witness starts in a sampled state");
    sample.push_back(static_cast<std::uint32_t>(witness.sample));
    heading.push_back(static_cast<std::uint8_t>(witness.heading));
    end.push_back(static_cast<std::uint8_t>(witness.end));
    for (const ExplainedStep& step : witness.behaviour.steps) {
      length_m.push_back(static_cast<float>(step.length_m));
      curvature_per_m.push_back(step.turn == 0 ? 0.0F
                                               : static_cast<float>(step.turn / step.radius_m));
      command.push_back(page_turn_code(step.command_rad));
      cell.push_back(cell_code(map.grid, step.command_m));
    }
    begin.push_back(static_cast<std::uint32_t>(length_m.size()));
  }
  const auto add_u32 = [&](const char* name, const std::vector<std::uint32_t>& values) {
    payload.add(name, {values.size()}, std::span<const std::uint32_t>(values), PageFilter::delta);
  };
  add_u32("witness_sample", sample);
  payload.add("witness_heading", {heading.size()}, std::span<const std::uint8_t>(heading));
  payload.add("witness_end", {end.size()}, std::span<const std::uint8_t>(end));
  add_u32("witness_begin", begin);
  payload.add("witness_length_m", {length_m.size()}, length_m);
  payload.add("witness_curvature_per_m", {curvature_per_m.size()}, curvature_per_m);
  payload.add("witness_command", {command.size()}, std::span<const std::uint16_t>(command),
              PageFilter::delta);
  add_u32("witness_cell", cell);
}

}  // namespace fairway
