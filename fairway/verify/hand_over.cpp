#include "fairway/verify/hand_over.hpp"

#include "fairway/verify/ask_modes.hpp"
#include "fairway/verify/section_flight.hpp"

namespace fairway {
HandOver hand_over(const Flow& flow, LeafPlace leaf, std::span<const ModeView> earlier,
                   int most_crossings, ModeSet asked) {
  constexpr auto reaches = static_cast<std::uint8_t>(1U << static_cast<unsigned>(Verdict::reach));
  Front front = front_of_section(flow, leaf.section, along_of(leaf.range, flow.grid.cell_m));
  front.hop = {};  // the section is not one of the earlier mode's
  most_crossings = crossings_worth(leaf.range, most_crossings);
  HandOver answer;
  for (std::size_t k = 0; k < earlier.size(); ++k) {
    const ModeSet this_one = ModeSet{1} << k;
    if ((asked & this_one) == 0) continue;
    asked_modes::Reader reader{earlier[k].flow, earlier[k].sections, {}};
    follow_to_section(earlier[k].flow, front, most_crossings, reader);
    if (reader.found.only() == Verdict::reach) {
      return {static_cast<std::uint8_t>(k), reader.found.time_s, false};
    }
    const bool some = (reader.found.bits & reaches) != 0;
    answer.in_part = answer.in_part || some;
    // What gave up did not see all: a part may come further.
    if (some || reader.gave_up) answer.worth_asking |= this_one;
  }
  return answer;
}

}  // namespace fairway
