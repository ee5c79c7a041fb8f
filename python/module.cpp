// The extension module: errors, then the stages in their order.
#include <exception>
#include <string>

#include "binding.hpp"
#include "fairway/base/error.hpp"
#include "fairway/run/version.hpp"

namespace fairway::python {
namespace {

// Live as long as the interpreter.
PyObject* input_error = nullptr;
PyObject* mission_refused = nullptr;

PyObject* new_error(py::module_& m, const char* name, const char* doc) {
  PyObject* type = PyErr_NewExceptionWithDoc((std::string("fairway.") + name).c_str(), doc,
                                             PyExc_ValueError, nullptr);
  if (type == nullptr) throw py::error_already_set();
  m.add_object(name, py::handle(type));
  return type;
}

void raise(PyObject* type, const std::string& message,
           const std::vector<std::pair<const char*, py::object>>& members) {
  const py::object error = py::reinterpret_borrow<py::object>(type)(message);
  for (const auto& [name, value] : members) error.attr(name) = value;
  PyErr_SetObject(type, error.ptr());
}

// NOLINTNEXTLINE(performance-unnecessary-value-param): pybind11's own signature
void translate(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const InputError& error) {
    raise(input_error, error.what(), {{"where", py::str(error.where())}});
  } catch (const Refused& refused) {
    raise(mission_refused, refused.message,
          {{"reason", py::str(name_of(refused.refusal.reason))},
           {"lacks_m", py::float_(refused.refusal.lacks_m)}});
  } catch (const PreconditionViolation& violation) {
    PyErr_SetString(PyExc_ValueError, violation.what());
  }
}

}  // namespace

void bind_picture(py::module_& m);
void bind_modes(py::module_& m);
void bind_contract_certificate(py::module_& m);
void bind_cellular(py::module_& m);
void bind_bitmap(py::module_& m);
void bind_best_plan(py::module_& m);

}  // namespace fairway::python

PYBIND11_MODULE(_fairway, m) {
  using namespace fairway::python;
  m.doc() = "The extension behind the package fairway.";
  m.attr("__version__") = fairway::program_version;
  input_error =
      new_error(m, "InputError", "Bad input: the message says where and what; so does `where`.");
  mission_refused =
      new_error(m, "MissionRefused",
                "The map does not allow the mission. `reason` is \"outside_map\", "
                "\"in_obstacle\", \"in_buffer\", \"goal_too_small\" or \"unreachable\"; "
                "`lacks_m` the clearance that is missing.");
  py::register_exception_translator(&translate);

  bind_picture(m);  // what the stages hand out is known before them
  bind_map(m);
  bind_plan(m);  // before field, whose answer it is
  bind_field(m);
  bind_simulate(m);
  bind_certificate(m);  // before verify, whose answer it is
  bind_modes(m);
  bind_contract_certificate(m);
  bind_verify(m);
  bind_cellular(m);
  bind_bitmap(m);
  bind_steer(m);
  bind_report(m);
  bind_run(m);
  bind_best_plan(m);  // after run, whose answer tuning gives, too
}
