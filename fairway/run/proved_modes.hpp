// Which mode an exact flight is in, decided by what is proved of the plan: as a vehicle decides
// that has the certificate on board (verify/mode_choice.hpp), asked at every border.
#pragma once

#include "fairway/simulate/modal_flight.hpp"
#include "fairway/verify/mode_choice.hpp"

namespace fairway {

class ProvedModes final : public ModeDecider {
 public:
  /// What `proof` refers to must outlive this. Starts and flights within 2^30 cells of the grid.
  explicit ProvedModes(const ProofView& proof) : proof_(proof) {}

  int begin(const State& start) override {
    const Vec2 p = start.position_m;
    return ask_all_modes(proof_, p.x, p.y, start.heading.rad()).mode;
  }
  int at_border(const BorderCrossing& crossing, int mode) override {
    const Vec2 p = crossing.state.position_m;
    return mode_from(proof_, mode, p.x, p.y, crossing.state.heading.rad()).mode;
  }

 private:
  ProofView proof_;
};

}  // namespace fairway
