#include "fairway/run/verification.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "fairway/base/error.hpp"
#include "fairway/base/heading.hpp"
#include "fairway/base/random.hpp"
#include "fairway/base/safetensors.hpp"
#include "fairway/bitmap/bitmap_backward.hpp"
#include "fairway/bitmap/bitmap_volume.hpp"
#include "fairway/certificate/certificate_file.hpp"
#include "fairway/certificate/proof_identity.hpp"
#include "fairway/run/verification_summary.hpp"
#include "fairway/run/version.hpp"
#include "fairway/simulate/flight.hpp"
#include "fairway/verify/images.hpp"
#include "fairway/verify/reprove.hpp"

namespace fairway {
namespace {

using nlohmann::json;

constexpr bool outcomes_have_the_numbers_of_their_verdicts() {
  for (const Outcome outcome : outcomes_in_order) {
    const auto verdict = static_cast<Verdict>(outcome);
    if (std::string_view(name_of(outcome)) != name_of(verdict)) return false;
  }
  return static_cast<int>(outcome_codes) <= verdict_count;
}
static_assert(outcomes_have_the_numbers_of_their_verdicts());

json options_json(const CertifyOptions& o) {
  return {
      {"undecided_max", o.undecided_max},
      {"time_limit_s", o.time_limit_s > 0.0 ? json(o.time_limit_s) : json()},
      {"memory_limit_mb",
       o.memory_limit_bytes > 0 ? json(static_cast<double>(o.memory_limit_bytes) / 1e6) : json()},
      {"samples", o.samples},
      {"seed", o.seed},
      {"last_level", o.last_level}};
}

json evidence_of(const CertifyOptions& options, const Certified& outcome) {
  json levels = json::array();
  for (const LevelRecord& level : outcome.levels) {
    levels.push_back({{"level", level.level},
                      {"leaves", level.leaves},
                      {"undecided_leaves", level.undecided},
                      {"undecided_volume", level.undecided_volume}});
  }
  return {{"program", program_version},
          {"options", options_json(options)},
          {"volume_fraction", shares_json(outcome.volume.all)},
          {"volume_fraction_free", shares_json(outcome.volume.free)},
          {"volume_fraction_buffer", shares_json(outcome.volume.buffer)},
          {"samples", outcome.volume.samples},
          {"worst_time_s", outcome.volume.worst_time_s},
          {"levels", std::move(levels)},
          {"stopped_by", name_of(outcome.stopped_by)}};
}

/// What an earlier certificate has of the same proof, proved again.
SectionVerdicts taken_over(EarlierProof&& earlier, const Certificate& now, int most_crossings) {
  Certificate& certificate = earlier.certificate;
  if (proof_identity(certificate) != proof_identity(now)) {
    throw InputError(earlier.where,
                     "belongs to a different plan, vehicle or region; cannot resume from it");
  }
  if (!sections_fit(now.flow(), certificate.sections)) {
    throw InputError(earlier.where, "has leaves where there are none; cannot resume from it");
  }
  return reproved(now.flow(), std::move(certificate.sections), most_crossings);
}

}  // namespace

Verification verify_plan(const Plan& plan, const std::string& where, const RegionOfInterest& region,
                         const CertifyOptions& options, std::optional<EarlierProof> earlier,
                         const CertifyProgress& progress) {
  if (!(plan.grid.cell_m < plan.vehicle.turn_radius_m)) {
    throw InputError(where, fmt::format("its cells of {:g} m are not smaller than the turning "
                                        "radius, {:g} m: such a plan cannot be verified",
                                        plan.grid.cell_m, plan.vehicle.turn_radius_m));
  }
  Verification made;
  made.options = options;
  Certificate& c = made.certificate;
  c.grid = plan.grid;
  c.vehicle = plan.vehicle;
  c.region_of_interest = region;
  c.heading_rad = plan.heading_rad;
  c.region = plan.region;
  c.kind = cell_kinds(plan.grid, plan.region, region);
  c.plan = plan_digests(plan);
  c.frame = plan.record.frame;
  std::vector<bool> is_free(plan.grid.size());
  for (std::size_t i = 0; i < is_free.size(); ++i) is_free[i] = plan.region[i] == Region::free;
  SectionVerdicts start;
  if (earlier) {
    start = taken_over(std::move(*earlier), c, options.most_crossings);
  }
  made.outcome = certify(c.flow(), is_free, options, std::move(start), progress);
  c.sections = std::move(made.outcome.sections);
  c.evidence_json = evidence_of(options, made.outcome).dump();
  return made;
}

BitmapVerification write_bitmap(const Plan& plan, const RegionOfInterest& region,
                                int samples_per_border, std::uint64_t seed,
                                const std::filesystem::path& file, Existing existing) {
  require_writable_place(file, existing);
  const std::vector<std::uint8_t> target = target_cells(plan.grid, plan.region, region);
  const BorderBitmap set = backward_reachable_set(plan, target, {samples_per_border});
  constexpr std::size_t draws = 200'000;
  const VolumeShare share = volume_share_reached(plan, target, set, draws, seed);
  BitmapVerification made;
  made.grid = plan.grid;
  made.plan = plan_digests(plan);
  made.samples_per_border = samples_per_border;
  made.seed = seed;
  made.border_states = set.borders().count() * set.states_per_border();
  made.share_of_border_states = set.share_reached();
  made.stored_bytes = set.bytes();
  made.estimated_reach = share.reached;
  made.standard_error = share.standard_error;
  std::vector<std::uint64_t> words(set.words.size());
  for (std::size_t i = 0; i < words.size(); ++i) words[i] = set.words[i];
  AtomicFile out(file, existing);
  write_safetensors(out, {{{"fairway", bitmap_record(made).dump(-1, ' ', true)}},
                          {{"border_words",
                            "U64",
                            {set.borders().count(), set.words_per_border()},
                            std::as_bytes(std::span(words))}}});
  out.commit();
  return made;
}

}  // namespace fairway
