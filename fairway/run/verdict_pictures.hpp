// The pictures of a verification: verdicts by heading, shares proved, and a flight for each kind of
// failure.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "fairway/plan/plan.hpp"
#include "fairway/run/verification.hpp"

namespace fairway {

/// Every file that write_verdict_pictures may write.
[[nodiscard]] std::vector<std::string> verdict_picture_files();

/// Writes NAME.svg and NAME.png into `folder` for every picture; "counterexamples" only when there
/// are failing states. Of these, `failing`, it shows the longest flight to each failure: the one
/// whose end is the least to be seen from its start. `seed`: of the states sampled for "proved".
void write_verdict_pictures(const Plan& plan, const Certificate& certificate,
                            const std::vector<FailingState>& failing, std::uint64_t seed,
                            const std::string& title, const std::filesystem::path& folder);

}  // namespace fairway
