// What the files of the binding share. A file for each stage, in the order of the stages; none has
// a logic of its own: arrays in, one call of the library without the interpreter's lock, arrays
// out.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <nlohmann/json_fwd.hpp>

#include "fairway/base/frame.hpp"
#include "fairway/field/field.hpp"
#include "fairway/map/obstacle_map.hpp"
#include "fairway/plan/plan.hpp"
#include "fairway/report/picture.hpp"
#include "fairway/run/flight_engine.hpp"
#include "fairway/run/progress.hpp"
#include "fairway/vehicle/bang_bang.hpp"
#include "fairway/vehicle/mission.hpp"

namespace fairway::python {

namespace py = pybind11;

// One for each stage, in their order.
void bind_map(py::module_& m);
void bind_field(py::module_& m);
void bind_plan(py::module_& m);
void bind_simulate(py::module_& m);
void bind_verify(py::module_& m);
void bind_certificate(py::module_& m);
void bind_steer(py::module_& m);
void bind_report(py::module_& m);
void bind_run(py::module_& m);

/// A plan that Python holds, with what its flights need, made once.
class HeldPlan {
 public:
  explicit HeldPlan(Plan made) : plan(std::move(made)) {}
  const FlightEngine& exact() const {
    std::call_once(once_, [this] { exact_ = std::make_unique<FlightEngine>(plan); });
    return *exact_;
  }
  const Plan plan;

 private:
  mutable std::once_flag once_;
  mutable std::unique_ptr<FlightEngine> exact_;
};

/// The domain's answer "no" to a mission; Python's fairway.MissionRefused.
struct Refused {
  MissionRefusal refusal;
  std::string message;  ///< with the place in the scenario, if there is one
};
[[nodiscard]] const char* name_of(MissionRefusal::Reason reason);

/// Calls Python's progress(stage, left_s), left_s None when unknown, with the interpreter's lock
/// taken. What it raises, and Ctrl-C, end the work. `callback` must outlive the answer.
[[nodiscard]] Progress progress_of(const py::object& callback);
/// Raises what a signal handler of Python raises. With the lock held or not.
void raise_on_signal();

/// Throws ValueError for more than 7 radians, as files of states refuse them. `name`: of what.
void require_heading(double heading_rad, const std::string& name);
/// Rows x_m, y_m, heading_rad, the headings from -7 to 7. TypeError or ValueError say what is
/// expected instead.
[[nodiscard]] std::vector<State> states_of(const py::object& rows, const char* name);
/// Rows lat_deg, lon_deg, course_deg as states [n, 3], and states as such rows. InputError where
/// the frame has no place on Earth.
[[nodiscard]] py::array states_from_degrees(const Frame& frame, const py::object& rows);
[[nodiscard]] py::array degrees_from_states(const Frame& frame, const py::object& rows);
/// One row.
[[nodiscard]] State state_of(const py::object& row, const char* name);
/// A command for Python: (heading_rad, turn_rate_radps).
[[nodiscard]] inline py::tuple tuple_of(const HeadingCommand& command) {
  return py::make_tuple(command.heading_rad, command.turn_rate_radps);
}
inline constexpr const char* command_words =
    "What to steer at a state (metres, radians): (heading_rad, turn_rate_radps), the heading that "
    "the cell commands, NaN without a command, and the bang-bang turn towards it, positive to the "
    "left, 0 when aligned or without a command. Outside the grid: no command.";

/// Rows x_m, y_m.
[[nodiscard]] std::vector<Vec2> points_of(const py::object& rows, const char* name);
[[nodiscard]] Vec2 point_of(const py::object& row, const char* name);
/// [ny, nx] of bool, or of uint8 with nothing but 0 and 1.
[[nodiscard]] ObstacleMap obstacles_of(const py::object& cells, double cell_m, Vec2 origin_m);

/// A read-only numpy array over memory that `owner` keeps alive. Strides are in bytes.
template <typename T>
py::array view(const T* data, std::vector<py::ssize_t> shape, std::vector<py::ssize_t> strides,
               const py::handle& owner) {
  py::array array(py::dtype::of<T>(), std::move(shape), std::move(strides), data, owner);
  // pybind11 has no call for this, and numpy's own, `array.flags.writeable = False`, would go
  // through the interpreter for every array.
  py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}
/// The same for an array over a grid, [iy][ix].
template <typename T>
py::array grid_view(const T* data, const Grid& grid, const py::handle& owner) {
  const auto size = static_cast<py::ssize_t>(sizeof(T));
  return view(data, {grid.ny, grid.nx}, {grid.nx * size, size}, owner);
}
/// The items of `items` as a numpy array that owns them: nothing is copied.
template <typename T>
py::array owning(std::vector<T>&& items) {
  auto* kept = new std::vector<T>(std::move(items));
  const py::capsule owner(kept, [](void* p) { delete static_cast<std::vector<T>*>(p); });
  return py::array(py::dtype::of<T>(), {static_cast<py::ssize_t>(kept->size())},
                   {static_cast<py::ssize_t>(sizeof(T))}, kept->data(), owner);
}
/// States as rows x_m, y_m, heading_rad of an array that owns them, or of one owned by `owner`.
[[nodiscard]] py::array state_array(std::vector<State>&& states);
[[nodiscard]] py::array state_view(const State* states, std::size_t count, std::size_t stride,
                                   const py::handle& owner);

[[nodiscard]] py::object python_of(const nlohmann::json& value);
[[nodiscard]] py::object python_of_json(const std::string& text);
/// enum.IntEnum of these names, an attribute of `m`: comparable with the codes in arrays.
void add_enum(py::module_& m, const char* name, const char* doc,
              const std::vector<std::pair<const char*, int>>& codes);

/// The choice named `name`; ValueError lists the names.
template <typename T>
T choice_of(const char* option, const std::string& name,
            const std::vector<std::pair<const char*, T>>& choices) {
  std::string known;
  for (const auto& [choice, value] : choices) {
    if (choice == name) return value;
    known += (known.empty() ? "\"" : ", \"") + std::string(choice) + '"';
  }
  throw py::value_error(std::string(option) + ": is \"" + name + "\", expected one of " + known);
}

/// "2 by 3" and so on, for __repr__.
[[nodiscard]] std::string words_of(const Grid& grid);
[[nodiscard]] py::tuple extent_of(const Grid& grid);

}  // namespace fairway::python
