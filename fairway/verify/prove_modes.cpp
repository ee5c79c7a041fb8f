#include "fairway/verify/prove_modes.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "fairway/base/error.hpp"
#include "fairway/verify/hand_over.hpp"
#include "fairway/verify/prover.hpp"
#include "fairway/verify/undecided_sections.hpp"

namespace fairway {
namespace {

/// Appends what a further mode is for: where it is not proved to reach, neighbours are one leaf,
/// and nothing is said of them.
void append_reaching(const SectionVerdicts& all, SectionVerdicts& kept) {
  if (kept.first.empty()) kept.first.push_back(0);
  for (std::size_t s = 0; s + 1 < all.first.size(); ++s) {
    bool after_open = false;
    for (std::size_t i = all.first[s]; i < all.first[s + 1]; ++i) {
      const bool reaches = all.verdict[i] == static_cast<std::uint8_t>(Verdict::reach);
      const Verdict verdict = reaches ? Verdict::reach : Verdict::undecided;
      if (reaches || !after_open) {
        kept.begin.push_back(all.begin[i]);
        kept.verdict.push_back(static_cast<std::uint8_t>(verdict));
        kept.rank.push_back(reaches ? all.rank[i] : 0);
        kept.time_s.push_back(reaches ? all.time_s[i] : 0.0F);
        kept.next_mode.push_back(reaches && !all.next_mode.empty() ? all.next_mode[i] : no_mode);
      }
      after_open = !reaches;
    }
    kept.first.push_back(static_cast<std::uint32_t>(kept.begin.size()));
  }
}

}  // namespace

void prove_modes(const Flow& flow, std::span<const float* const> further_rad,
                 const CertifyOptions& options, const std::function<bool()>& go_on,
                 VolumeMeter& meter, Certified& answer) {
  // Smaller leaves than this earn next to nothing: they lie along the edges of what is proved.
  constexpr int first_level = 2;
  constexpr int last_level = 10;
  // A flight that weaves for long is not what a further mode is for.
  const int most_crossings = std::min(options.most_crossings, 300);
  constexpr double least_gain = 2e-4;  // of all states, by a level
  require(further_rad.size() < most_modes, "a plan has fewer modes");
  std::vector<SectionVerdicts> proved;
  proved.reserve(further_rad.size());  // views of them stay valid
  std::vector<ModeView> earlier{{flow, answer.sections.view()}};
  for (const float* heading_rad : further_rad) {
    Flow mode = flow;
    mode.heading_rad = heading_rad;
    mode.holding = nullptr;
    if (answer.stopped_by == StoppedBy::time_limit ||
        answer.stopped_by == StoppedBy::memory_limit) {
      append_reaching(undecided_sections(mode, 0), answer.further);  // nothing is claimed of it
      answer.volume.reach_by_mode.push_back(0.0);
      continue;
    }
    meter.begin_mode(mode);
    Prover prover(mode, undecided_sections(mode, 0), most_crossings, go_on,
                  LeafGraph::Keep::links_of_open_leaves, earlier);
    for (int level = first_level; level <= last_level; ++level) {
      const double before = answer.volume.all[static_cast<std::size_t>(Verdict::reach)];
      const bool settled = prover.settle(std::ldexp(1.0, 32 - level));
      answer.volume = meter.measure(prover);
      const double gain = answer.volume.all[static_cast<std::size_t>(Verdict::reach)] - before;
      if (!settled) answer.stopped_by = StoppedBy::time_limit;
      if (options.memory_limit_bytes > 0 &&
          2 * prover.bytes() + meter.bytes() > options.memory_limit_bytes) {
        answer.stopped_by = StoppedBy::memory_limit;
        break;
      }
      if (!settled || (level > first_level + 2 && gain < least_gain)) break;
    }
    proved.emplace_back();
    append_reaching(prover.into_sections(), proved.back());
    earlier.push_back({mode, proved.back().view()});
    append_reaching(proved.back(), answer.further);
  }
}

}  // namespace fairway
