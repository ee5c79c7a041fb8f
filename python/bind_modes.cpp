// modes: which field of commands a vehicle flies, kept on its way.
#include <cmath>
#include <memory>
#include <utility>

#include "bind_certificate.hpp"
#include "binding.hpp"
#include "fairway/contract_pilot.hpp"
#include "fairway/runtime.hpp"

namespace fairway::python {
namespace {

using namespace pybind11::literals;

/// A pilot and the certificate that it looks into.
class Pilot {
 public:
  explicit Pilot(std::shared_ptr<HeldCertificate> held)
      : held_(std::move(held)), pilot_(opened(*held_)) {}

  py::tuple steer(double x_m, double y_m, double heading_rad) {
    const Grid& grid = held_->certificate.grid;
    constexpr double far_cells = 1e9;
    const double far_m = far_cells * grid.cell_m;
    if (!(std::abs(x_m - grid.x0_m) < far_m && std::abs(y_m - grid.y0_m) < far_m)) {
      throw py::value_error("x_m, y_m: not finite, or far outside of the grid");
    }
    if (!std::isfinite(heading_rad)) throw py::value_error("heading_rad: is not finite");
    require_heading(heading_rad, "heading_rad");
    const runtime::ModePilot::Steered now = pilot_.steer(x_m, y_m, heading_rad);
    mode_ = now.answer.mode;
    return py::make_tuple(now.command.heading_rad, now.command.turn_rate_radps,
                          static_cast<int>(now.answer.verdict), now.answer.time_bound_s, mode_);
  }
  int mode() const { return mode_; }

 private:
  static runtime::Certificate opened(const HeldCertificate& held) {
    runtime::Certificate certificate;
    certificate.look_into(held.certificate.view());
    return certificate;
  }

  std::shared_ptr<HeldCertificate> held_;
  runtime::ModePilot pilot_;
  int mode_ = 0;
};

/// The same under a contract.
class PilotUnderContract {
 public:
  explicit PilotUnderContract(std::shared_ptr<HeldContractCertificate> held)
      : held_(std::move(held)), opened_(*held_), pilot_(opened_) {}

  py::tuple steer(double now_s, double x_m, double y_m, double course_rad) {
    for (const double number : {now_s, x_m, y_m, course_rad}) {
      if (!std::isfinite(number)) throw py::value_error("a time or state is not finite");
    }
    require_heading(course_rad, "course_rad");
    const runtime::ContractPilot::Steered now = pilot_.steer(now_s, x_m, y_m, course_rad);
    return py::make_tuple(now.course_rad, static_cast<int>(now.answer.verdict),
                          now.answer.time_bound_s, now.answer.mode);
  }

 private:
  struct Opened : runtime::ContractCertificate {
    explicit Opened(const HeldContractCertificate& held) { look_into(held.certificate); }
  };

  std::shared_ptr<HeldContractCertificate> held_;
  Opened opened_;
  runtime::ContractPilot pilot_;
};

}  // namespace

void bind_modes(py::module_& m) {
  py::class_<Pilot>(
      m, "ModePilot",
      "The side of one vehicle whose plan has modes: keeps the mode that it flies (docs/modes.md). "
      "It begins in the first one that is proved to reach, and changes to earlier ones where these "
      "are proved to arrive no later; never back, but for a vehicle that has left what was proved.")
      .def(py::init<std::shared_ptr<HeldCertificate>>(), py::arg("certificate").none(false),
           "Of the plan that is flown, with any number of modes.")
      .def("steer", &Pilot::steer, "x_m"_a, "y_m"_a, "heading_rad"_a,
           R"(What to steer now (metres, radians), to be asked often on the way.

Returns (heading_rad, turn_rate_radps, verdict, time_bound_s, mode): the command as that of
Certificate.command, in the mode that is flown; what is proved of the flight from here in it, a
Verdict, and a bound in seconds, +inf unless it reaches. A verdict other than REACH: what was proved
does not hold from here. Raises ValueError for a state that is not finite or far outside.)")
      .def_property_readonly("mode", &Pilot::mode, "The mode that is flown; 0 before the start.");
  py::class_<PilotUnderContract>(
      m, "ContractPilot",
      "The side of one vehicle under a contract: keeps the side of a turn, the mode of a plan with "
      "modes, and until when the vehicle will have reached (docs/modes.md, \"Under a contract\").")
      .def(py::init<std::shared_ptr<HeldContractCertificate>>(), py::arg("certificate").none(false),
           "Of the plan that is flown, with any number of modes.")
      .def("steer", &PilotUnderContract::steer, "now_s"_a, "x_m"_a, "y_m"_a, "course_rad"_a,
           R"(Which course to fly now, to be asked at every control step.

now_s             seconds on a clock that does not go back
x_m, y_m, course_rad
                  where the vehicle takes itself to be: within command_error_m and
                  heading_error_rad of the true state

Returns (course_rad, verdict, time_bound_s, mode): the course for an autopilot that turns to the
shorter side; REACH and a bound in seconds from now as long as the proof holds, else UNDECIDED and
+inf; the mode that is flown. Raises ValueError for numbers that are not finite.)");
}

}  // namespace fairway::python
