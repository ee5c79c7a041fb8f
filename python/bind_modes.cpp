// modes: which field of commands a vehicle flies, kept on its way.
#include <cmath>
#include <memory>
#include <utility>

#include "bind_certificate.hpp"
#include "binding.hpp"
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
}

}  // namespace fairway::python
