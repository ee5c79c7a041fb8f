// The result of a verification, as JSON and in words.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "fairway/run/stage_clock.hpp"
#include "fairway/run/verification.hpp"
#include "fairway/verify/verdict.hpp"

namespace fairway {

/// docs/formats.md, summary.json of verify; without times.
[[nodiscard]] nlohmann::json verification_json(const Verification& verification);

/// What was proved and what was assumed, in one paragraph.
[[nodiscard]] std::string verification_words(const Verification& verification);

/// "the proof stopped at the time limit of 20 s: 6.3 % undecided (requested: at most 0.5 %)"; empty
/// when the work ended because so little was undecided.
[[nodiscard]] std::string stopped_words(const Verification& verification);

/// A warning when a limit of time or memory ended the work before that.
[[nodiscard]] std::optional<std::string> limit_warning(const Verification& verification);

/// What the lines of findings.hpp mean and assume: lines of up to 100 characters.
[[nodiscard]] std::string proof_notes(const Verification& verification);

/// What every proof rests on, a sentence or two each; verification_words says it in one.
[[nodiscard]] const std::vector<std::string>& proof_assumptions();

/// Shares by the verdicts' names.
[[nodiscard]] nlohmann::json shares_json(const std::array<double, verdict_count>& share);

/// "verifying, 3.20 % undecided": the stage under way once a level is done.
[[nodiscard]] std::string level_words(const LevelRecord& level);

}  // namespace fairway
