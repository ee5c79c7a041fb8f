// verify: plan -> verdicts.
#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "bind_certificate.hpp"
#include "bind_region.hpp"
#include "binding.hpp"
#include "fairway/run/contract_asked.hpp"
#include "fairway/run/contract_file.hpp"
#include "fairway/run/progress.hpp"
#include "fairway/run/verification.hpp"
#include "fairway/run/verification_summary.hpp"
#include "fairway/run/verify_limits.hpp"
#include "fairway/vehicle/contract_defect.hpp"
#include "fairway/vehicle/contract_json.hpp"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <nlohmann/json.hpp>

namespace fairway::python {
namespace {

using namespace pybind11::literals;

struct Limits {
  double undecided_max;
  std::optional<double> time_limit_s;
  std::optional<double> memory_limit_mb;

  void require_sense() const {
    if (!(undecided_max >= 0.0 && undecided_max <= 1.0)) {
      throw py::value_error("undecided_max: expected a share, 0 to 1");
    }
    for (const auto& [name, limit] :
         {std::pair{"time_limit_s", time_limit_s}, std::pair{"memory_limit_mb", memory_limit_mb}}) {
      if (limit && !(*limit > 0.0 && *limit < 1e12)) {
        throw py::value_error(std::string(name) + ": expected a number > 0, or None");
      }
    }
  }
  VerifyLimits limits() const {
    return {undecided_max, time_limit_s.value_or(0.0), memory_limit_mb};
  }
};

/// A dict as Plan.contract, or the path of a file with [vehicle.contract].
std::optional<VehicleContract> contract_from(const py::object& given, const Vehicle& vehicle) {
  if (given.is_none()) return {};
  if (!py::isinstance<py::dict>(given)) {
    return read_contract(given.cast<std::filesystem::path>(), vehicle);
  }
  const auto text = py::module_::import("json").attr("dumps")(given).cast<std::string>();
  VehicleContract contract = contract_of(nlohmann::json::parse(text), "contract");
  require_contract(contract, vehicle, "contract");
  return contract;
}

py::object verify(const std::shared_ptr<HeldPlan>& plan, const py::object& region,
                  const std::string& method, const py::object& contract, int parts_per_cell,
                  double undecided_max, std::optional<double> time_limit_s,
                  std::optional<double> memory_limit_mb, std::size_t samples, std::uint64_t seed,
                  const py::object& resume, const py::object& progress) {
  const Limits limits{undecided_max, time_limit_s, memory_limit_mb};
  limits.require_sense();
  if (parts_per_cell < 0 || parts_per_cell > 16) {
    throw py::value_error("parts_per_cell: expected 1 to 16, or 0");
  }
  const RegionOfInterest of_interest = region_from(region, plan->plan);
  ProofRequest request;
  request.method = choice_of<std::string>(
      "method", method, {{"", ""}, {"certified", "certified"}, {"contract", "contract"}});
  request.contract = contract_from(contract, plan->plan.vehicle);
  if (request.contract && method == "certified") {
    throw py::value_error("contract: goes with method \"contract\"");
  }
  request.resumes = !resume.is_none();
  const bool of_contract = py::isinstance<HeldContractCertificate>(resume);
  if (request.resumes && !of_contract && !py::isinstance<HeldCertificate>(resume)) {
    throw py::type_error("resume: expected a Certificate or a ContractCertificate");
  }
  std::optional<EarlierContractProof> earlier;
  if (of_contract) {
    earlier = {resume.cast<const HeldContractCertificate&>().certificate, "resume"};
    request.earlier = &*earlier;
  }
  const auto asked = contract_asked(plan->plan, "plan", of_interest, request);
  if (request.resumes && of_contract != asked.has_value()) {
    throw py::value_error(of_contract ? "resume: is a ContractCertificate, expected a Certificate"
                                      : "resume: is a Certificate of the exact vehicle, expected a "
                                        "ContractCertificate; or method=\"certified\"");
  }
  const Progress told = progress_of(progress);
  if (asked) {
    std::shared_ptr<HeldContractCertificate> held;
    {
      const py::gil_scoped_release unlocked;
      ContractVerifyOptions options;
      options.parts_per_cell = parts_per_cell;
      options.limits = limits.limits();
      options.seed = seed;
      if (samples != CertifyOptions{}.samples) options.samples = samples;
      ContractVerification made = verify_asked(
          plan->plan, "plan", of_interest, *asked, options,
          [&told](const std::string& doing) {
            if (told) told(doing, {});
          },
          earlier ? &*earlier : nullptr);
      if (!is_for_exact_verdicts(made)) {
        held = std::make_shared<HeldContractCertificate>(std::move(made.certificate));
      }
    }
    if (held) return py::cast(held);
  }

  std::shared_ptr<HeldCertificate> held;
  std::optional<EarlierProof> exact;
  if (request.resumes) exact = {resume.cast<const HeldCertificate&>().certificate, "resume"};
  {
    const py::gil_scoped_release unlocked;
    if (told) told("verifying", {});
    Verification made = verify_plan(plan->plan, "plan", of_interest,
                                    certify_options(limits.limits(), seed, samples),
                                    std::move(exact), [&told](const LevelRecord& level) {
                                      if (told) told(level_words(level), {});
                                    });
    held = std::make_shared<HeldCertificate>(HeldCertificate{std::move(made.certificate)});
  }
  return py::cast(held);
}

}  // namespace

void bind_verify(py::module_& m) {
  const CertifyOptions d;
  m.def("verify", &verify, "plan"_a, py::kw_only(), "region"_a = "goal", "method"_a = "",
        "contract"_a = py::none(), "parts_per_cell"_a = 0, "undecided_max"_a = d.undecided_max,
        "time_limit_s"_a = py::none(), "memory_limit_mb"_a = py::none(), "samples"_a = d.samples,
        "seed"_a = d.seed, "resume"_a = py::none(), "progress"_a = py::none(),
        R"(Proves, for every place and heading, what the vehicle does under `plan`.

region           region to be reached: "goal", "obstacle", the cells wholly inside
                 (x0, y0, x1, y1), metres, or any cells: a mask bool [ny, nx], a polygon [n, 2]
                 of corners x_m, y_m that they lie wholly in, or a pathlib.Path of a file
                 (GeoJSON areas, or CSV ix,iy)
method           "certified": of the exact vehicle; "contract": of every vehicle that keeps the
                 contract; "": under a contract where there is one, given or the plan's, and of
                 a path, or of a goal to hold at, that it is followed
contract         what the vehicle keeps: a dict as Plan.contract, or the path of a file with
                 [vehicle.contract]
parts_per_cell   under a contract: parts along the side of a cell, 1 to 16; finer proves more,
                 and takes longer; 0: by the contract's command error
undecided_max    of the exact vehicle: stop once at most this share of the volume is undecided
time_limit_s     stop after this many seconds
memory_limit_mb  stop before using more memory than this, megabytes
samples, seed    random states that measure the volumes
resume           a Certificate of the same plan, vehicle and region to continue from, or a
                 ContractCertificate of the same contract, too; its leaves are proved again first
progress         called as progress(stage, left_s) now and then in the calling thread; left_s is
                 None when unknown; an exception it raises, or Ctrl-C, stops the work

Returns a Certificate, or under a contract a ContractCertificate. Where the exact vehicle is not
proved to follow a path, a Certificate: its verdicts tell who touches the path. Raises ValueError
when the plan cannot be verified.)");
}

}  // namespace fairway::python
