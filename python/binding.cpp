#include "binding.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <type_traits>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "fairway/base/number_csv.hpp"
#include "fairway/map/earth_frame.hpp"

namespace fairway::python {
namespace {

// Rows of three doubles: how numpy sees states.
static_assert(std::is_standard_layout_v<State> && sizeof(State) == 3 * sizeof(double));

std::string shape_of(const py::array& array) {
  std::string text;
  for (py::ssize_t i = 0; i < array.ndim(); ++i) {
    text += (i == 0 ? "" : ", ") + std::to_string(array.shape(i));
  }
  return "[" + text + "]";
}

using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// `rows` as doubles. Numbers only: numpy itself would turn words into numbers, too.
Doubles doubles_of(const py::object& rows, const char* name, const std::string& expected) {
  const py::array array = py::array::ensure(rows);
  if (!array) PyErr_Clear();
  if (!array || std::string_view("iuf").find(array.dtype().kind()) == std::string_view::npos) {
    throw py::type_error(fmt::format(
        "{}: expected numbers, {}, found {}", name, expected,
        array ? "an array of " + std::string(py::str(array.dtype())) : "something else"));
  }
  return Doubles::ensure(array);
}

/// [n, width]; an empty list is n = 0.
Doubles rows_of(const py::object& rows, const char* name, py::ssize_t width, const char* columns) {
  const std::string expected = fmt::format("an array of shape [n, {}]: {}", width, columns);
  Doubles array = doubles_of(rows, name, expected);
  if (array.ndim() == 1 && array.size() == 0) return Doubles(std::vector<py::ssize_t>{0, width});
  if (array.ndim() != 2 || array.shape(1) != width) {
    throw py::value_error(
        fmt::format("{}: has shape {}, expected {}", name, shape_of(array), expected));
  }
  const double* x = array.data();
  for (py::ssize_t i = 0; i < array.size(); ++i) {
    if (std::isfinite(x[i])) continue;
    throw py::value_error(fmt::format("{}[{}]: is not finite", name, i / width));
  }
  return array;
}

Doubles row_of(const py::object& row, const char* name, py::ssize_t width, const char* columns) {
  const std::string expected = fmt::format("{} numbers: {}", width, columns);
  Doubles array = doubles_of(row, name, expected);
  if (array.ndim() != 1 || array.size() != width) {
    throw py::value_error(
        fmt::format("{}: has shape {}, expected {}", name, shape_of(array), expected));
  }
  for (py::ssize_t i = 0; i < width; ++i) {
    if (!std::isfinite(array.at(i))) throw py::value_error(fmt::format("{}: is not finite", name));
  }
  return array;
}

}  // namespace

const char* name_of(MissionRefusal::Reason reason) {
  switch (reason) {
    case MissionRefusal::Reason::outside_map:
      return "outside_map";
    case MissionRefusal::Reason::in_obstacle:
      return "in_obstacle";
    case MissionRefusal::Reason::in_buffer:
      return "in_buffer";
    case MissionRefusal::Reason::goal_too_small:
      return "goal_too_small";
    case MissionRefusal::Reason::unreachable:
      return "unreachable";
  }
  return "";
}

void raise_on_signal() {
  const py::gil_scoped_acquire lock;
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

Progress progress_of(const py::object& callback) {
  const py::handle called = callback;
  return [called](std::string_view stage, const TimeLeft& left) {
    const py::gil_scoped_acquire lock;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (called.is_none()) return;
    called(py::str(stage.data(), stage.size()), left.estimate_s < 0.0
                                                    ? py::object(py::none())
                                                    : py::object(py::float_(left.estimate_s)));
  };
}

void require_heading(double heading_rad, const std::string& name) {
  if (std::abs(heading_rad) <= most_heading_rad) return;
  throw py::value_error(fmt::format(
      "{} is {}, expected radians from -7 to 7{}", name, heading_rad,
      std::abs(heading_rad) <= 360.0 ? fmt::format("; did you mean math.radians({})?", heading_rad)
                                     : std::string()));
}

std::vector<State> states_of(const py::object& rows, const char* name) {
  const Doubles array = rows_of(rows, name, 3, "x_m, y_m, heading_rad");
  std::vector<State> states(static_cast<std::size_t>(array.shape(0)));
  const double* x = array.data();
  for (std::size_t i = 0; i < states.size(); ++i) {
    require_heading(x[3 * i + 2], std::string(name) + ": heading_rad");
    states[i] = {{x[3 * i], x[3 * i + 1]}, Heading::from_rad(x[3 * i + 2])};
  }
  return states;
}

State state_of(const py::object& row, const char* name) {
  const Doubles x = row_of(row, name, 3, "x_m, y_m, heading_rad");
  require_heading(x.at(2), std::string(name) + ": heading_rad");
  return {{x.at(0), x.at(1)}, Heading::from_rad(x.at(2))};
}

py::array states_from_degrees(const Frame& frame, const py::object& rows) {
  const Doubles array = rows_of(rows, "states_deg", 3, "lat_deg, lon_deg, course_deg");
  const EarthFrame earth(frame, "states_deg");
  std::vector<State> states(static_cast<std::size_t>(array.shape(0)));
  const double* x = array.data();
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (std::abs(x[3 * i + 2]) > 360.0) {
      throw py::value_error(fmt::format(
          "states_deg[{}]: course_deg is {}, expected degrees from -360 to 360", i, x[3 * i + 2]));
    }
    states[i] =
        earth.state_of({x[3 * i], x[3 * i + 1], x[3 * i + 2]}, fmt::format("states_deg[{}]", i));
  }
  return state_array(std::move(states));
}

py::array degrees_from_states(const Frame& frame, const py::object& rows) {
  const std::vector<State> states = states_of(rows, "states");
  const EarthFrame earth(frame, "states_to_deg");
  std::vector<double> degrees;
  for (const State& s : states) {
    const EarthState d = earth.degrees_of(s);
    degrees.insert(degrees.end(), {d.latitude_deg, d.longitude_deg, d.course_deg});
  }
  return owning(std::move(degrees))
      .attr("reshape")(static_cast<py::ssize_t>(states.size()), 3)
      .cast<py::array>();
}

std::vector<Vec2> points_of(const py::object& rows, const char* name) {
  const Doubles array = rows_of(rows, name, 2, "x_m, y_m");
  std::vector<Vec2> points(static_cast<std::size_t>(array.shape(0)));
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i] = {array.data()[2 * i], array.data()[2 * i + 1]};
  }
  return points;
}

