// A bitmap's answer for a state. Not a verdict: samples say nothing certain about the states
// between them, so it has its own words.
#pragma once

#include <array>
#include <cstdint>

namespace fairway {

/// Codes are written to files: add, never renumber.
enum class Sampled : std::uint8_t {
  undecided = 0,  ///< the samples around the state disagree
  reach = 1,      ///< they all reach the region
  other = 2  ///< none does: they collide, leave, or fly for ever; a bitmap cannot distinguish these
};
inline constexpr int sampled_count = 3;
inline constexpr std::array<Sampled, sampled_count> sampled_in_order{Sampled::reach, Sampled::other,
                                                                     Sampled::undecided};

constexpr const char* name_of(Sampled answer) {
  switch (answer) {
    case Sampled::reach:
      return "sampled_reach";
    case Sampled::other:
      return "sampled_other";
    case Sampled::undecided:
      break;
  }
  return "undecided";
}

}  // namespace fairway
