// Which mode a vehicle flies, from state to state (docs/modes.md).
//
// It begins in the first mode that is proved to bring the state. From then on it changes only to
// earlier modes, each time to the one that is proved to arrive soonest, and only where that is no
// later than the mode that it flies is proved to, or where that one is not proved any more. Where
// the proof hands over to some mode, that mode's bound is part of what was told at the start, and
// the soonest one's is no larger: so what was told holds. As modes only go down, it changes at most
// modes() - 1 times: the flight ends in mode 0 or in a mode that is proved to arrive by itself.
//
// What is proved is of a vehicle that asks wherever it crosses a border. One that asks later has
// flown on in a mode that may not be proved there; mostly, an earlier one is.
#pragma once

#include "fairway/base/grid.hpp"
#include "fairway/verify/ask_modes.hpp"
#include "fairway/verify/mode_trial.hpp"

namespace fairway {

/// The mode to fly on in from a state to which `mode` was flown: it, or the earlier one that is
/// proved to arrive soonest, and no later if `mode` is proved, too. Not `reach`: none of them is
/// proved.
inline ProvedState mode_from(const ProofView& proof, int mode, double x_m, double y_m,
                             double heading_rad) {
  ProvedState best;
  best.mode = mode;
  for (int earlier = 0; earlier < mode; ++earlier) {
    const VerdictSet found = ask_mode(proof, earlier, x_m, y_m, heading_rad);
    if (found.only() != Verdict::reach || !(found.time_s < best.time_s)) continue;
    best = {Verdict::reach, found.time_s, earlier};
  }
  const VerdictSet own = ask_mode(proof, mode, x_m, y_m, heading_rad);
  const bool stays = own.only() == Verdict::reach && own.time_s < best.time_s;
  return stays ? ProvedState{Verdict::reach, own.time_s, mode} : best;
}

class ModeChoice {
 public:
  explicit ModeChoice(const ProofView& proof) : proof_(proof) {}

  /// The vehicle is at this state. The returned mode is the one to fly from here; `verdict` and
  /// time are those of that mode. It is `reach` as long as the proof holds; where it is not, the
  /// vehicle has left what was proved (a gust, or a start that nothing saves). Then every mode is
  /// asked anew, and where none is proved, the one is flown that a simulation likes best, from each
  /// cell anew: undecided, unless it is the first, which is known to fail from there or not.
  ProvedState at(double x_m, double y_m, double heading_rad) {
    if (!begun_) return begin(x_m, y_m, heading_rad);
    const ProvedState known = mode_from(proof_, mode_, x_m, y_m, heading_rad);
    if (known.verdict != Verdict::reach) return begin(x_m, y_m, heading_rad);
    mode_ = known.mode;
    return known;
  }

  int mode() const { return mode_; }

 private:
  ProvedState begin(double x_m, double y_m, double heading_rad) {
    ProvedState known = ask_all_modes(proof_, x_m, y_m, heading_rad);
    begun_ = true;
    if (known.verdict == Verdict::reach) {
      mode_ = known.mode;
      return known;
    }
    const Cell cell = proof_.flow.grid.cell_of({x_m, y_m});
    if (cell.ix != tried_.ix || cell.iy != tried_.iy) {
      mode_ = liked_mode(proof_, mode_, x_m, y_m, heading_rad);
    }
    tried_ = cell;
    if (mode_ != 0) known = {Verdict::undecided, known.time_s, mode_};
    return known;
  }

  ProofView proof_;
  int mode_ = 0;
  bool begun_ = false;
  Cell tried_{-1, -1};  ///< where a simulation was last asked
};

}  // namespace fairway
