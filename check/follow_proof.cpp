#include "check/follow_proof.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace fairway_check {
namespace {

using std::numbers::pi;

constexpr double time_margin = 1.0 + 1e-9;
/// Above all rounding, in metres by metre of the map.
constexpr double least_difference = 0x1p-30;
/// So near a leaf is to where its stage begins, as a share of the path.
constexpr double most_beside_stage = 0.25;
/// Less than half of the path, by more than all rounding.
constexpr double most_way = 0.499;

/// Everything that behaviours of one leaf of the core may do next.
class CoreOutcome : public Sightings {
 public:
  CoreOutcome(const ContractCertificate& c, const CoreProof& proof, std::size_t part,
              std::size_t leaf, LapSums& sums)
      : c_(c),
        f_(*c.follow),
        proof_(proof),
        sums_(sums),
        part_(part),
        stage_(f_.stage[leaf] - std::size_t{1}),
        group_(c.group[leaf]),
        bends_(f_.bends(stage_)),
        seconds_(c.parts.side_m / c.contract.least_speed * time_margin) {}

  void cross(std::size_t part, int side, double low, double high, const Past& past) override {
    std::size_t most = 0;
    bool any = false;
    c_.for_leaves(4 * part + static_cast<std::size_t>(side), low, high, [&](std::size_t leaf) {
      any = true;
      most = std::max(most, look(part, leaf, past));
    });
    if (!any) fault = "its behaviours come where nothing is claimed";
    if (!bends_) note_heading(off_direction(past));
    if (most == 0) return;
    const Cell at = c_.parts.part_at(part);
    for (const Point p : places_on(side, low, high).corners()) {
      sums_.pass(stage_, most, c_.parts.side_m * (Point{double(at.x), double(at.y)} + p));
    }
  }
  void visit(std::size_t part, double least, double most) override {
    if (!proof_.is_in_tube(part, least, most)) fault = "its behaviours leave the tube";
  }
  void end(Verdict verdict, const Past& past) override {
    if (f_.closed || verdict != reach) fault = "its behaviours end";
    onwards_s = std::max(onwards_s, past.length * seconds_);
  }
  void give_up() override { fault = "its behaviours cannot be followed"; }
  bool has_enough() const override { return !fault.empty(); }

  std::string fault;
  double onwards_s = 0.0;
  double astray_rad = -1.0;

 private:
  /// How many stages on that leaf is.
  std::size_t look(std::size_t part, std::size_t leaf, const Past& past) {
    if (f_.stage[leaf] == 0) {
      fault = "its behaviours leave the core";
      return 0;
    }
    if (f_.holds) return 0;  // it is enough to stay
    const std::size_t count = f_.stages();
    const std::size_t on = (f_.stage[leaf] - std::size_t{1} + count - stage_) % count;
    if (on > 0 && 3 * on >= count) {
      fault =
          fmt::format("its behaviours go from stage {} to stage {}", stage_, f_.stage[leaf] - 1);
    }
    if (!proof_.moves_as_stages(part_, stage_, part, f_.stage[leaf] - std::size_t{1})) {
      fault = "its behaviours jump along the path";
    }
    if (!bends_) return on;
    const std::uint32_t group = c_.group[leaf];
    if (on > 0) {
      onwards_s = std::max(onwards_s, past.length * seconds_);
    } else if (group == group_) {
      const double u = c_.group_heading_rad[group_];
      astray_rad = std::isnan(u) ? HUGE_VAL : std::max(astray_rad, off(past, u));
    } else {
      if (group > group_) fault = "its behaviours come to a higher group of its stage";
      onwards_s =
          std::max(onwards_s, past.length * seconds_ + static_cast<double>(c_.group_time_s[group]));
    }
    return on;
  }
  /// Who heads farther from a stage's direction than is claimed moves on along it more slowly.
  void note_heading(double off_rad) {
    if (off_rad > most_off_rad) {
      fault =
          fmt::format("behaviours of stage {} head {:.6f} rad from its direction", stage_, off_rad);
    } else if (off_rad > static_cast<double>(f_.off_rad[stage_])) {
      sums_.slow_down(stage_, off_rad);
    }
  }
  static double off(const Past& past, double direction_rad) {
    const double middle = 0.5 * (past.least_rad + past.most_rad);
    return std::abs(std::remainder(middle - direction_rad, 2.0 * pi)) +
           0.5 * (past.most_rad - past.least_rad);
  }
  double off_direction(const Past& past) const { return off(past, f_.heading_rad[stage_]); }

  const ContractCertificate& c_;
  const FollowClaims& f_;
  const CoreProof& proof_;
  LapSums& sums_;
  std::size_t part_;
  std::size_t stage_;
  std::uint32_t group_;
  bool bends_;
  double seconds_;
};

}  // namespace

