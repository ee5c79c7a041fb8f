// Leaves from outside, proved again: what an earlier certificate says is taken over only where the
// rule of docs/trust.md holds, leaf by leaf. About as much work as the checker's.
//
// Properties that always hold, whatever the leaves claim: those of section_verdicts.hpp for the
// answer. A leaf of an honest certificate of the same flow keeps its verdict, rank and time.
#pragma once

#include <functional>

#include "fairway/verify/flow.hpp"
#include "fairway/verify/section_verdicts.hpp"

namespace fairway {

/// Whether the sections that have leaves are those of the flow.
[[nodiscard]] bool sections_fit(const Flow& flow, const SectionVerdicts& sections);

/// `claimed` with every decided leaf undecided for which the rule does not hold, given the others
/// that are left. The sections fit. What is not flown once `go_on` says no is undecided, too.
[[nodiscard]] SectionVerdicts reproved(
    const Flow& flow, SectionVerdicts claimed, int most_crossings,
    const std::function<bool()>& go_on = [] { return true; });

}  // namespace fairway
