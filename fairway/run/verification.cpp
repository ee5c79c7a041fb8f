#include "fairway/run/verification.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
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
#include "fairway/run/version.hpp"
#include "fairway/verify/images.hpp"
#include "fairway/verify/reprove.hpp"

namespace fairway {
namespace {

using nlohmann::json;

json fractions_json(const std::array<double, verdict_count>& share) {
  json by_name = json::object();
  for (int v = 0; v < verdict_count; ++v) {
    by_name[name_of(static_cast<Verdict>(v))] = share[static_cast<std::size_t>(v)];
  }
  return by_name;
}

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
          {"volume_fraction", fractions_json(outcome.volume.all)},
          {"volume_fraction_free", fractions_json(outcome.volume.free)},
          {"volume_fraction_buffer", fractions_json(outcome.volume.buffer)},
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

std::string percent(double share) { return fmt::format("{:.3f} %", 100.0 * share); }

double share_of(const std::array<double, verdict_count>& volume, Verdict verdict) {
  return volume[static_cast<std::size_t>(verdict)];
}

/// Places that the goal cannot be reached from count against no plan.
std::string commanded_words(const VolumeFractions& volume) {
  const double reach = share_of(volume.commanded, Verdict::reach);
  if (percent(reach) == percent(share_of(volume.free, Verdict::reach))) return "";
  return fmt::format(" ({} of those in cells from which the goal can be reached)", percent(reach));
}

}  // namespace

Verification verify_plan(const Plan& plan, const std::string& where, const RegionOfInterest& region,
                         const CertifyOptions& options, std::optional<EarlierProof> earlier,
                         StageClock& clock) {
  if (!(plan.grid.cell_m < plan.vehicle.turn_radius_m)) {
    throw InputError(where, fmt::format("its cells of {:g} m are not smaller than the turning "
                                        "radius, {:g} m: such a plan cannot be verified",
                                        plan.grid.cell_m, plan.vehicle.turn_radius_m));
  }
  Verification made;
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
  made.outcome = certify(c.flow(), is_free, options, std::move(start), [&](const LevelRecord& l) {
    clock.rename(fmt::format("verifying, {:.2f} % undecided", 100.0 * l.undecided_volume));
    clock.tell(unknown_time);
  });
  c.sections = std::move(made.outcome.sections);
  c.evidence_json = evidence_of(options, made.outcome).dump();
  made.summary = json::parse(record_text(c));
  made.summary["volume_fraction_free_commanded"] = fractions_json(made.outcome.volume.commanded);
  made.summary["method"] = "certified";
  made.summary["cells"] = {plan.grid.nx, plan.grid.ny};
  made.summary["leaves"] = c.sections.leaves();
  return made;
}

std::string verification_words(const Verification& v) {
  const VolumeFractions& volume = v.outcome.volume;
  std::string words = fmt::format(
      "Proved for every heading and place: of the safe-start states {} reach{}, of all states "
      "outside obstacles and target {} reach, {} collide, {} leave, {} circle forever; {} are "
      "undecided",
      percent(share_of(volume.free, Verdict::reach)), commanded_words(volume),
      percent(share_of(volume.all, Verdict::reach)),
      percent(share_of(volume.all, Verdict::collide)),
      percent(share_of(volume.all, Verdict::leave)),
      percent(share_of(volume.all, Verdict::trapped)),
      percent(share_of(volume.all, Verdict::undecided)));
  words += fmt::format(" (shares of volume, from {} sampled states, each proved).", volume.samples);
  if (volume.worst_time_s > 0.0) {
    words += fmt::format(" No sampled state that reaches takes longer than {:.1f} s.",
                         volume.worst_time_s);
  }
  switch (v.outcome.stopped_by) {
    case StoppedBy::time_limit:
      words += " The time limit ended the work.";
      break;
    case StoppedBy::memory_limit:
      words += " The memory limit ended the work.";
      break;
    case StoppedBy::last_level:
      words += " The finest leaves ended the work.";
      break;
    case StoppedBy::stalled:
      words += " Smaller leaves had stopped deciding more.";
      break;
    case StoppedBy::undecided_max:
      break;
  }
  return words +
         " Assumed: the exact kinematic model, without wind or delay, and a map that does not "
         "change.";
}

std::vector<FailingState> failing_states(const Certificate& certificate, std::size_t of_each,
                                         std::uint64_t seed) {
  const Flow flow = certificate.flow();
  std::vector<std::size_t> cells;
  for (std::size_t i = 0; i < flow.grid.size(); ++i) {
    if (flow.kind[i] == CellKind::ordinary) cells.push_back(i);
  }
  if (cells.empty()) return {};
  constexpr std::size_t draws = 200'000;
  std::vector<Place> states(draws);
  for (std::size_t k = 0; k < draws; ++k) {
    Random random = Random::stream(seed, k);
    const Cell cell = certificate.grid.cell_at(cells[random.below(cells.size())]);
    const Vec2 corner = certificate.grid.corner(cell);
    states[k] = {corner.x + random.unit() * flow.grid.cell_m,
                 corner.y + random.unit() * flow.grid.cell_m, random.uniform(-pi, pi)};
  }
  const ImageStore images =
      state_images(flow, states, CertifyOptions{}.most_crossings, [] { return true; });
  std::array<std::vector<FailingState>, verdict_count> found;
  for (std::size_t k = 0; k < draws; ++k) {
    const Verdict verdict = verdicts_of(images[k], certificate.sections.view()).only();
    auto& alike = found[static_cast<std::size_t>(verdict)];
    if (verdict == Verdict::reach || alike.size() == of_each) continue;
    const Place& p = states[k];
    alike.push_back({{{p.x_m, p.y_m}, Heading::from_rad(p.heading_rad)}, verdict});
  }
  std::vector<FailingState> failing;
  for (const Verdict verdict :
       {Verdict::collide, Verdict::leave, Verdict::trapped, Verdict::undecided}) {
    const auto& alike = found[static_cast<std::size_t>(verdict)];
    failing.insert(failing.end(), alike.begin(), alike.end());
  }
  return failing;
}

std::string failing_states_csv(const std::vector<FailingState>& states) {
  std::string text = "x_m,y_m,heading_rad,verdict\n";
  for (const FailingState& state : states) {
    const Vec2 p = state.start.position_m;
    text +=
        fmt::format("{},{},{},{}\n", p.x, p.y, state.start.heading.rad(), name_of(state.verdict));
  }
  return text;
}

json write_bitmap(const Plan& plan, const RegionOfInterest& region, int samples, std::uint64_t seed,
                  const std::filesystem::path& file, Existing existing) {
  require_writable_place(file, existing);
  const std::vector<std::uint8_t> target = target_cells(plan.grid, plan.region, region);
  const BorderBitmap set = backward_reachable_set(plan, target, {samples});
  constexpr std::size_t draws = 200'000;
  const VolumeShare share = volume_share_reached(plan, target, set, draws, seed);
  json record = {
      {"format", "fairway-bitmap"},    {"format_version", 1},
      {"program", program_version},    {"method", "bitmap"},
      {"samples_per_border", samples}, {"plan_sha256", json::parse(json_text(plan_digests(plan)))}};
  std::vector<std::uint64_t> words(set.words.size());
  for (std::size_t i = 0; i < words.size(); ++i) words[i] = set.words[i];
  AtomicFile out(file, existing);
  write_safetensors(out, {{{"fairway", record.dump(-1, ' ', true)}},
                          {{"border_words",
                            "U64",
                            {set.borders().count(), set.words_per_border()},
                            std::as_bytes(std::span(words))}}});
  out.commit();
  record["cells"] = {plan.grid.nx, plan.grid.ny};
  record["options"] = {{"samples_per_border", samples}, {"seed", seed}};
  record["border_states"] = set.borders().count() * set.states_per_border();
  record["share_of_border_states"] = set.share_reached();
  record["stored_bytes"] = set.bytes();
  record["estimated_reach"] = share.reached;
  record["standard_error"] = share.standard_error;
  record["proved"] = false;
  return record;
}

}  // namespace fairway