Vec2 point_of(const py::object& row, const char* name) {
  const Doubles x = row_of(row, name, 2, "x_m, y_m");
  return {x.at(0), x.at(1)};
}

ObstacleMap obstacles_of(const py::object& cells, double cell_m, Vec2 origin_m) {
  const py::array array = py::array::ensure(cells);
  if (!array) PyErr_Clear();
  const bool is_bool = array && array.dtype().kind() == 'b';
  const bool is_byte = array && array.dtype().kind() == 'u' && array.dtype().itemsize() == 1;
  if (!is_bool && !is_byte) {
    throw py::type_error(
        fmt::format("obstacles: expected an array [ny, nx] of bool or uint8, found {}; compare "
                    "first, as in grid > 50",
                    array ? "one of " + std::string(py::str(array.dtype())) : "none"));
  }
  if (array.ndim() != 2 || array.size() == 0) {
    throw py::value_error(fmt::format(
        "obstacles: has shape {}, expected [ny, nx], the lowest row first", shape_of(array)));
  }
  constexpr py::ssize_t most = 2147483647;
  if (array.shape(0) > most || array.shape(1) > most) {
    throw py::value_error("obstacles: has more than 2147483647 rows or columns");
  }
  using Bytes = py::array_t<std::uint8_t, py::array::c_style | py::array::forcecast>;
  const auto bytes = Bytes::ensure(array);
  ObstacleMap map;
  map.grid = {static_cast<int>(array.shape(1)), static_cast<int>(array.shape(0)), origin_m.x,
              origin_m.y, cell_m};
  map.obstacle.assign(bytes.data(), bytes.data() + bytes.size());
  if (std::any_of(map.obstacle.begin(), map.obstacle.end(), [](std::uint8_t c) { return c > 1; })) {
    throw py::value_error(
        "obstacles: has numbers other than 0 (free) and 1 (obstacle); compare first, as in "
        "image < 128");
  }
  return map;
}

py::array state_array(std::vector<State>&& states) {
  auto* kept = new std::vector<State>(std::move(states));
  const py::capsule owner(kept, [](void* p) { delete static_cast<std::vector<State>*>(p); });
  const auto count = static_cast<py::ssize_t>(kept->size());
  const py::ssize_t size = sizeof(double);
  return py::array(py::dtype::of<double>(), std::vector<py::ssize_t>{count, 3},
                   std::vector<py::ssize_t>{3 * size, size},
                   reinterpret_cast<const double*>(kept->data()), owner);
}

py::array state_view(const State* states, std::size_t count, std::size_t stride,
                     const py::handle& owner) {
  return view(reinterpret_cast<const double*>(states), {static_cast<py::ssize_t>(count), 3},
              {static_cast<py::ssize_t>(stride), static_cast<py::ssize_t>(sizeof(double))}, owner);
}

py::object python_of_json(const std::string& text) {
  return py::module_::import("json").attr("loads")(text);
}

py::object python_of(const nlohmann::json& value) {
  return python_of_json(value.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace));
}

void add_enum(py::module_& m, const char* name, const char* doc,
              const std::vector<std::pair<const char*, int>>& codes) {
  py::list members;
  for (const auto& [member, code] : codes) {
    members.append(py::make_tuple(py::str(member).attr("upper")(), code));
  }
  const py::object type = py::module_::import("enum").attr("IntEnum")(
      name, members, py::arg("module") = m.attr("__name__"));
  type.attr("__doc__") = doc;
  m.attr(name) = type;
}

std::string words_of(const Grid& grid) {
  return fmt::format("{} by {} cells of {:g} m from ({:g}, {:g})", grid.nx, grid.ny, grid.cell_m,
                     grid.x0_m, grid.y0_m);
}

py::tuple extent_of(const Grid& grid) {
  return py::make_tuple(grid.x0_m, grid.x0_m + grid.width_m(), grid.y0_m,
                        grid.y0_m + grid.height_m());
}

}  // namespace fairway::python
