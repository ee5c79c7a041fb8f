#include "fairway/verify/certify.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>

#include "fairway/base/parallel.hpp"
#include "fairway/base/random.hpp"
#include "fairway/verify/images.hpp"
#include "fairway/verify/prover.hpp"
#include "fairway/verify/undecided_sections.hpp"

namespace fairway {
namespace {

using Clock = std::chrono::steady_clock;
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

/// The volumes, by querying the states again that were not decided before.
class VolumeMeter {
 public:
  VolumeMeter(const Flow& flow, const std::vector<bool>& is_free, const CertifyOptions& options)
      : flow_(flow),
        is_free_(is_free),
        states_(sampled_states(flow, options)),
        images_(state_images(flow, states_, options.most_crossings, [] { return true; })),
        found_(states_.size()) {}

  VolumeFractions measure(const Prover& prover) {
    for_ranges(states_.size(), 4096, [&](std::size_t a, std::size_t b) {
      for (std::size_t i = a; i < b; ++i) {
        if (found_[i].only() != Verdict::undecided) continue;
        const Image image = images_[i];
        VerdictSet& found = found_[i] = image.ends;
        if (image.gave_up) found.add(Verdict::undecided, 0.0);
        for (const ImagePiece& piece : image.pieces) {
          prover.look_up(piece.section, piece.range, static_cast<double>(piece.flown_s), found);
        }
      }
    });
    return fractions();
  }
  std::size_t bytes() const { return images_.bytes() + states_.size() * 40; }

 private:
  VolumeFractions fractions() const {
    VolumeFractions volume;
    volume.samples = states_.size();
    const auto cells = static_cast<std::size_t>(
        std::count(flow_.kind, flow_.kind + flow_.grid.size(), CellKind::ordinary));
    const std::size_t each = cells == 0 ? 0 : states_.size() / cells;
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
          volume.worst_time_s = std::max(volume.worst_time_s, found_[i].time_s);
        }
      }
    }
    const auto share = [](std::array<double, verdict_count>& counts, std::size_t of) {
      for (double& count : counts) count = of == 0 ? 0.0 : count / static_cast<double>(of);
    };
    share(volume.all, states_.size());
    share(volume.free, free_count);
    share(volume.commanded, commanded_count);
    share(volume.usable, usable_count);
    share(volume.buffer, states_.size() - free_count);
    return volume;
  }

  const Flow& flow_;
  const std::vector<bool>& is_free_;
  std::vector<Place> states_;
  ImageStore images_;
  std::vector<VerdictSet> found_;
};

/// The last levels decided almost nothing, or little for many more leaves: smaller leaves do not
/// make the rest any easier.
bool has_stalled(const std::vector<LevelRecord>& levels, int without_gain) {
  const auto since = [&](std::size_t n, double share, double growth) {
    if (levels.size() <= n) return false;
    const LevelRecord& then = levels[levels.size() - 1 - n];
    const LevelRecord& now = levels.back();
    return now.undecided_volume > share * then.undecided_volume &&
           static_cast<double>(now.undecided) > growth * static_cast<double>(then.undecided);
  };
  return since(static_cast<std::size_t>(without_gain), 0.999, 0.0) || since(3, 0.95, 3.0);
}

}  // namespace

const char* name_of(StoppedBy reason) {
  switch (reason) {
    case StoppedBy::undecided_max:
      return "undecided_max";
    case StoppedBy::time_limit:
      return "time_limit";
    case StoppedBy::memory_limit:
      return "memory_limit";
    case StoppedBy::last_level:
      return "last_level";
    case StoppedBy::stalled:
      return "stalled";
  }
  return "";
}

Certified certify(const Flow& flow, const std::vector<bool>& is_free, const CertifyOptions& options,
                  SectionVerdicts start, const CertifyProgress& progress) {
  const auto began = Clock::now();
  const auto go_on = [&] {
    return options.time_limit_s <= 0.0 ||
           std::chrono::duration<double>(Clock::now() - began).count() < options.time_limit_s;
  };
  if (start.first.empty()) start = undecided_sections(flow, options.first_level);
  VolumeMeter meter(flow, is_free, options);
  Prover prover(flow, start, options.most_crossings, go_on);
  Certified answer;
  for (int level = options.first_level;; ++level) {
    const double least_units = std::ldexp(1.0, 32 - level);
    const bool settled = prover.settle(least_units);
    answer.volume = meter.measure(prover);
    answer.levels.push_back(
        {level, prover.graph().leaves(), prover.graph().undecided(), answer.volume.all[0]});
    if (progress) progress(answer.levels.back());
    if (answer.volume.all[0] <= options.undecided_max) {
      answer.stopped_by = StoppedBy::undecided_max;
    } else if (!settled) {
      answer.stopped_by = StoppedBy::time_limit;
    } else if (options.memory_limit_bytes > 0 &&
               2 * prover.bytes() + meter.bytes() > options.memory_limit_bytes) {
      answer.stopped_by = StoppedBy::memory_limit;
    } else if (level >= options.last_level) {
      answer.stopped_by = StoppedBy::last_level;
    } else if (has_stalled(answer.levels, options.stall_levels)) {
      answer.stopped_by = StoppedBy::stalled;
    } else {
      continue;
    }
    answer.sections = prover.graph().sections();
    return answer;
  }
}

}  // namespace fairway
