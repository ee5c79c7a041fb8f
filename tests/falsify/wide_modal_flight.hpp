// Flights in 237 bits by the leaves of a certificate with modes: the judge of what flights in
// doubles contradict.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "fairway/verify/ask_modes.hpp"
#include "fairway/verify/testing/wide_flight.hpp"

namespace fairway {

/// What is claimed: who flies `mode` by its leaves from there reaches within the bound.
struct ModeClaim {
  double x_m = 0.0;
  double y_m = 0.0;
  double heading_rad = 0.0;
  int mode = 0;
  double bound_s = 0.0;
};

struct WideJudgement {
  bool contradicted = false;
  bool late = false;
  bool unknown = false;
  std::string ends;  ///< of all flights, in words
};

class WideModalFlights {
 public:
  explicit WideModalFlights(const ProofView& proof);

  /// Flies from every cell that the state belongs to, with several draws of what is left open: the
  /// side of a turn, the leaf where two meet.
  WideJudgement judge(const ModeClaim& claim) const;

 private:
  struct Start {
    int ix;
    int iy;
    WideVec<Wide> p;
    WideVec<Wide> u;
  };
  WideMeeting<Wide> fly(const Start& start, int mode,
                        const std::function<std::size_t(std::size_t)>& choice) const;
  /// The mode that the leaf names where the flight meets it, or `mode`.
  int next_mode(int mode, const WideMeeting<Wide>& met,
                const std::function<std::size_t(std::size_t)>& choice) const;

  ProofView proof_;
  /// Its commands as vectors, made when first asked for: that takes seconds on large plans.
  const WideCommands<Wide>& commands(int mode) const;

  std::vector<Flow> flows_;  // [mode]; commands_ refer to these
  mutable std::mutex mutex_;
  mutable std::vector<std::unique_ptr<WideCommands<Wide>>> commands_;
};

}  // namespace fairway
