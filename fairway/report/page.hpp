// A run as one self-contained HTML file that can be opened from disk (docs/report.md).
//
// The bundle of web/ has two marks, which are replaced:
//   @FAIRWAY_RECORD@   JSON of everything small: grid, mission, styles, words, numbers
//   @FAIRWAY_ARRAYS@   arrays in base64 (page_payload.hpp)
// and @FAIRWAY_TITLE@.
// Properties that always hold:
//   1. No text of a file becomes markup: `<`, `>` and `&` are escaped in the record, and the page
//      shows texts as texts.
//   2. The bytes depend only on what is shown: not on the time, the machine, or threads.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "fairway/base/frame.hpp"
#include "fairway/inclusion/follow_proof.hpp"
#include "fairway/plan/plan.hpp"
#include "fairway/report/page_witnesses.hpp"
#include "fairway/simulate/flight.hpp"
#include "fairway/vehicle/mission.hpp"
#include "fairway/verify/verdict_map.hpp"

namespace fairway {

/// Flights of one origin: "given", "random", "failing".
struct PageFlights {
  std::string group;
  std::span<const Flight> flights;  ///< recorded
  std::size_t most = 100;           ///< shown at most; the page says when there are more
  std::string ground = {};          ///< for failing ones: "safe_start", "buffer" or "cut_off"
};

struct PageContent {
  std::string title;
  const Plan& plan;
  const Mission& mission;
  std::vector<PageFlights> flights;
  const VerdictMap* verdicts = nullptr;       ///< none: nothing was proved
  std::vector<std::string> words = {};        ///< what was found, in prose, by groups
  std::string summary_json = "{}";            ///< an object: findings and warnings head the page
  std::vector<std::string> assumptions = {};  ///< what a proof rests on
  LonLatOf lon_lat = {};                      ///< none: the map is not georeferenced
  const VerdictMap* contract_verdicts = nullptr;  ///< besides `verdicts`, under a contract; or none
  const PageWitnesses* witnesses = nullptr;  ///< of contract_verdicts; none: none were searched for
  /// What contract_verdicts prove beyond `reach`: that the path is followed; or none.
  const FollowProof* follow = nullptr;
  bool exact_contract = false;  ///< contract_verdicts are about hardly more than the exact vehicle
};

/// Throws PreconditionViolation when there is no template (page_template.hpp) or arrays do not fit.
[[nodiscard]] std::string page_html(const PageContent& content);

/// The same with the caller's template.
[[nodiscard]] std::string page_html(const PageContent& content, std::string_view html);

}  // namespace fairway
