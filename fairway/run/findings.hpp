// The findings, one line each: a share, what it is a share of, and what happens to it. The same
// lines end a command's output, are in its summary, and are at the top of the page.
//
// The first says how many of all states reach; where more than a tenth of the free cells is cut
// off, of the states that the mission can use: those in cells with a command. What goes wrong comes
// next, bad news first, and only then the shares of states that start well. Each line has one
// denominator and names it; a share of zero has no line.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "fairway/plan/plan.hpp"
#include "fairway/run/bitmap_verification.hpp"
#include "fairway/run/scenario_flights.hpp"
#include "fairway/run/verification.hpp"
#include "fairway/verify/region_of_interest.hpp"

namespace fairway {

/// "97.0 %" of "free cells" "are cut off from the goal". Without a share: a sentence by itself.
struct Finding {
  std::string share;
  std::string of;
  std::string what;
};

/// The word for what a proof is about: "goal", "path", or "region".
[[nodiscard]] std::string goal_of(const Plan& plan, const RegionOfInterest& region);

/// "are proved to reach the goal": of a path, to reach is only to touch it.
[[nodiscard]] std::string proved_to_reach(const std::string& goal);

/// Of the plan alone: how many free cells are cut off.
[[nodiscard]] std::vector<Finding> plan_findings(const Plan& plan);

/// Of all states, of the plan's cells, what ended the work, and of the safe starts with a command.
[[nodiscard]] std::vector<Finding> findings(const Plan& plan, const Verification& verification);
[[nodiscard]] std::vector<Finding> findings(const Plan& plan,
                                            const BitmapVerification& verification);

/// Of random flights, which start in safe starts with a command, and of the scenario's own starts.
[[nodiscard]] std::vector<Finding> findings(const Plan& plan, const ScenarioFlights& flown);

/// An array of {"share", "of", "what"}.
[[nodiscard]] nlohmann::json findings_json(const std::vector<Finding>& findings);

/// Lines in columns, each ending with a newline.
[[nodiscard]] std::string findings_table(const std::vector<Finding>& findings);

}  // namespace fairway
