// What is proved of a plan with all its modes, for lookups: a view that owns nothing, so that it
// can refer to a mapped file.
//
// A mode is a field of commands over the plan's cells (hand_over.hpp). The first one, 0, is the
// mission's; further ones are flown from states that it does not bring, until it does.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

#include "fairway/verify/flow.hpp"
#include "fairway/verify/section_view.hpp"
#include "fairway/verify/state_flight.hpp"
#include "fairway/verify/verdict.hpp"

namespace fairway {

struct ProofView {
  Flow flow;                           ///< of the first mode
  SectionView sections;                ///< of the first mode
  int further = 0;                     ///< modes after the first
  const float* further_rad = nullptr;  ///< [further][iy][ix]
  /// Of the further modes, one after another: section s of mode k is number 4 cells (k - 1) + s.
  SectionView further_sections;

  int modes() const { return further + 1; }
  Flow flow_of(int mode) const {
    if (mode == 0) return flow;
    Flow of = flow;
    of.heading_rad = further_rad + static_cast<std::size_t>(mode - 1) * flow.grid.size();
    of.holding = nullptr;
    return of;
  }
  SectionView sections_of(int mode) const {
    if (mode == 0) return sections;
    SectionView of = further_sections;
    of.first += static_cast<std::size_t>(mode - 1) * 4 * flow.grid.size();
    return of;
  }
};

/// What is known of a state: `reach` by the first mode that is proved to bring it; otherwise what
/// the first mode does.
struct ProvedState {
  Verdict verdict = Verdict::undecided;
  double time_s = std::numeric_limits<double>::infinity();  ///< bound, finite only for `reach`
  int mode = 0;
};

namespace proof_view {

/// Collects what is proved of all ends that one state's flights may have.
struct Reader {
  const Flow& flow;
  const SectionView& sections;
  VerdictSet found;

  double seconds(double length_m) const {
    return length_m == 0.0 ? 0.0 : above(length_m / flow.vehicle.speed_mps);
  }
  void arrive(std::size_t section, Interval along_m, double length_m, bool) {
    sections.look_up(section, units_of(along_m, flow.grid.cell_m), seconds(length_m), found);
  }
  void end(Verdict verdict, double length_m) { found.add(verdict, seconds(length_m)); }
  void give_up() { found.add(Verdict::undecided, 0.0); }
};

}  // namespace proof_view

/// What one mode does with a state: metres, radians, all finite and within 2^30 cells of the grid.
inline VerdictSet ask_mode(const ProofView& proof, int mode, double x_m, double y_m,
                           double heading_rad, int most_crossings = usual_most_crossings) {
  const Flow flow = proof.flow_of(mode);
  const SectionView sections = proof.sections_of(mode);
  proof_view::Reader reader{flow, sections, {}};
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
