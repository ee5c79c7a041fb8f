// States that do not reach, as proved: where a plan fails, and where the proof left it undecided.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "fairway/certificate/certificate.hpp"
#include "fairway/simulate/flight.hpp"
#include "fairway/vehicle/vehicle.hpp"
#include "fairway/verify/verdict.hpp"

namespace fairway {

/// Where a state starts, in the order of how much its failure matters.
enum class StartGround : std::uint8_t {
  safe_start,  ///< a free cell (or a goal cell, with another region of interest) with a command
  buffer,      ///< a buffer cell with a command
  cut_off      ///< a cell without a command: no way to the goal
};

inline constexpr std::array start_grounds_in_order{StartGround::safe_start, StartGround::buffer,
                                                   StartGround::cut_off};

/// The name used in files.
[[nodiscard]] constexpr const char* name_of(StartGround ground) {
  constexpr const char* names[]{"safe_start", "buffer", "cut_off"};
  return names[static_cast<int>(ground)];
}

/// A state whose verdict is not `reach`.
struct FailingState {
  State start;
  Verdict verdict = Verdict::undecided;
  StartGround ground = StartGround::safe_start;
  bool flown = false;  ///< its flight failed, too; else it was sampled
};

/// By ground, then in the order of verdicts_in_order; at most `of_each` of each verdict on each
/// ground. First those of `flown`, which are the starts of flights that did not reach, then states
/// sampled from safe starts with a command, then states sampled from all ordinary cells.
[[nodiscard]] std::vector<FailingState> failing_states(const Certificate& certificate,
                                                       std::size_t of_each, std::uint64_t seed,
                                                       std::span<const State> flown = {});

/// The starts of the flights that did not reach. As many starts as results.
[[nodiscard]] std::vector<State> failing_starts(std::span<const State> starts,
                                                std::span<const FlightResult> results);

/// For `fairway simulate --states`: CSV x_m,y_m,heading_rad,verdict,start.
[[nodiscard]] std::string failing_states_csv(const std::vector<FailingState>& states);

}  // namespace fairway
