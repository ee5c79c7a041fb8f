// What is known of a state (docs/model.md, "Verdicts"): one of the four outcomes, proved, or
// undecided.
#pragma once

#include <cstdint>

namespace fairway {

enum class Verdict : std::uint8_t { undecided = 0, reach = 1, collide = 2, leave = 3, trapped = 4 };

inline constexpr int verdict_count = 5;

/// The name used in files and on screen.
constexpr const char* name_of(Verdict verdict) {
  constexpr const char* names[verdict_count]{"undecided", "reach", "collide", "leave", "trapped"};
  return names[static_cast<int>(verdict)];
}

}  // namespace fairway
