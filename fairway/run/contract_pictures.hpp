// What a contract certificate says at every place, sampled: for a picture and for the page.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "fairway/certificate/contract_certificate.hpp"
#include "fairway/verify/verdict_map.hpp"

namespace fairway {

/// Verdicts of at most 64 cells across, at 8 headings; with `most_headings` of 12 or more, at 12,
/// 24, 36 or 72, the more the fewer cells there are. So few because each state is flown as a set:
/// up to 150 microseconds, where the exact vehicle takes one. No states for shares.
[[nodiscard]] VerdictMap contract_verdict_map(const ContractCertificate& certificate,
                                              int most_headings = 8);

/// Every file that write_contract_pictures writes.
[[nodiscard]] std::vector<std::string> contract_picture_files();

/// The verdicts at no more than 12 of the headings, into `folder`. `at_risk`: as in PageWitnesses;
/// none: not known.
void write_contract_pictures(const VerdictMap& map, const std::vector<std::uint8_t>* at_risk,
                             const std::string& title, const std::filesystem::path& folder);

}  // namespace fairway
