#include "fairway/run/bitmap_verification.hpp"

#include <cmath>
#include <cstddef>

#include <fmt/format.h>

#include "fairway/base/error.hpp"
#include "fairway/base/share_text.hpp"
#include "fairway/bitmap/bitmap_backward.hpp"
#include "fairway/bitmap/bitmap_volume.hpp"
#include "fairway/plan/plan_digests.hpp"
#include "fairway/run/version.hpp"

namespace fairway {

using nlohmann::json;

BitmapVerification draw_bitmap(const Plan& plan, const std::string& where,
                               const RegionOfInterest& region, int samples_per_border,
                               std::uint64_t seed) {
  if (!(plan.grid.cell_m < plan.vehicle.turn_radius_m)) {
    throw InputError(where, fmt::format("its cells of {:g} m are not smaller than the turning "
                                        "radius of {:g} m, as a bitmap requires",
                                        plan.grid.cell_m, plan.vehicle.turn_radius_m));
  }
  BitmapVerification made;
  Bitmap& b = made.bitmap;
  b.vehicle = plan.vehicle;
  b.region_of_interest = region;
  b.heading_rad = plan.heading_rad;
  b.region = plan.region;
  b.kind = cell_kinds(plan.grid, plan.region, region);
  b.set = backward_reachable_set(plan, target_cells(plan.grid, plan.region, region),
                                 {samples_per_border});
  b.plan = plan_digests(plan);
  b.frame = plan.record.frame;
  constexpr std::size_t draws = 200'000;
  const VolumeShare share = volume_share_reached(BitmapLookup(b), draws, seed);
  made.estimated_reach = share.reached;
  made.standard_error = share.standard_error;
  b.evidence_json = json{
      {"program", program_version},
      {"options", {{"samples_per_border", samples_per_border}, {"seed", seed}}},
      {"border_states", b.set.borders().count() * b.set.states_per_border()},
      {"share_of_border_states", b.set.share_reached()},
      {"estimated_reach", made.estimated_reach},
      {"standard_error", made.standard_error},
      {"proved", false}}.dump();
  return made;
}

json verification_json(const BitmapVerification& v) {
  json summary = json::parse(record_text(v.bitmap));
  summary["method"] = "bitmap";
  summary["cells"] = {v.bitmap.grid().nx, v.bitmap.grid().ny};
  summary["stored_bytes"] = v.bitmap.set.bytes();
  return summary;
}

std::string estimated_reach_text(const BitmapVerification& v) {
  constexpr double two_sided_95 = 1.96;
  return percent_text(v.estimated_reach, two_sided_95 * v.standard_error < 0.002 ? 1 : 0);
}

std::string verification_words(const BitmapVerification& v) {
  return fmt::format(
      "Estimated from {0} positions and {0} headings on each border (a picture, not a proof): "
      "about {1} of all states outside obstacles and goal reach. Nothing is proved about the "
      "states between the samples.",
      v.bitmap.set.samples, estimated_reach_text(v));
}

}  // namespace fairway
