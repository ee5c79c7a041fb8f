// The pictures of `fairway verify` under a contract, with the names of those of the exact vehicle:
// verdicts by heading, shares proved, and a flight for each kind of failure.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "fairway/certificate/contract_certificate.hpp"
#include "fairway/plan/plan.hpp"
#include "fairway/report/picture.hpp"
#include "fairway/run/contract_failures.hpp"
#include "fairway/verify/verdict_map.hpp"

namespace fairway {

/// The verdicts of a map of the certificate at each heading, states at risk among them.
[[nodiscard]] Picture picture_of_verdicts(const ContractCertificate& certificate,
                                          const VerdictMap& map, const std::string& title);

/// Writes the files that verdict_picture_files() names into `folder`; "counterexamples" only when
/// there are some. `plan`: with the certificate's target as its goal; `seed`: of the states sampled
/// for "proved", eight in each of at most 64 cells across.
void write_contract_verdict_pictures(const Plan& plan, const ContractCertificate& certificate,
                                     const NamedFlights& counterexamples, std::uint64_t seed,
                                     const std::string& title, const std::filesystem::path& folder);

}  // namespace fairway
