// certificate: what was proved, and queries.
#include "bind_certificate.hpp"

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <nlohmann/json.hpp>

#include "bind_grid.hpp"
#include "binding.hpp"
#include "fairway/base/file_kind.hpp"
#include "fairway/base/mapped_file.hpp"
#include "fairway/certificate/certificate_file.hpp"
#include "fairway/certificate/contract_certificate_file.hpp"
#include "fairway/exchange/plan_rasters.hpp"
#include "fairway/report/draw_verdicts.hpp"
#include "fairway/run/ask_certificate.hpp"
#include "fairway/run/checker.hpp"
#include "fairway/run/failing_states.hpp"
#include "fairway/vehicle/modes.hpp"
#include "fairway/verify/sample_verdicts.hpp"
#include "fairway/verify/verdict.hpp"

namespace fairway::python {
namespace {

using namespace pybind11::literals;

void require_finite(double heading_rad) {
  if (!std::isfinite(heading_rad)) throw py::value_error("heading_rad: is not finite");
  require_heading(heading_rad, "heading_rad");
}

py::tuple query_modes(const HeldCertificate& held, const py::object& rows) {
  const std::vector<State> states = states_of(rows, "states");
  std::vector<std::int8_t> verdict(states.size());
  std::vector<double> time_s(states.size());
  std::vector<std::int8_t> mode(states.size());
  {
    const py::gil_scoped_release unlocked;
    const std::vector<runtime::Answer> answers = ask(held.certificate, states);
    for (std::size_t i = 0; i < answers.size(); ++i) {
      verdict[i] = static_cast<std::int8_t>(answers[i].verdict);
      time_s[i] = answers[i].time_bound_s;
      mode[i] = static_cast<std::int8_t>(answers[i].mode);
    }
  }
  return py::make_tuple(owning(std::move(verdict)), owning(std::move(time_s)),
                        owning(std::move(mode)));
}

py::tuple query(const HeldCertificate& held, const py::object& rows) {
  const py::tuple all = query_modes(held, rows);
  return py::make_tuple(all[0], all[1]);
}

/// As int8, to which all modes convert, and no_mode to -1.
py::array mode_map(const HeldCertificate& held, double heading_rad) {
  require_finite(heading_rad);
  std::vector<std::uint8_t> modes;
  {
    const py::gil_scoped_release unlocked;
    modes = modes_at(held.certificate, Heading::from_rad(heading_rad));
  }
  std::vector<std::int8_t> codes;
  for (const std::uint8_t mode : modes) codes.push_back(static_cast<std::int8_t>(mode));
  const Grid& grid = held.certificate.grid;
  return owning(std::move(codes)).reshape({grid.ny, grid.nx});
}

py::array verdict_map(const HeldCertificate& held, double heading_rad) {
  require_finite(heading_rad);
  std::vector<Verdict> verdicts;
  {
    const py::gil_scoped_release unlocked;
    verdicts = verdicts_at(held.certificate, Heading::from_rad(heading_rad));
  }
  auto* kept = new std::vector<Verdict>(std::move(verdicts));
  const py::capsule owner(kept, [](void* p) { delete static_cast<std::vector<Verdict>*>(p); });
  const Grid& grid = held.certificate.grid;
  return py::array(py::dtype::of<std::int8_t>(), std::vector<py::ssize_t>{grid.ny, grid.nx},
                   std::vector<py::ssize_t>{grid.nx, 1},
                   reinterpret_cast<const std::int8_t*>(kept->data()), owner);
}

nlohmann::json record_of(const HeldCertificate& held) {
  return nlohmann::json::parse(record_text(held.certificate));
}

/// One member of the record as a dict; None if a file written by another program lacks it.
py::object member_of(const HeldCertificate& held, const char* name) {
  const nlohmann::json record = record_of(held);
  return record.contains(name) ? python_of(record[name]) : py::none();
}

py::tuple failing(const HeldCertificate& held, std::size_t of_each, std::uint64_t seed) {
  std::vector<State> states;
  std::vector<std::int8_t> verdicts;
  {
    const py::gil_scoped_release unlocked;
    for (const FailingState& state : failing_states(held.certificate, of_each, seed)) {
      states.push_back(state.start);
      verdicts.push_back(static_cast<std::int8_t>(state.verdict));
    }
  }
  return py::make_tuple(state_array(std::move(states)), owning(std::move(verdicts)));
}

void save_geotiff(const HeldCertificate& held, const std::filesystem::path& path,
                  const std::optional<std::vector<double>>& headings_rad, bool force) {
  std::vector<Heading> headings = even_headings(VerdictMapOptions{}.headings);
  if (headings_rad) {
    headings.clear();
    for (const double rad : *headings_rad) {
      if (!std::isfinite(rad)) throw py::value_error("headings_rad: not all are finite");
      require_heading(rad, "headings_rad: one");
      headings.push_back(Heading::from_rad(rad));
    }
  }
  const py::gil_scoped_release unlocked;
  write_verdict_raster(held.certificate.grid, held.certificate.frame.value_or(Frame{}),
                       verdict_layers(held.certificate, headings), path,
                       force ? Existing::replace : Existing::keep);
}

VerdictMap sampled(const HeldCertificate& held, int headings, int states) {
  VerdictMapOptions options;
  options.headings = headings;
  options.states_per_sample = states;
  return verdict_map_of(held.certificate.view(), options);
}

Picture picture(const HeldCertificate& held, int headings, const std::string& title) {
  const py::gil_scoped_release unlocked;
  return draw_verdicts(sampled(held, headings, 0), {.title = title});
}

Picture shares_picture(const HeldCertificate& held, const std::string& title) {
  const py::gil_scoped_release unlocked;
  return draw_proved_shares(sampled(held, 1, VerdictMapOptions{}.states_per_sample),
                            {.title = title});
}

py::object check(const std::filesystem::path& path, const py::object& plan) {
  std::vector<std::string> words{path.string(), "--json"};
  if (!plan.is_none()) {
    words.insert(words.end(), {"--plan", plan.cast<std::filesystem::path>().string()});
  }
  CheckRun run;
  {
    const py::gil_scoped_release unlocked;
    run = run_checker(std::move(words), true);
  }
  if (run.exit_code == 0 || run.exit_code == 1) return python_of_json(run.output);
  if (run.exit_code == 127) {
    throw std::runtime_error(
        "cannot run fairway-check: expected in the bin/ of the folder that fairway was installed "
        "to, or on the PATH");
  }
  if (run.exit_code == 65) throw py::value_error(run.output);
  throw std::runtime_error(run.output);
}

}  // namespace

void bind_certificate(py::module_& m) {
  std::vector<std::pair<const char*, int>> codes;
  for (int v = 0; v < verdict_count; ++v) codes.emplace_back(name_of(static_cast<Verdict>(v)), v);
  codes.emplace_back("at_risk", at_risk_code);
  add_enum(m, "Verdict",
           "What is proved about a state, as returned by Certificate.query. AT_RISK, of a "
           "ContractCertificate alone: some behaviour within the contract fails, and is known.",
           codes);

  py::class_<HeldCertificate, std::shared_ptr<HeldCertificate>> certificate(
      m, "Certificate",
      "What was proved about a plan: a verdict for every place and heading. docs/trust.md explains "
      "why it can be trusted; fairway.check proves it again with a separate program.");
  add_command(certificate);
  add_degrees(certificate);
  add_grid(certificate, [](const HeldCertificate& held) { return held.certificate.grid; });
  certificate
      .def("query", &query, "states"_a,
           R"(Looks up the proved verdicts of states, in about a microsecond each.

states  float64 [n, 3]: x_m, y_m, heading_rad

Returns (verdict int8 [n], time_bound_s float64 [n]): codes of Verdict; a bound in seconds
for states that reach, else +inf.)")
      .def("query_modes", &query_modes, "states"_a,
           R"(The same, and which mode of the plan to fly (docs/modes.md).

Returns (verdict int8 [n], time_bound_s float64 [n], mode int8 [n]): the first mode that is
proved to reach; 0 where none is, or where the plan has one.)")
      .def_property_readonly(
          "modes", [](const HeldCertificate& held) { return held.certificate.further_modes() + 1; },
          "Number of modes of the plan, the first included: 1, unless it has further ones.")
      .def("mode_map", &mode_map, "heading_rad"_a,
           R"(The first mode that is proved to reach from near every cell's middle, for one heading.

Returns int8 [ny, nx], the lowest row first: -1 where none is, and in obstacles; 0 in the goal. Of
the same states as verdict_map.)")
      .def("verdict_map", &verdict_map, "heading_rad"_a,
           R"(The verdict of a vehicle near every cell's middle, for one heading.

Returns int8 [ny, nx], the lowest row first, codes of Verdict; collide in an obstacle, reach in
the goal. The states are cell_m / 37 and cell_m / 53 off the middle and 0.0005 rad off the heading,
because flights from the exact middle meet ties that have no volume.)")
      .def(
          "failing_states", &failing, "of_each"_a = 100, "seed"_a = 1,
          R"(Sampled states that do not reach: from safe starts with a command first, then from buffer
cells, last from cells that are cut off, each with at most `of_each` of every other verdict.

Returns (states float64 [n, 3], verdict int8 [n]); for each kind of cell failures first, undecided
states last. Fly them with Plan.fly to see why they fail.)")
      .def_property_readonly(
          "volume_fraction",
          [](const HeldCertificate& held) { return member_of(held, "volume_fraction"); },
          "Shares of the volume of all states outside obstacles and goal, a dict by verdict.")
      .def_property_readonly(
          "volume_fraction_free",
          [](const HeldCertificate& held) { return member_of(held, "volume_fraction_free"); },
          "The same for safe starts only.")
      .def_property_readonly(
          "summary", [](const HeldCertificate& held) { return python_of(record_of(held)); },
          "The full record of the proof, a dict (docs/formats.md): shares, options, levels, "
          "why it stopped, digests of the plan.")
      .def_property_readonly(
          "leaves", [](const HeldCertificate& held) { return held.certificate.sections.leaves(); },
          "Number of leaves of the proof.")
      .def("picture", &picture, py::kw_only(), "headings"_a = VerdictMapOptions{}.headings,
           "title"_a = "",
           "A Picture of the verdicts, with one panel for each of `headings` headings.")
      .def("shares_picture", &shares_picture, py::kw_only(), "title"_a = "",
           "A Picture of the shares of headings proved to reach, to fail, and undecided, per cell.")
      .def(
          "save",
          [](const HeldCertificate& held, const std::filesystem::path& path, bool force) {
            const py::gil_scoped_release unlocked;
            write_certificate(held.certificate, path, force ? Existing::replace : Existing::keep);
          },
          "path"_a, py::kw_only(), "force"_a = true,
          "Writes a certificate file (safetensors), whole or not at all. Replaces an existing "
          "file; "
          "with force=False raises InputError instead.")
      .def("save_geotiff", &save_geotiff, "path"_a, "headings_rad"_a = py::none(), py::kw_only(),
           "force"_a = true,
           "verdict_map() of each heading (default: eight, evenly spaced) as the bands of a "
           "GeoTIFF, then the mode that serves each place if the plan has several; georeferenced "
           "if the map was (docs/exchange.md).")
      .def("_repr_png_",
           [](const HeldCertificate& held) {
             return py::bytes(picture(held, VerdictMapOptions{}.headings, "").png);
           })
      .def("__repr__", [](const HeldCertificate& held) {
        return fmt::format("<fairway.Certificate: {}, {} leaves>", words_of(held.certificate.grid),
                           held.certificate.sections.leaves());
      });

  m.def(
      "load_certificate",
      [](const std::filesystem::path& path) -> py::object {
        std::shared_ptr<HeldCertificate> exact;
        std::shared_ptr<HeldContractCertificate> under_contract;
        {
          const py::gil_scoped_release unlocked;
          if (kind_of_bytes(MappedFile(path).bytes()) == FileKind::contract_certificate) {
            under_contract =
                std::make_shared<HeldContractCertificate>(read_contract_certificate(path));
          } else {
            exact = std::make_shared<HeldCertificate>(HeldCertificate{read_certificate(path)});
          }
        }
        return exact ? py::cast(exact) : py::cast(under_contract);
      },
      "path"_a,
      "Reads a certificate file of either kind and checks its digests, not its proof; see check(). "
      "Returns a Certificate or a ContractCertificate. Raises InputError (a ValueError).");

  m.def("check", &check, "path"_a, "plan"_a = py::none(),
        R"(Proves a certificate file again with the separate program fairway-check.

plan  path of the plan file that the certificate must belong to

Returns its report, a dict: "accepted" is True or False, "reason" says why not. Raises ValueError
for a file that is not a certificate, RuntimeError if the program cannot be run.)");
}

}  // namespace fairway::python
