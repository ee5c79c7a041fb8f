// The arrays that the page draws; their names and meanings are in docs/report.md.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "fairway/report/page.hpp"
#include "fairway/report/page_payload.hpp"
#include "fairway/report/page_witnesses.hpp"
#include "fairway/vehicle/modes.hpp"
#include "fairway/verify/verdict.hpp"

namespace fairway {

/// The cells whose values the page carries: the middle one of each block of cells_per_value^2 cells
/// (of those on the grid), so that the page of the largest plan stays small.
struct PageValues {
  int cells_per_value = 1;
  int nx = 0;
  int ny = 0;
  Cell cell_of(int ix, int iy, const Grid& grid) const;
};
[[nodiscard]] PageValues page_values(const Grid& grid);

/// `region`, `heading`, `cost` of the plan, `streamline_*`, `contour_*`.
void add_plan_arrays(const Plan& plan, PagePayload& payload);

/// Codes of the array `verdict` where there are no states, distinct from any verdict's.
inline constexpr std::uint8_t page_obstacle = 250;
inline constexpr std::uint8_t page_target = 249;
/// Undecided, and a behaviour within the contract is known that fails.
inline constexpr std::uint8_t page_at_risk = 248;
static_assert(verdict_count <= page_at_risk && most_modes <= page_at_risk);

/// `tube_*`: the outline of the proved tube about the path.
void add_tube_arrays(const FollowProof& proof, const Grid& grid, PagePayload& payload);

/// NAME [headings][ny][nx]: a code of Verdict, page_obstacle, page_target or, with `witnesses`,
/// page_at_risk; and NAME_count, in which states at risk are among the undecided ones.
void add_verdict_arrays(const VerdictMap& map, PagePayload& payload,
                        const std::string& name = "verdict",
                        const PageWitnesses* witnesses = nullptr);

/// Of a plan with several modes: `mode` [headings][ny][nx], the first mode that is proved to reach,
/// 255 where none is, page_obstacle or page_target; `mode_heading` [modes after the first][ny][nx],
/// their commands at the samples (page_mode_turn_code). Nothing when the map has no modes.
void add_mode_arrays(const VerdictMap& map, const Plan& plan, PagePayload& payload);

/// A heading in 255ths of a turn, below 255; 255: no command.
[[nodiscard]] std::uint8_t page_mode_turn_code(double heading_rad);

/// A heading in 65535ths of a turn, below 65535.
[[nodiscard]] std::uint16_t page_turn_code(double heading_rad);

/// `piece_*` of all flights shown, one flight after the other, each followed by its final leg.
void add_flight_arrays(const PageContent& content, PagePayload& payload);

/// Cost steps of one U16 unit, metres; the largest finite cost is unit 65534.
[[nodiscard]] double page_cost_step_m(const Plan& plan);

/// Levels at which the cost has a contour, metres: round steps.
[[nodiscard]] std::vector<double> page_contour_levels_m(const Plan& plan);

}  // namespace fairway
