// Which mode a vehicle flies, from state to state (docs/modes.md).
//
// It begins in the first mode that is proved to bring the state. From then on it changes only to
// earlier modes, and only where these are proved to arrive no later than the one that it flies, or
// where that one is not proved any more. So the bound of time that was told at the start holds, and
// as modes only go down, it changes at most modes() - 1 times: the flight ends in mode 0 or in a
// mode that is proved to arrive by itself.
#pragma once

#include "fairway/verify/proof_view.hpp"

namespace fairway {

/// The mode to fly on in from a state to which `mode` was flown: it, or the first earlier one that
/// is proved to arrive, and no later if `mode` is proved, too. Not `reach`: none of them is proved.
inline ProvedState mode_from(const ProofView& proof, int mode, double x_m, double y_m,
                             double heading_rad) {
  const VerdictSet own = ask_mode(proof, mode, x_m, y_m, heading_rad);
  const bool holds = own.only() == Verdict::reach;
  for (int earlier = 0; earlier < mode; ++earlier) {
    const VerdictSet found = ask_mode(proof, earlier, x_m, y_m, heading_rad);
    if (found.only() != Verdict::reach || (holds && found.time_s > own.time_s)) continue;
    return {Verdict::reach, found.time_s, earlier};
  }
  ProvedState known;
  known.mode = mode;
  if (holds) {
    known.verdict = Verdict::reach;
    known.time_s = own.time_s;
  }
  return known;
}

class ModeChoice {
 public:
  explicit ModeChoice(const ProofView& proof) : proof_(proof) {}

  /// The vehicle is at this state. The returned mode is the one to fly from here; `verdict` and
  /// time are those of that mode. It is `reach` as long as the proof holds; where it is not, the
  /// vehicle has left what was proved (a gust, or a start that nothing saves). Then every mode is
  /// asked anew, and the present one goes on where none is proved.
  ProvedState at(double x_m, double y_m, double heading_rad) {
    if (!begun_) return begin(x_m, y_m, heading_rad);
    const ProvedState known = mode_from(proof_, mode_, x_m, y_m, heading_rad);
    mode_ = known.mode;
    if (known.verdict == Verdict::reach) return known;
    return begin(x_m, y_m, heading_rad);
  }

  int mode() const { return mode_; }

 private:
  ProvedState begin(double x_m, double y_m, double heading_rad) {
    ProvedState known = ask_all_modes(proof_, x_m, y_m, heading_rad);
    if (known.verdict == Verdict::reach || !begun_) mode_ = known.mode;
    begun_ = true;
    known.mode = mode_;
    return known;
  }

  ProofView proof_;
  int mode_ = 0;
  bool begun_ = false;
};

}  // namespace fairway
