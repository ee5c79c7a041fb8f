#include "fairway/verify/sample_verdicts.hpp"

#include <cmath>

#include "fairway/base/error.hpp"
#include "fairway/base/heading.hpp"
#include "fairway/base/parallel.hpp"
#include "fairway/base/random.hpp"

namespace fairway {
namespace {

/// `n` mirrored at the point, in `base`: spreads 0, 1, 2, ... evenly over [0, 1).
double radical_inverse(unsigned n, unsigned base) {
  double inverse = 0.0;
  double digit = 1.0 / base;
  for (; n > 0; n /= base, digit /= base) inverse += digit * (n % base);
  return inverse;
}

double fraction(double x) { return x - std::floor(x); }

class Sampler {
 public:
  Sampler(const ProofView& proof, const VerdictMapOptions& options)
      : proof_(proof), options_(options) {}

  ProvedState proved(Vec2 p, double heading_rad) const {
    return ask_all_modes(proof_, p.x, p.y, heading_rad, options_.most_crossings);
  }

  /// One heading in each of equal slices; positions from a Halton sequence, shifted at random so
  /// that no two cells are sampled at the same positions.
  std::array<std::uint16_t, verdict_count> counts(const Grid& grid, Cell cell) const {
    Random random = Random::stream(options_.seed, grid.index(cell));
    const double shift_x = random.unit();
    const double shift_y = random.unit();
    const Vec2 corner = grid.corner(cell);
    std::array<std::uint16_t, verdict_count> count{};
    for (int k = 0; k < options_.states_per_sample; ++k) {
      const auto n = static_cast<unsigned>(k);
      const Vec2 within{fraction(shift_x + radical_inverse(n, 2)),
                        fraction(shift_y + radical_inverse(n, 3))};
      const double turn = (k + random.unit()) / options_.states_per_sample;
      const ProvedState found = proved(corner + grid.cell_m * within, pi * (2.0 * turn - 1.0));
      ++count[static_cast<std::size_t>(found.verdict)];
    }
    return count;
  }

 private:
  const ProofView& proof_;
  const VerdictMapOptions& options_;
};

}  // namespace

VerdictMap verdict_map_of(const ProofView& proof, const VerdictMapOptions& options) {
  require(options.headings >= 1 && options.most_across >= 1 && options.most_crossings >= 1,
          "a verdict map has at least one heading, one sample across, and one crossing per flight");
  require(options.states_per_sample >= 0 && options.states_per_sample <= 65535,
          "0 to 65535 states per sample");
  VerdictMap map = VerdictMap::over(proof.flow.grid, options.headings, options.most_across);
  map.states_per_sample = options.states_per_sample;
  map.modes = proof.modes();
  if (map.modes > 1) map.mode.assign(map.verdict.size(), no_mode);
  const Sampler sampler(proof, options);
  for_ranges(map.samples(), 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Cell cell = map.cell_of_sample(i);
      map.kind[i] = proof.flow.kind_at({cell.ix, cell.iy});
      if (map.kind[i] != CellKind::ordinary) continue;
      for (std::size_t h = 0; h < map.heading_rad.size(); ++h) {
        const ProvedState found = sampler.proved(map.place_m(i), map.heading_rad[h]);
        const std::size_t k = h * map.samples() + i;
        map.verdict[k] = found.verdict;
        if (!map.mode.empty() && found.verdict == Verdict::reach) {
          map.mode[k] = static_cast<std::uint8_t>(found.mode);
        }
      }
      map.count[i] = sampler.counts(map.grid, cell);
    }
  });
  return map;
}

}  // namespace fairway
