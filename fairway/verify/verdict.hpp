// What is known about a state (docs/model.md): one of the four outcomes, proved, or undecided. The
// names of verdicts, which ones are failures, and their order in lists are defined only here.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace fairway {

enum class Verdict : std::uint8_t { undecided = 0, reach = 1, collide = 2, leave = 3, trapped = 4 };

inline constexpr int verdict_count = 5;

/// The order in which pictures, sentences and the page list them.
inline constexpr std::array<Verdict, verdict_count> verdicts_in_order{
    Verdict::reach, Verdict::collide, Verdict::leave, Verdict::trapped, Verdict::undecided};

/// The name used in files and on screen.
constexpr const char* name_of(Verdict verdict) {
  constexpr const char* names[verdict_count]{"undecided", "reach", "collide", "leave", "trapped"};
  return names[static_cast<int>(verdict)];
}

/// Proved not to reach.
constexpr bool fails(Verdict verdict) {
  return verdict != Verdict::reach && verdict != Verdict::undecided;
}

}  // namespace fairway