CoreProof::CoreProof(const ContractCertificate& c)
    : c_(c),
      path_(
          [&] {
            std::vector<Point> from_corner;
            for (const Point p : c.follow->path) {
              from_corner.push_back(p - Point{c.geometry.x0_m, c.geometry.y0_m});
            }
            return from_corner;
          }(),
          c.follow->closed),
      half_m_(std::sqrt(0.5) * c.parts.side_m * (1.0 + 0x1p-20)) {
  const std::vector<float>& station = c.follow->station_m;
  begins_m_.push_back(station[0]);
  for (std::size_t k = 0; k < station.size(); ++k) {
    const double by = double(station[(k + 1) % station.size()]) - double(station[k]);
    begins_m_.push_back(begins_m_.back() + (by < 0.0 ? by + path_.length() : by));
  }
}

CoreProof::Beside CoreProof::beside(std::size_t part) const {
  auto& known = known_.local();
  if (const auto found = known.find(part); found != known.end()) return found->second;
  const Cell at = c_.parts.part_at(part);
  const Point middle{(at.x + 0.5) * c_.parts.side_m, (at.y + 0.5) * c_.parts.side_m};
  const PathPlaces::Near near = path_.nearest(middle);
  const double farthest = near.distance + half_m_;
  // The point nearest to any place of the part is no farther than that from the middle.
  const Arc ways = path_.directions(middle, near.heading_rad, farthest + half_m_);
  return known[part] = {near.station, farthest, ways};
}

std::string CoreProof::defect() const {
  const FollowClaims& f = *c_.follow;
  if (f.holds) return "";
  if (!f.closed) {
    const Point end = f.path.back() - Point{c_.geometry.x0_m, c_.geometry.y0_m};
    const double cell_m = c_.geometry.cell_m;
    for (std::size_t i = 0; i < c_.loop.kind.size(); ++i) {
      const Cell cell = c_.loop.cell_at(i);
      const Point off = Point{(cell.x + 0.5) * cell_m, (cell.y + 0.5) * cell_m} - end;
      if (c_.loop.kind[i] == target &&
          std::hypot(off.x, off.y) > c_.geometry.turn_radius_m + 1.5 * cell_m) {
        return fmt::format("cell ({}, {}): is not at the end of the path", cell.x, cell.y);
      }
    }
    return "";
  }
  const bool ascend = std::is_sorted(begins_m_.begin(), begins_m_.end());
  const double round_m = begins_m_.back() - begins_m_.front();
  const bool once = std::abs(round_m - path_.length()) < 0.5 * path_.length();
  return ascend && once ? "" : "stages: do not go round the path once";
}

bool CoreProof::is_in_tube(std::size_t part, double least, double most) const {
  const FollowClaims& f = *c_.follow;
  const Beside b = beside(part);
  const std::size_t count = f.tube_distance_m.size();
  const double along = b.station_m / path_.length() * static_cast<double>(count);
  const auto k = std::min(count - 1, static_cast<std::size_t>(along));
  const double farthest = static_cast<double>(f.tube_distance_m[k]) * (1.0 + least_difference);
  const double middles = 0.5 * (least + most) - b.ways.right - 0.5 * b.ways.width;
  const double off =
      std::abs(std::remainder(middles, 2.0 * pi)) + 0.5 * (most - least + b.ways.width);
  return b.farthest_m <= farthest && off <= static_cast<double>(f.tube_off_rad[k]) + angle_slack;
}

double CoreProof::from_stage_m(std::size_t part, std::size_t stage) const {
  return std::remainder(beside(part).station_m - static_cast<double>(c_.follow->station_m[stage]),
                        path_.length());
}

/// A lap of stages is one round of the path, so the ways sum up to one. If each is less than half
/// of it, it is the shorter way between the two parts: then what laps are claimed of does go round,
/// which a loop beside the path does not, however its stages are named.
bool CoreProof::moves_as_stages(std::size_t part, std::size_t stage, std::size_t to_part,
                                std::size_t to_stage) const {
  if (!c_.follow->closed) return true;
  const double round_m = to_stage < stage ? begins_m_.back() - begins_m_.front() : 0.0;
  const double way_m = begins_m_[to_stage] + round_m - begins_m_[stage] +
                       from_stage_m(to_part, to_stage) - from_stage_m(part, stage);
  return std::abs(way_m) < most_way * path_.length();
}

std::string CoreProof::defect_of_leaf(Behaviours& behaviours, std::size_t section, std::size_t leaf,
                                      Share& share, LapSums& sums) const {
  const FollowClaims& f = *c_.follow;
  const std::size_t stage = f.stage[leaf] - std::size_t{1};
  if (f.closed && !f.holds &&
      std::abs(from_stage_m(section / 4, stage)) > most_beside_stage * path_.length()) {
    return "its stage begins far along the path";
  }
  if (!f.holds && f.bends(stage) && c_.group_time_s[c_.group[leaf]] > f.time_s[stage]) {
    return fmt::format("its group takes longer than its stage {}", stage);
  }
  CoreOutcome outcome(c_, *this, section / 4, leaf, sums);
  behaviours.follow_leaf(section / 4, static_cast<int>(section % 4), c_.begin_of(leaf),
                         c_.end_of(section, leaf), outcome);
  share = {outcome.onwards_s, outcome.astray_rad};
  if (outcome.astray_rad > 0.5 * pi - 1e-3 + angle_slack) {
    return "behaviours come back to its group far from the direction of progress";
  }
  return outcome.fault;
}

}  // namespace fairway_check
