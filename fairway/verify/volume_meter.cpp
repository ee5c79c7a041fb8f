#include "fairway/verify/volume_meter.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "fairway/base/error.hpp"
#include "fairway/base/parallel.hpp"
#include "fairway/base/random.hpp"

namespace fairway {
namespace {

constexpr std::size_t least_samples = 1000;  // fewer give a meaningless share

/// The states that measure volumes: equally many in every cell that is neither obstacle nor target,
/// one in each of equal slices of heading.
std::vector<Place> sampled_states(const Flow& flow, const CertifyOptions& options) {
  std::vector<Place> states;
  std::size_t cells = 0;
  for (std::size_t c = 0; c < flow.grid.size(); ++c) cells += flow.kind[c] == CellKind::ordinary;
  if (cells == 0) return states;
  const std::size_t each = std::max(options.samples / cells, (least_samples + cells - 1) / cells);
  states.reserve(each * cells);
  for (std::size_t c = 0; c < flow.grid.size(); ++c) {
    if (flow.kind[c] != CellKind::ordinary) continue;
    Random random = Random::stream(options.seed, c);
    const double d = flow.grid.cell_m;
    const double x =
        flow.grid.x0_m + static_cast<double>(c % static_cast<std::size_t>(flow.grid.nx)) * d;
    const double y =
        flow.grid.y0_m + static_cast<double>(c / static_cast<std::size_t>(flow.grid.nx)) * d;
    for (std::size_t k = 0; k < each; ++k) {
      const double turn = (static_cast<double>(k) + random.unit()) / static_cast<double>(each);
      states.push_back(
          {x + random.unit() * d, y + random.unit() * d, std::numbers::pi * (1.0 - 2.0 * turn)});
    }
  }
  return states;
}

std::vector<std::uint32_t> numbers_below(std::size_t count) {
  require(count <= ~std::uint32_t{0}, "there are fewer than 2^32 samples");
  std::vector<std::uint32_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), std::uint32_t{0});
  return numbers;
}

}  // namespace

VolumeMeter::VolumeMeter(const Flow& flow, const std::vector<bool>& is_free,
                         const CertifyOptions& options, bool has_modes)
    : flow_(flow),
      is_free_(is_free),
      most_crossings_(options.most_crossings),
      states_(sampled_states(flow, options)),
      asked_(numbers_below(states_.size())),
      images_(state_images(flow, states_, options.most_crossings, [] { return true; })),
      found_(states_.size()),
      mode_(states_.size(), 0) {
  if (!has_modes) states_ = std::vector<Place>();
}

void VolumeMeter::begin_mode(const Flow& flow) {
  ++now_;
  std::vector<Place> places;
  std::erase_if(asked_, [&](std::size_t i) { return found_[i].only() == Verdict::reach; });
  for (const std::size_t i : asked_) places.push_back(states_[i]);
  images_ = state_images(flow, places, most_crossings_, [] { return true; });
}

VolumeFractions VolumeMeter::measure(const Prover& prover) {
  for_ranges(asked_.size(), 4096, [&](std::size_t a, std::size_t b) {
    for (std::size_t k = a; k < b; ++k) {
      const std::size_t i = asked_[k];
      const Verdict known = found_[i].only();
      if (known == Verdict::reach || (now_ == 0 && known != Verdict::undecided)) continue;
      const Image image = images_[k];
      VerdictSet found = image.ends;
      if (image.gave_up) found.add(Verdict::undecided, 0.0);
      for (const ImagePiece& piece : image.pieces) {
        prover.look_up(piece.section, piece.range, static_cast<double>(piece.flown_s), found);
      }
      if (now_ > 0 && found.only() != Verdict::reach) continue;
      found_[i] = found;
      mode_[i] = now_;
    }
  });
  return fractions();
}

VolumeFractions VolumeMeter::fractions() const {
  VolumeFractions volume;
  volume.samples = found_.size();
  volume.reach_by_mode.assign(now_ + std::size_t{1}, 0.0);
  const auto cells = static_cast<std::size_t>(
      std::count(flow_.kind, flow_.kind + flow_.grid.size(), CellKind::ordinary));
  const std::size_t each = cells == 0 ? 0 : found_.size() / cells;
  std::size_t free_count = 0;
  std::size_t commanded_count = 0;
  std::size_t usable_count = 0;
  std::size_t i = 0;  // the states are ordered by cell, as they were drawn
  for (std::size_t c = 0; c < flow_.grid.size(); ++c) {
    if (flow_.kind[c] != CellKind::ordinary) continue;
    for (std::size_t k = 0; k < each; ++k, ++i) {
      const Verdict verdict = flow_.told(found_[i].only(), flow_.grid.cell_at(c));
      const auto v = static_cast<std::size_t>(verdict);
      volume.all[v] += 1.0;
      (is_free_[c] ? volume.free : volume.buffer)[v] += 1.0;
      free_count += is_free_[c] ? 1 : 0;
      if (!std::isnan(flow_.heading_rad[c]) && !flow_.holds(c)) {
        volume.usable[v] += 1.0;
        ++usable_count;
        volume.commanded[v] += is_free_[c] ? 1.0 : 0.0;
        commanded_count += is_free_[c] ? 1 : 0;
      }
      if (verdict == Verdict::reach) {
        volume.reach_by_mode[mode_[i]] += 1.0 / static_cast<double>(found_.size());
        volume.worst_time_s = std::max(volume.worst_time_s, found_[i].time_s);
      }
    }
  }
  const auto share = [](std::array<double, verdict_count>& counts, std::size_t of) {
    for (double& count : counts) count = of == 0 ? 0.0 : count / static_cast<double>(of);
  };
  share(volume.all, found_.size());
  share(volume.free, free_count);
  share(volume.commanded, commanded_count);
  share(volume.usable, usable_count);
  share(volume.buffer, found_.size() - free_count);
  return volume;
}

}  // namespace fairway
