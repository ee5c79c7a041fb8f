// Continuing from an earlier certificate of the same proof.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

#include <nlohmann/json.hpp>

#include "fairway/certificate/certificate.hpp"
#include "fairway/verify/section_verdicts.hpp"

namespace fairway {

/// A certificate to continue from; `where` names it in errors.
struct EarlierProof {
  Certificate certificate;
  std::string where;
};

/// The fate of the earlier leaves that had a verdict.
struct Resumed {
  std::string from;
  std::size_t decided = 0;  ///< in the earlier certificate
  std::size_t dropped = 0;  ///< of these: not proved again, and undecided once more
  bool in_time = true;      ///< false: the time limit left some of them unproved
};

/// The earlier sections, every leaf proved again for `now`, whose proof they must be of; what is
/// not proved before `go_on` says no is undecided. Throws InputError{earlier.where, ...}.
[[nodiscard]] SectionVerdicts taken_over(EarlierProof earlier, const Certificate& now,
                                         int most_crossings, const std::function<bool()>& go_on,
                                         Resumed& resumed);

/// A sentence.
[[nodiscard]] std::string resumed_words(const Resumed& resumed);

/// {"from": ..., "decided_leaves": ..., "dropped_leaves": ..., "in_time": ...}
[[nodiscard]] nlohmann::json resumed_json(const Resumed& resumed);

}  // namespace fairway
