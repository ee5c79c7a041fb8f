#include "fairway/ceiling/ceiling_level.hpp"

#include <algorithm>
#include <cmath>

#include "fairway/base/parallel.hpp"
#include "fairway/ceiling/claim_rounds.hpp"
#include "fairway/ceiling/claim_shares.hpp"
#include "fairway/ceiling/coarse_claims.hpp"
#include "fairway/ceiling/signed_distance.hpp"
#include "fairway/ceiling/standing_claims.hpp"
#include "fairway/ceiling/step_stencils.hpp"

namespace fairway {
namespace {

template <typename Body>
void for_tile_nodes(const BallLattice& l, std::uint32_t tile, const Body& body) {
  const auto across = static_cast<std::uint32_t>(l.tiles_x);
  const auto down = static_cast<std::uint32_t>(l.tiles_y);
  const int k = static_cast<int>(tile / across / down);
  const int y0 = static_cast<int>(tile / across % down) * tile_rows;
  const int x0 = static_cast<int>(tile % across) * tile_columns;
  for (int q = 0; q < tile_nodes; ++q) {
    body(static_cast<std::size_t>(q), k, y0 + q / tile_columns, x0 + q % tile_columns);
  }
}

template <typename Body>
void for_open(const ClaimRounds& rounds, const Body& body) {
  for_ranges(rounds.open.size(), 16, [&](std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; ++i) body(i, rounds.open[i]);
  });
}

class Level {
 public:
  Level(const CeilingCells& cells, int level, const CeilingLevel* coarse)
      : cells_(cells),
        coarse_(coarse),
        l_(ball_lattice(cells.nx, cells.ny, cells.side, level)),
        obstacles_(signed_distance(l_, cells.obstacle, true)),
        goal_(signed_distance(l_, cells.goal, false)),
        standing_(l_, obstacles_, goal_),
        open_(open_tiles(l_, cells, coarse)) {}

  std::optional<CeilingLevel> found(const std::function<bool()>& stop) {
    CeilingLevel level;
    level.lattice = l_;
    find_inside(level, stop);
    measure_claims(level.inside, level.inside_share);
    if (!find_lost(level, stop)) return {};
    measure_claims(level.lost, level.lost_share);
    level.closed = closed_cell_bins(l_, cells_, level.inside, level.lost);
    return level;
  }

 private:
  void measure_claims(const std::vector<Radius>& claims, std::vector<float>& share) const {
    share = claimed_shares(l_, cells_, claims);
  }

  [[nodiscard]] bool on_lattice(int y, int x) const { return y < l_.ny && x < l_.nx; }

  void find_inside(CeilingLevel& level, const std::function<bool()>& stop) {
    const StepStencils steps = steps_of_constant_turns(l_);
    ClaimRounds rounds{l_, steps, false, {}, open_, {}, {}};
    rounds.claims.assign(l_.size(), 0);
    if (coarse_ != nullptr)
      add_coarse_claims(*coarse_, coarse_->inside_after_step, l_, rounds.claims);
    rounds.least.resize(open_.size());
    rounds.most.resize(open_.size());
    for_open(rounds, [&](std::size_t i, std::uint32_t tile) {
      for_tile_nodes(l_, tile, [&](std::size_t q, int k, int y, int x) {
        if (!on_lattice(y, x)) return;
        const StandingClaims::Inside s = standing_.inside(k, y, x);
        Radius& claim = rounds.claims[l_.at(k, y, x)];
        rounds.most[i][q] = s.around;
        rounds.least[i][q] = std::max(claim, std::min(s.goal, s.around));
        claim = rounds.least[i][q];
      });
    });
    // What has been found so far holds, whether it settled or not.
    (void)settle(rounds, stop);
    level.inside.assign(l_.size(), 0);
    if (coarse_ != nullptr) add_coarse_claims(*coarse_, coarse_->inside, l_, level.inside);
    for_open(rounds, [&](std::size_t, std::uint32_t tile) {
      const TileClaims after = claims_after_step(rounds, tile);
      for_tile_nodes(l_, tile, [&](std::size_t q, int k, int y, int x) {
        if (!on_lattice(y, x)) return;
        const StandingClaims::Inside s = standing_.inside(k, y, x);
        const std::size_t at = l_.at(k, y, x);
        level.inside[at] =
            std::max({level.inside[at], s.goal, std::min(s.ahead, after[q]), rounds.claims[at]});
      });
    });
    level.inside_after_step = std::move(rounds.claims);
  }

