// What is proved of single states of a plan with modes: queries.
//
// Properties that always hold: docs/trust.md; no heap, no exceptions. Cost: that of a flight to the
// section for each mode that is asked, mostly less than half a microsecond.
#pragma once

#include <limits>

#include "fairway/verify/flow.hpp"
#include "fairway/verify/proof_view.hpp"
#include "fairway/verify/section_view.hpp"
#include "fairway/verify/state_flight.hpp"
#include "fairway/verify/verdict.hpp"

namespace fairway {

/// What is known of a state: `reach` by the first mode that is proved to bring it; otherwise what
/// the first mode does.
struct ProvedState {
  Verdict verdict = Verdict::undecided;
  double time_s = std::numeric_limits<double>::infinity();  ///< bound, finite only for `reach`
  int mode = 0;
};

namespace asked_modes {

/// Collects what is proved of all ends that the flights of a state, or of a set, may have.
struct Reader {
  const Flow& flow;
  const SectionView& sections;
  VerdictSet found;
  bool gave_up = false;

  double seconds(double length_m) const {
    return length_m == 0.0 ? 0.0 : above(length_m / flow.vehicle.speed_mps);
  }
  void arrive(std::size_t section, Interval along_m, double length_m, bool) {
    sections.look_up(section, units_of(along_m, flow.grid.cell_m), seconds(length_m), found);
  }
  void end(Verdict verdict, double length_m) { found.add(verdict, seconds(length_m)); }
  void give_up() {
    gave_up = true;
    found.add(Verdict::undecided, 0.0);
  }
};

}  // namespace asked_modes

/// What one mode does with a state: metres, radians, all finite and within 2^30 cells of the grid.
inline VerdictSet ask_mode(const ProofView& proof, int mode, double x_m, double y_m,
                           double heading_rad, int most_crossings = usual_most_crossings) {
  const Flow flow = proof.flow_of(mode);
  const SectionView sections = proof.sections_of(mode);
  asked_modes::Reader reader{flow, sections, {}};
  follow_state(flow, x_m, y_m, heading_rad, most_crossings, reader);
  return reader.found;
}

/// The same of all modes before `end`.
inline ProvedState ask_modes(const ProofView& proof, int end, double x_m, double y_m,
                             double heading_rad, int most_crossings = usual_most_crossings) {
  ProvedState first;
  for (int mode = 0; mode < end; ++mode) {
    const VerdictSet found = ask_mode(proof, mode, x_m, y_m, heading_rad, most_crossings);
    const Verdict verdict = found.only();
    if (verdict == Verdict::reach) return {verdict, found.time_s, mode};
    if (mode == 0) first.verdict = proof.flow.told(verdict, proof.flow.grid.cell_of({x_m, y_m}));
  }
  return first;
}
inline ProvedState ask_all_modes(const ProofView& proof, double x_m, double y_m, double heading_rad,
                                 int most_crossings = usual_most_crossings) {
  return ask_modes(proof, proof.modes(), x_m, y_m, heading_rad, most_crossings);
}

}  // namespace fairway
