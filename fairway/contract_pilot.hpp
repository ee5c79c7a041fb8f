// For the vehicle under a contract: which course to fly, from what it takes itself to be. Keeps
// what there is to keep on the way: the side of a turn, the mode of a plan with modes, and until
// when the vehicle will have reached. Part of the library, as fairway/contract_runtime.hpp is.
//
//     fairway::runtime::ContractPilot pilot(certificate);
//     for (;;) {  // at every control step
//       const auto now = pilot.steer(clock_s, x_m, y_m, course_rad);
//       if (now.answer.verdict != fairway::Verdict::reach) ...  // nothing is proved from here
//       autopilot.turn_to(now.course_rad);
//     }
#pragma once

#include <limits>
#include <vector>

#include "fairway/contract_runtime.hpp"

namespace fairway::runtime {

/// In which mode: docs/modes.md, "Under a contract"; of a plan without modes, in its only one. It
/// begins in the first that is proved from wherever the vehicle may be, and begins anew when the
/// time is over by which it should have reached. One for each vehicle; the certificate must outlive
/// it.
class ContractPilot {
 public:
  /// `certificate`: opened. Takes 4 bytes a cell and mode; throws std::bad_alloc.
  explicit ContractPilot(const ContractCertificate& certificate);

  struct Steered {
    double course_rad;  ///< for an autopilot that turns to the shorter side (TurnSide)
    Answer answer;  ///< the mode that is flown, and by when, from now. Other than reach: nothing
                    ///< is proved from here
  };
  /// The vehicle takes itself to be in this state at `now_s`, on a clock that does not go back. To
  /// be asked at every control step; what it answers is in force at once.
  Steered steer(double now_s, double x_m, double y_m, double course_rad) noexcept;

 private:
  void begin(double now_s, double x_m, double y_m, double course_rad) noexcept;
  void change(const Answer& to, double now_s) noexcept;

  const ContractCertificate& certificate_;
  std::vector<CommandField> commands_;  ///< of each mode
  double look_ahead_m_;
  TurnSide side_;
  int mode_ = 0;
  double deadline_s_ = -std::numeric_limits<double>::infinity();
};

}  // namespace fairway::runtime
