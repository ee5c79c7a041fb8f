// certificate under a contract: what was proved of every vehicle that keeps it, and queries.
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <nlohmann/json.hpp>

#include "bind_certificate.hpp"
#include "bind_grid.hpp"
#include "binding.hpp"
#include "fairway/certificate/contract_certificate_file.hpp"
#include "fairway/exchange/plan_rasters.hpp"
#include "fairway/report/draw_verdicts.hpp"
#include "fairway/run/ask_certificate.hpp"
#include "fairway/run/contract_failure_pictures.hpp"
#include "fairway/run/contract_failures.hpp"
#include "fairway/run/contract_pictures.hpp"
#include "fairway/run/contract_verification.hpp"
#include "fairway/vehicle/contract_json.hpp"
#include "fairway/verify/sample_verdicts.hpp"

namespace fairway::python {
namespace {

using namespace pybind11::literals;

py::tuple query_modes(const HeldContractCertificate& held, const py::object& rows, bool search) {
  const std::vector<State> states = states_of(rows, "states");
  std::vector<std::int8_t> verdict;
  std::vector<double> time_s;
  std::vector<std::int8_t> mode;
  {
    const py::gil_scoped_release unlocked;
    for (const ContractReply& reply : ask(held.queries(), states, search)) {
      verdict.push_back(static_cast<std::int8_t>(reply.code()));
      time_s.push_back(reply.verdict == Verdict::reach ? reply.time_bound_s
                                                       : std::numeric_limits<double>::infinity());
      mode.push_back(static_cast<std::int8_t>(reply.mode));
    }
  }
  return py::make_tuple(owning(std::move(verdict)), owning(std::move(time_s)),
                        owning(std::move(mode)));
}

py::tuple query(const HeldContractCertificate& held, const py::object& rows, bool search) {
  const py::tuple all = query_modes(held, rows, search);
  return py::make_tuple(all[0], all[1]);
}

/// Rows as witness_csv has them; None where no behaviour that fails is found.
py::object witness(const HeldContractCertificate& held, const py::object& row) {
  const State state = state_of(row, "state");
  std::vector<double> rows;
  {
    const py::gil_scoped_release unlocked;
    const std::vector<ContractReply> reply = ask(held.queries(), std::array{state});
    if (reply[0].witness) {
      constexpr double none = std::numeric_limits<double>::quiet_NaN();
      const ExplainedBehaviour flown = held.queries().explained(*reply[0].witness);
      for (const ExplainedStep& step : flown.steps) {
        const Vec2 at = step.start.position_m;
        const bool turns = step.turn != 0;
        rows.insert(rows.end(),
                    {step.time_s, at.x, at.y, step.start.heading.rad(),
                     turns ? step.turn / step.radius_m : 0.0, turns ? step.radius_m : none,
                     step.command_rad, step.command_m.x, step.command_m.y});
      }
      const Vec2 end = flown.end.position_m;
      rows.insert(rows.end(), {flown.time_s, end.x, end.y, flown.end.heading.rad(), none, none,
                               none, none, none});
    }
  }
  if (rows.empty()) return py::none();
  return owning(std::move(rows)).attr("reshape")(-1, 9);
}

Heading heading_of(double rad, const char* name) {
  if (!std::isfinite(rad)) throw py::value_error(std::string(name) + ": is not finite");
  require_heading(rad, name);
  return Heading::from_rad(rad);
}

py::array verdict_map(const HeldContractCertificate& held, double heading_rad, bool search) {
  const Heading heading = heading_of(heading_rad, "heading_rad");
  const Grid& grid = held.certificate.grid;
  std::vector<std::int8_t> codes;
  {
    const py::gil_scoped_release unlocked;
    for (const ContractReply& reply : ask(held.queries(), states_asked_at(grid, heading), search)) {
      codes.push_back(static_cast<std::int8_t>(reply.code()));
    }
  }
  return owning(std::move(codes)).attr("reshape")(grid.ny, grid.nx);
}

py::tuple failing(const HeldContractCertificate& held, std::size_t of_each, std::uint64_t seed) {
  std::vector<State> states;
  std::vector<std::int8_t> verdicts;
  {
    const py::gil_scoped_release unlocked;
    for (const ContractFailure& failure : contract_failures(held.certificate, of_each, seed)) {
      states.push_back(failure.start);
      verdicts.push_back(static_cast<std::int8_t>(failure.reply.code()));
    }
  }
  return py::make_tuple(state_array(std::move(states)), owning(std::move(verdicts)));
}

py::object summary(const HeldContractCertificate& held) {
  return python_of(contract_verification_json(held.certificate));
}

/// One member of the summary; None if there is none.
py::object member_of(const HeldContractCertificate& held, const char* name) {
  const nlohmann::json all = contract_verification_json(held.certificate);
  return all.contains(name) ? python_of(all[name]) : py::none();
}

void save_geotiff(const HeldContractCertificate& held, const std::filesystem::path& path,
                  const std::optional<std::vector<double>>& headings_rad, bool force) {
  std::vector<Heading> headings = even_headings(VerdictMapOptions{}.headings);
  if (headings_rad) {
    headings.clear();
    for (const double rad : *headings_rad) headings.push_back(heading_of(rad, "headings_rad: one"));
  }
  const py::gil_scoped_release unlocked;
  write_contract_raster(held.certificate.grid, held.certificate.frame.value_or(Frame{}),
                        contract_layers(held.certificate, headings), path,
                        force ? Existing::replace : Existing::keep);
}

Picture picture(const HeldContractCertificate& held, int headings, const std::string& title) {
  const py::gil_scoped_release unlocked;
  return picture_of_verdicts(held.certificate, contract_verdict_map(held.certificate, headings),
                             title);
}

}  // namespace

void bind_contract_certificate(py::module_& m) {
  py::class_<HeldContractCertificate, std::shared_ptr<HeldContractCertificate>> certificate(
      m, "ContractCertificate",
      "What was proved about a plan of every vehicle that keeps a contract: a verdict for every "
      "place and heading; of a path, that it is followed, and how near. docs/trust.md explains why "
      "it can be trusted; fairway.check proves it again with a separate program.");
  add_command(certificate);
  add_degrees(certificate);
  add_grid(certificate, [](const HeldContractCertificate& held) { return held.certificate.grid; });
  certificate
      .def("query", &query, "states"_a, py::kw_only(), "search"_a = true,
           R"(Looks up the proved verdicts of states, in microseconds each.

states  float64 [n, 3]: x_m, y_m, heading_rad
search  from undecided states, search for a behaviour within the contract that fails: found, the
        state is AT_RISK. Takes longer, the more states are undecided

Returns (verdict int8 [n], time_bound_s float64 [n]): codes of Verdict; a bound in seconds for
states that reach or follow, until they reach the goal or have joined the path, else +inf.)")
      .def("witness", &witness, "state"_a,
           R"(How a vehicle within the contract may fail from a state (x_m, y_m, heading_rad).

Returns float64 [steps + 1, 9], a row at the start of each step and one at the end: time_s, x_m,
y_m, heading_rad, curvature_per_m (positive to the left), radius_m (NaN on straight steps), and the
command in force, errors included: command_rad, of the place command_x_m, command_y_m. The last
five are NaN in the last row. None where something is proved, or no such behaviour is found.)")
      .def("query_modes", &query_modes, "states"_a, py::kw_only(), "search"_a = true,
           R"(The same, and which mode of the plan to fly (docs/modes.md).

Returns (verdict int8 [n], time_bound_s float64 [n], mode int8 [n]): the first mode that is
proved to reach; 0 where none is, or where the plan has one.)")
      .def_property_readonly(
          "modes",
          [](const HeldContractCertificate& held) { return held.certificate.further_modes() + 1; },
          "Number of modes that are proved, the first included: 1, unless the plan has further "
          "ones.")
      .def("verdict_map", &verdict_map, "heading_rad"_a, py::kw_only(), "search"_a = true,
           R"(The verdict of a vehicle near every cell's middle, for one heading.

Returns int8 [ny, nx], the lowest row first, codes of Verdict. States and `search` are those of
Certificate.verdict_map and query.)")
      .def(
          "failing_states", &failing, "of_each"_a = 100, "seed"_a = 1,
          R"(Sampled states that are not proved to do what the mission asks: from safe starts with a
command first, then from buffer cells, last from cells that are cut off, each with at most
`of_each` of every verdict.

Returns (states float64 [n, 3], verdict int8 [n]); for each kind of cell states that are proved to
fail first, then those at risk, undecided ones last.)")
      .def_property_readonly(
          "contract",
          [](const HeldContractCertificate& held) {
            return python_of(json_of(held.certificate.contract));
          },
          "What the vehicle keeps, a dict as Plan.contract.")
      .def_property_readonly(
          "follow", [](const HeldContractCertificate& held) { return member_of(held, "follow"); },
          R"(What is proved of those that follow the path, or hold at the goal; None when the proof is
about neither. A dict, as in summary.json (docs/formats.md):

tube_m            no vehicle that follows is farther from the path, metres
tube_heading_rad  nor heads farther off its direction, radians
profile           the same by stretches of the path, a list of dicts: station_m where the stretch
                  begins, distance_m, heading_rad
length_m          of the path
lap_time_s        [least, most] seconds for a lap; of an open path [0, to its end]
hold_radius_m     only of a mission that holds: who reaches the goal is within this of it for ever)")
      .def_property_readonly(
          "volume_fraction",
          [](const HeldContractCertificate& held) { return member_of(held, "volume_fraction"); },
          "Shares of the volume of all states outside obstacles and goal, a dict by verdict.")
      .def_property_readonly(
          "volume_fraction_free",
          [](const HeldContractCertificate& held) {
            return member_of(held, "volume_fraction_free");
          },
          "The same for safe starts only.")
      .def_property_readonly(
          "volume_fraction_usable",
          [](const HeldContractCertificate& held) {
            return member_of(held, "volume_fraction_usable");
          },
          "The same for cells from which the plan leads to its mission.")
      .def_property_readonly("summary", &summary,
                             "What summary.json of verify says of the proof, a dict "
                             "(docs/formats.md): shares, follow, chokes, options, contract.")
      .def_property_readonly(
          "leaves",
          [](const HeldContractCertificate& held) { return held.certificate.verdicts.leaves(); },
          "Number of leaves of the proof.")
      .def_property_readonly(
          "parts_per_cell",
          [](const HeldContractCertificate& held) { return held.certificate.parts_per_cell; },
          "Parts along the side of a cell.")
      .def("picture", &picture, py::kw_only(), "headings"_a = VerdictMapOptions{}.headings,
           "title"_a = "",
           "A Picture of the verdicts, with one panel for each of `headings` headings.")
      .def(
          "save",
          [](const HeldContractCertificate& held, const std::filesystem::path& path, bool force) {
            const py::gil_scoped_release unlocked;
            write_contract_certificate(held.certificate, path,
                                       force ? Existing::replace : Existing::keep);
          },
          "path"_a, py::kw_only(), "force"_a = true,
          "Writes a contract certificate file (safetensors), whole or not at all. Replaces an "
          "existing file; with force=False raises InputError instead.")
      .def("save_geotiff", &save_geotiff, "path"_a, "headings_rad"_a = py::none(), py::kw_only(),
           "force"_a = true,
           "verdict_map() of each heading (default: eight, evenly spaced) as the bands of a "
           "GeoTIFF, georeferenced if the map was (docs/exchange.md).")
      .def("_repr_png_",
           [](const HeldContractCertificate& held) {
             return py::bytes(picture(held, VerdictMapOptions{}.headings, "").png);
           })
      .def("__repr__", [](const HeldContractCertificate& held) {
        return fmt::format("<fairway.ContractCertificate: {}, {} leaves>",
                           words_of(held.certificate.grid), held.certificate.verdicts.leaves());
      });
}

}  // namespace fairway::python
