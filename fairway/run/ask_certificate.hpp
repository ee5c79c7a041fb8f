// Looks up many states at once in a certificate, and every cell for one heading.
//
// Properties that always hold: those of fairway/runtime.hpp; the answers do not depend on threads.
// Cost: about a microsecond per state and core.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "fairway/base/heading.hpp"
#include "fairway/certificate/certificate.hpp"
#include "fairway/exchange/plan_rasters.hpp"
#include "fairway/runtime.hpp"
#include "fairway/vehicle/vehicle.hpp"

namespace fairway {

/// Answer [i] belongs to state [i].
[[nodiscard]] std::vector<runtime::Answer> ask(const Certificate& certificate,
                                               std::span<const State> states);

/// [iy][ix]: the verdict of the vehicle near each cell's middle with (nearly) this heading. Beside
/// the middle, as in verify/verdict_map.hpp: exactly in the middle flights meet ties that have no
/// volume. In an obstacle: collide; in the goal: reach.
[[nodiscard]] std::vector<Verdict> verdicts_at(const Certificate& certificate, Heading heading);

/// verdicts_at() each of the headings; of a plan with several modes also the one that serves a
/// state.
[[nodiscard]] std::vector<VerdictLayer> verdict_layers(const Certificate& certificate,
                                                       std::span<const Heading> headings);

/// [iy][ix]: the first mode that is proved to reach from the states of verdicts_at(), no_mode where
/// none is and in obstacles; in the goal 0.
[[nodiscard]] std::vector<std::uint8_t> modes_at(const Certificate& certificate, Heading heading);

/// The states that verdicts_at() asks for, [iy][ix].
[[nodiscard]] std::vector<State> states_asked_at(const Grid& grid, Heading heading);

}  // namespace fairway
