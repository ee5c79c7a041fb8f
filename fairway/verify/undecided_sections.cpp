#include "fairway/verify/undecided_sections.hpp"

#include <cstdint>

#include "fairway/verify/section_flight.hpp"

namespace fairway {

SectionVerdicts undecided_sections(const Flow& flow, int level) {
  SectionVerdicts sections;
  const std::uint64_t step = std::uint64_t{1} << (32 - level);
  sections.first.reserve(4 * flow.grid.size() + 1);
  sections.first.push_back(0);
  for (std::size_t s = 0; s < 4 * flow.grid.size(); ++s) {
    if (is_section(flow, s)) {
      for (std::uint32_t k = 0; k < std::uint32_t{1} << level; ++k) {
        sections.begin.push_back(static_cast<std::uint32_t>(k * step));
      }
    }
    sections.first.push_back(static_cast<std::uint32_t>(sections.begin.size()));
  }
  sections.rank.assign(sections.leaves(), 0);
  sections.verdict.assign(sections.leaves(), static_cast<std::uint8_t>(Verdict::undecided));
  sections.time_s.assign(sections.leaves(), 0.0F);
  return sections;
}

}  // namespace fairway
