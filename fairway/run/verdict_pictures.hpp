// The pictures of a verification: verdicts by heading, shares proved, and a flight for each kind of
// failure.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "fairway/certificate/certificate.hpp"
#include "fairway/plan/plan.hpp"
#include "fairway/simulate/flight.hpp"

namespace fairway {

/// Every file that write_verdict_pictures may write.
[[nodiscard]] std::vector<std::string> verdict_picture_files();

/// The plan with the certificate's target as its goal: what its verdicts are about. It equals
/// `plan` when the certificate is about the plan's own goal.
[[nodiscard]] Plan as_verified(Plan plan, const Certificate& certificate);
/// The same by what the cells mean, [iy][ix].
[[nodiscard]] Plan as_verified(Plan plan, const std::vector<CellKind>& kind);

/// Writes NAME.svg and NAME.png into `folder` for every picture; "modes" only of a plan with
/// several, "counterexamples" only when there are some. `plan`: as verified; `counterexamples`: a
/// flight over it to each kind of failure; `seed`: of the states sampled for "proved".
void write_verdict_pictures(const Plan& plan, const Certificate& certificate,
                            std::span<const Flight> counterexamples, std::uint64_t seed,
                            const std::string& title, const std::filesystem::path& folder);

}  // namespace fairway
