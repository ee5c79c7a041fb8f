// What a page knows about verdicts besides their arrays.
#pragma once

#include <string>

#include "fairway/report/page_witnesses.hpp"
#include "fairway/verify/verdict_map.hpp"

namespace fairway {

/// One JSON object: samples, headings, and how many samples have each verdict at each heading; of a
/// plan with several modes also how many each of them serves (`mode_count`, [heading][mode]); with
/// `witnesses` also how many are at risk (`at_risk`), which are among the undecided ones.
[[nodiscard]] std::string page_verdicts_json(const VerdictMap& map,
                                             const PageWitnesses* witnesses = nullptr);

}  // namespace fairway
