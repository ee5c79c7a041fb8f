// Re-proves leaves from outside: what an earlier certificate says is taken over only where the rule
// of docs/trust.md holds, leaf by leaf. About as much work as the checker's.
//
// Properties that always hold, whatever the leaves claim: those of section_verdicts.hpp for the
// result. A leaf of a correct certificate of the same flow keeps its verdict, rank and time.
#pragma once

#include <functional>

#include "fairway/verify/flow.hpp"
#include "fairway/verify/section_verdicts.hpp"

namespace fairway {

/// Whether the sections that have leaves match the flow.
[[nodiscard]] bool sections_fit(const Flow& flow, const SectionVerdicts& sections);

/// Returns `claimed` after making undecided every decided leaf for which the rule does not hold,
/// given the leaves that remain. Requires sections_fit(). What is not flown
/// once `go_on` returns false is undecided, too.
[[nodiscard]] SectionVerdicts reproved(
    const Flow& flow, SectionVerdicts claimed, int most_crossings,
    const std::function<bool()>& go_on = [] { return true; });

}  // namespace fairway
