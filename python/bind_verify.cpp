// verify: plan -> verdicts.
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "bind_certificate.hpp"
#include "bind_region.hpp"
#include "binding.hpp"
#include "fairway/run/progress.hpp"
#include "fairway/run/verification.hpp"
#include "fairway/run/verification_summary.hpp"
#include "fairway/run/verify_limits.hpp"

#include <pybind11/stl.h>

namespace fairway::python {
namespace {

using namespace pybind11::literals;

std::shared_ptr<HeldCertificate> verify(const std::shared_ptr<HeldPlan>& plan,
                                        const py::object& region, double undecided_max,
                                        std::optional<double> time_limit_s,
                                        std::optional<double> memory_limit_mb, std::size_t samples,
                                        std::uint64_t seed,
                                        const std::shared_ptr<HeldCertificate>& resume,
                                        const py::object& progress) {
  if (!(undecided_max >= 0.0 && undecided_max <= 1.0)) {
    throw py::value_error("undecided_max: expected a share, 0 to 1");
  }
  for (const auto& [name, limit] :
       {std::pair{"time_limit_s", time_limit_s}, std::pair{"memory_limit_mb", memory_limit_mb}}) {
    if (limit && !(*limit > 0.0 && *limit < 1e12)) {
      throw py::value_error(std::string(name) + ": expected a number > 0, or None");
    }
  }
  const CertifyOptions options =
      certify_options({undecided_max, time_limit_s.value_or(0.0), memory_limit_mb}, seed, samples);
  const RegionOfInterest of_interest = region_from(region, plan->plan);
  const Progress told = progress_of(progress);

  const py::gil_scoped_release unlocked;
  std::optional<EarlierProof> earlier;
  if (resume) earlier = EarlierProof{resume->certificate, "resume"};
  if (told) told("verifying", {});
  Verification made = verify_plan(plan->plan, "plan", of_interest, options, std::move(earlier),
                                  [&told](const LevelRecord& level) {
                                    if (told) told(level_words(level), {});
                                  });
  return std::make_shared<HeldCertificate>(HeldCertificate{std::move(made.certificate)});
}

}  // namespace

void bind_verify(py::module_& m) {
  const CertifyOptions d;
  m.def("verify", &verify, "plan"_a, py::kw_only(), "region"_a = "goal",
        "undecided_max"_a = d.undecided_max, "time_limit_s"_a = py::none(),
        "memory_limit_mb"_a = py::none(), "samples"_a = d.samples, "seed"_a = d.seed,
        "resume"_a = nullptr, "progress"_a = py::none(),
        R"(Proves, for every place and heading, what the vehicle does under `plan`.

region           region to be reached: "goal", "obstacle", the cells wholly inside
                 (x0, y0, x1, y1), metres, or any cells: a mask bool [ny, nx], a polygon [n, 2]
                 of corners x_m, y_m that they lie wholly in, or a pathlib.Path of a file
                 (GeoJSON areas, or CSV ix,iy)
undecided_max    stop once at most this share of the volume is undecided
time_limit_s     stop after this many seconds
memory_limit_mb  stop before using more memory than this, megabytes
samples, seed    random states that measure the volumes
resume           a Certificate of the same plan, vehicle and region to continue from; its
                 leaves are proved again first
progress         called as progress(stage, left_s) now and then in the calling thread; left_s is
                 None when unknown; an exception it raises, or Ctrl-C, stops the work

Returns a Certificate. Raises ValueError when the plan cannot be verified.)");
}

}  // namespace fairway::python
