// What is known about a state (docs/model.md): what its flights do, proved, or undecided. The names
// of verdicts, which ones are failures, and their order in lists are defined only here.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace fairway {

enum class Verdict : std::uint8_t {
  undecided = 0,
  reach = 1,
  collide = 2,
  leave = 3,
  trapped = 4,
  follow = 5,
  hold = 6
};

inline constexpr int verdict_count = 7;
/// Leaves of certificates store only the first ones; the others are told of states.
inline constexpr int stored_verdict_count = 5;

/// The order in which pictures, sentences and the page list them.
inline constexpr std::array<Verdict, verdict_count> verdicts_in_order{
    Verdict::reach, Verdict::follow,  Verdict::hold,     Verdict::collide,
    Verdict::leave, Verdict::trapped, Verdict::undecided};

/// Not every plan has states that follow or hold: lists have those only where some state does.
constexpr bool is_listed(Verdict verdict, bool some) {
  return some || (verdict != Verdict::follow && verdict != Verdict::hold);
}

/// The name used in files and on screen.
constexpr const char* name_of(Verdict verdict) {
  constexpr const char* names[verdict_count]{"undecided", "reach",  "collide", "leave",
                                             "trapped",   "follow", "hold"};
  return names[static_cast<int>(verdict)];
}

/// Proved not to do what the mission asks, nor to be safe for ever in a holding place.
constexpr bool fails(Verdict verdict) {
  return verdict == Verdict::collide || verdict == Verdict::leave || verdict == Verdict::trapped;
}
constexpr bool is_safe(Verdict verdict) { return !fails(verdict) && verdict != Verdict::undecided; }

}  // namespace fairway
