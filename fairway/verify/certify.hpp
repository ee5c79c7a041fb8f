// The certified method: proves verdicts for all states by proving the section
// (section_flight.hpp) and refining what is left undecided.
//
// Properties that always hold:
//   1. Every verdict is proved (docs/trust.md); more work only turns undecided into proved.
//   2. The result depends only on the plan and the options, not on threads, with one exception: a
//      time limit, and the result says that the limit stopped the work.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "fairway/verify/flow.hpp"
#include "fairway/verify/section_verdicts.hpp"

namespace fairway {

struct CertifyOptions {
  double undecided_max = 0.005;        ///< of the configuration volume; stop there, [0, 1]
  double time_limit_s = 0.0;           ///< 0: none
  std::size_t memory_limit_bytes = 0;  ///< 0: none
  std::size_t samples =
      1000000;  ///< sampled states to measure volumes; at least 1000, and one per cell
  std::uint64_t seed = 1;
  int most_crossings = usual_most_crossings;  ///< of borders, in one flight to the section
  int first_level = 2;                        ///< a section starts as 2^first_level leaves
  int stall_levels = 5;                       ///< stop after so many levels without gain
  int last_level = 26;                        ///< no leaf is smaller than cell_m / 2^last_level
};

enum class StoppedBy : std::uint8_t {
  undecided_max,
  time_limit,
  memory_limit,
  last_level,
  stalled
};
const char* name_of(StoppedBy reason);

/// Shares of the configuration volume by verdict, [Verdict]; each sums to 1, or to 0 when there
/// are no such cells. Measured by proved queries of sampled states, equally many in each cell.
struct VolumeFractions {
  std::array<double, verdict_count> all{};        ///< cells that are neither obstacle nor target
  std::array<double, verdict_count> free{};       ///< of these, the safe-start cells
  std::array<double, verdict_count> commanded{};  ///< of those, with a command of the mission
  std::array<double, verdict_count> buffer{};     ///< and the buffer cells
  std::array<double, verdict_count> usable{};     ///< of all, with a command of the mission
  std::size_t samples = 0;
  double worst_time_s = 0.0;  ///< largest bound of a sampled state proved to reach
  /// [mode], of all: shares that reach by this mode and by none before it.
  std::vector<double> reach_by_mode;
};

struct LevelRecord {
  int level = 0;              ///< no leaf is narrower than cell_m / 2^level
  std::size_t leaves = 0;     ///< in all
  std::size_t undecided = 0;  ///< of these
  double undecided_volume = 0.0;
};

struct Certified {
  SectionVerdicts sections;  ///< of the first mode
  /// Of the further ones, one after another (proof_view.hpp): leaves reach, or are undecided.
  SectionVerdicts further;
  VolumeFractions volume;
  std::vector<LevelRecord> levels;
  StoppedBy stopped_by = StoppedBy::undecided_max;
};

/// Called after every level.
using CertifyProgress = std::function<void(const LevelRecord&)>;

/// `is_free[cell]`: a safe-start cell (only for the fractions). `start`: an earlier result for the
/// same flow to continue from, or empty. `further_rad`: commands of further modes, each [iy][ix]:
/// a state that the first mode does not bring reaches if a further one does.
Certified certify(const Flow& flow, const std::vector<bool>& is_free, const CertifyOptions& options,
                  SectionVerdicts start = {}, const CertifyProgress& progress = {},
                  std::span<const float* const> further_rad = {});

}  // namespace fairway
