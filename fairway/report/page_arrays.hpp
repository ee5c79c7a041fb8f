// What the page draws, as arrays: the names and meanings are in docs/report.md.
#pragma once

#include <string>

#include "fairway/report/page.hpp"
#include "fairway/report/page_payload.hpp"

namespace fairway {

/// `region`, `heading`, `cost` of the plan, `streamline_*`, `contour_*`.
void add_plan_arrays(const Plan& plan, PagePayload& payload);

/// `verdict` [headings][ny][nx]: a code of Verdict, or 5 obstacle, 6 target.
void add_verdict_arrays(const VerdictMap& map, PagePayload& payload);

/// `piece_*` of all flights shown, one flight after the other, each followed by its final leg.
void add_flight_arrays(const PageContent& content, PagePayload& payload);

/// Cost steps of one U16 unit, metres; the largest finite cost is unit 65534.
[[nodiscard]] double page_cost_step_m(const Plan& plan);

/// Levels at which the cost has a contour, metres: round steps.
[[nodiscard]] std::vector<double> page_contour_levels_m(const Plan& plan);

}  // namespace fairway
