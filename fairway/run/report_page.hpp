// The interactive page of a run, report.html (docs/report.md).
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "fairway/base/grid.hpp"
#include "fairway/certificate/certificate.hpp"
#include "fairway/inclusion/follow_proof.hpp"
#include "fairway/plan/plan.hpp"
#include "fairway/report/page_witnesses.hpp"
#include "fairway/run/failing_flights.hpp"
#include "fairway/run/scenario_flights.hpp"
#include "fairway/vehicle/mission.hpp"
#include "fairway/verify/verdict_map.hpp"

namespace fairway {

struct ReportPage {
  std::string title;
  std::vector<std::string> words;  ///< the findings in prose
  nlohmann::json summary;          ///< without what differs from run to run
  const Certificate* certificate = nullptr;
  std::vector<FailingFlights> failing;
  const VerdictMap* contract_verdicts = nullptr;  ///< under the contract, or none
  const PageWitnesses* witnesses = nullptr;       ///< of contract_verdicts, or none
  const FollowProof* follow = nullptr;            ///< that contract_verdicts are of following
  bool exact_contract = false;                    ///< page.hpp
};

/// At how many headings the page has the exact vehicle's verdicts; it has others at some of these.
[[nodiscard]] int page_headings(const Grid& grid);

/// Writes `folder`/report.html. Empty when it did; else why this build has no page, one sentence
/// without its full stop, and nothing is written.
[[nodiscard]] std::string write_report_page(const Plan& plan, const Mission& mission,
                                            const ScenarioFlights& flown, const ReportPage& page,
                                            const std::filesystem::path& folder);

}  // namespace fairway
