// Where a proof starts.
#pragma once

#include "fairway/verify/flow.hpp"
#include "fairway/verify/section_verdicts.hpp"

namespace fairway {

/// Sections of 2^level equal leaves, all undecided.
[[nodiscard]] SectionVerdicts undecided_sections(const Flow& flow, int level);

}  // namespace fairway