  bool find_lost(CeilingLevel& level, const std::function<bool()>& stop) {
    const StepStencils steps = steps_of_every_control(l_);
    ClaimRounds rounds{l_, steps, true, {}, open_, {}, {}};
    rounds.claims.assign(l_.size(), 0);
    if (coarse_ != nullptr)
      add_coarse_claims(*coarse_, coarse_->lost_after_step, l_, rounds.claims);
    claim_margin(rounds.claims);
    rounds.least.resize(open_.size());
    rounds.most.resize(open_.size());
    for_open(rounds, [&](std::size_t i, std::uint32_t tile) {
      for_tile_nodes(l_, tile, [&](std::size_t q, int k, int y, int x) {
        Radius& claim = rounds.claims[l_.at(k, y, x)];
        rounds.most[i][q] = claim;
        rounds.least[i][q] = claim;
        if (!on_lattice(y, x)) return;
        const StandingClaims::Lost s = standing_.lost(k, y, x);
        rounds.least[i][q] = std::max({claim, s.always, s.ahead, s.behind});
        rounds.most[i][q] = proved_inside(level, k, y, x) ? Radius{0} : s.no_goal;
        claim = widest_claim;
      });
    });
    if (!settle(rounds, stop)) return false;
    level.lost.assign(l_.size(), 0);
    if (coarse_ != nullptr) add_coarse_claims(*coarse_, coarse_->lost, l_, level.lost);
    claim_margin(level.lost);
    for_open(rounds, [&](std::size_t i, std::uint32_t tile) {
      const TileClaims after = claims_after_step(rounds, tile);
      for_tile_nodes(l_, tile, [&](std::size_t q, int k, int y, int x) {
        if (!on_lattice(y, x)) return;
        const StandingClaims::Lost s = standing_.lost(k, y, x);
        Radius& claim = level.lost[l_.at(k, y, x)];
        claim = std::max({claim, s.always, s.ahead, std::min(rounds.most[i][q], after[q])});
      });
    });
    level.lost_after_step = std::move(rounds.claims);
    return true;
  }

  /// Then nothing there can be lost, and rounds need not find out.
  [[nodiscard]] bool proved_inside(const CeilingLevel& level, int k, int y, int x) const {
    return level.inside[l_.at(k, y, x)] > 0;
  }

  /// Beyond the lattice everything is an obstacle.
  void claim_margin(std::vector<Radius>& claims) const {
    for (int y = -l_.margin; y < l_.tiles_y * tile_rows + l_.margin; ++y) {
      for (int x = -l_.margin; x < l_.tiles_x * tile_columns + l_.margin; ++x) {
        if (x >= 0 && y >= 0 && on_lattice(y, x)) continue;
        const int depth = depth_beyond(y, x);
        for (int k = 0; k < l_.headings; ++k) {
          claims[l_.at(k, y, x)] = static_cast<Radius>(depth);
        }
      }
    }
  }

  [[nodiscard]] int depth_beyond(int y, int x) const {
    // Tiles may reach farther than distances are known; what is nearer to the cells is less deep.
    const int last = obstacles_.margin - obstacles_.fine;
    const int i = std::min(obstacles_.of_node(x), obstacles_.columns + last);
    const int j = std::min(obstacles_.of_node(y), obstacles_.rows + last);
    return std::clamp(-*obstacles_.at(i, j) - 1, 0, widest_claim);
  }

  const CeilingCells& cells_;
  const CeilingLevel* coarse_;
  BallLattice l_;
  SignedDistance obstacles_;
  SignedDistance goal_;
  StandingClaims standing_;
  std::vector<std::uint32_t> open_;
};

}  // namespace

std::optional<CeilingLevel> ceiling_level(const CeilingCells& cells, int level,
                                          const CeilingLevel* coarse,
                                          const std::function<bool()>& stop) {
  return Level(cells, level, coarse).found(stop);
}

std::size_t bytes_of_level(const CeilingCells& cells, int level) {
  const BallLattice l = ball_lattice(cells.nx, cells.ny, cells.side, level);
  // Four kinds of claims, those of rounds twice for a while, and what limits them.
  return l.size() * 7 * sizeof(Radius);
}

}  // namespace fairway
