// For tests: certificates made by the prover, for plans made by hand or at random.
#pragma once

#include <filesystem>
#include <string>

#include <nlohmann/json.hpp>

#include "fairway/certificate/certificate_file.hpp"
#include "fairway/verify/certify.hpp"
#include "fairway/verify/testing/plans_to_verify.hpp"

namespace fairway_check {

inline fairway::CertifyOptions quick_options() {
  fairway::CertifyOptions options;
  options.undecided_max = 0.02;
  options.samples = 20000;
  options.last_level = 9;
  return options;
}

/// Proves `plan` and writes the certificate to `path`.
inline void write_sample(const fairway::Plan& plan, const std::filesystem::path& path,
                         const fairway::CertifyOptions& options = quick_options()) {
  using nlohmann::json;
  fairway::Certificate c;
  c.grid = plan.grid;
  c.vehicle = plan.vehicle;
  c.heading_rad = plan.heading_rad;
  c.region = plan.region;
  c.kind = fairway::cell_kinds(plan.grid, plan.region, {});
  const fairway::PlanFlow loop(plan);
  fairway::Certified proved =
      fairway::certify(loop.flow(), loop.is_free, options, {}, {}, plan.further_rad());
  c.sections = std::move(proved.sections);
  c.mode_heading_rad = plan.mode_heading_rad;
  c.mode_sections = std::move(proved.further);
  json record{{"program", "test"},
              {"samples", proved.volume.samples},
              {"worst_time_s", proved.volume.worst_time_s}};
  const auto claim = [&record](const char* name, const auto& share) {
    for (int v = 0; v < fairway::verdict_count; ++v) {
      record[name][fairway::name_of(static_cast<fairway::Verdict>(v))] =
          share[static_cast<std::size_t>(v)];
    }
  };
  claim("volume_fraction", proved.volume.all);
  claim("volume_fraction_free", proved.volume.free);
  claim("volume_fraction_buffer", proved.volume.buffer);
  if (plan.further_modes() > 0) record["reach_by_mode"] = proved.volume.reach_by_mode;
  c.plan = fairway::plan_digests(plan);
  c.frame = plan.record.frame;
  c.evidence_json = record.dump();
  fairway::write_certificate(c, path, fairway::Existing::replace);
}

}  // namespace fairway_check
