#include "fairway/contract_pilot.hpp"

namespace fairway::runtime {

ContractPilot::ContractPilot(const ContractCertificate& certificate)
    : certificate_(certificate),
      look_ahead_m_(certificate.contract()->look_ahead_m),
      side_(certificate.contract()->hold_side_rad) {
  for (int mode = 0; mode < certificate.modes(); ++mode) {
    commands_.emplace_back(certificate.flow()->grid, certificate.heading_rad(mode));
  }
}

ContractPilot::Steered ContractPilot::steer(double now_s, double x_m, double y_m,
                                            double course_rad) noexcept {
  if (!(now_s <= deadline_s_)) begin(now_s, x_m, y_m, course_rad);
  while (mode_ > 0 && now_s <= deadline_s_) {
    const Answer to = certificate_.hand_over(mode_, x_m, y_m, course_rad, deadline_s_ - now_s);
    if (to.verdict != Verdict::reach) break;
    change(to, now_s);
  }
  Steered now;
  const Vec2 ahead = point_ahead(x_m, y_m, course_rad, look_ahead_m_);
  const CommandField& commands = commands_[static_cast<std::size_t>(mode_)];
  now.course_rad = side_.keep(commands.command_rad(ahead.x, ahead.y), course_rad);
  now.answer.mode = mode_;
  if (now_s <= deadline_s_) {
    now.answer.verdict = Verdict::reach;
    now.answer.time_bound_s = deadline_s_ - now_s;
  }
  return now;
}

/// In the first mode that is proved from wherever the vehicle may be; where none is, the present
/// one goes on.
void ContractPilot::begin(double now_s, double x_m, double y_m, double course_rad) noexcept {
  for (int mode = 0; mode < certificate_.modes(); ++mode) {
    const Answer known = certificate_.query_around(mode, x_m, y_m, course_rad);
    if (known.verdict == Verdict::reach) return change(known, now_s);
  }
}

void ContractPilot::change(const Answer& to, double now_s) noexcept {
  side_ = TurnSide(certificate_.contract()->hold_side_rad);
  mode_ = to.mode;
  deadline_s_ = now_s + to.time_bound_s;
}

}  // namespace fairway::runtime
