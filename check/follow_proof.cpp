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
/// Less than a right angle: so far off its direction one still moves on in a stage.
constexpr double most_off_rad = 1.5;

Point scaled_unit(double rad, double by) { return {by * std::cos(rad), by * std::sin(rad)}; }
double dot(Point a, Point b) { return a.x * b.x + a.y * b.y; }

/// Everything that behaviours of one leaf of the core may do next.
class CoreOutcome : public Sightings {
 public:
  CoreOutcome(const ContractCertificate& c, const CoreProof& proof, std::size_t leaf, LapSums& sums)
      : c_(c),
        f_(*c.follow),
        proof_(proof),
        sums_(sums),
        stage_(f_.stage[leaf] - std::size_t{1}),
        group_(c.group[leaf]),
        bends_(f_.bends(stage_)),
        seconds_(c.parts.side_m / c.contract.least_speed * time_margin) {}

  void cross(std::size_t part, int side, double low, double high, const Past& past) override {
    std::size_t most = 0;
    bool any = false;
    c_.for_leaves(4 * part + static_cast<std::size_t>(side), low, high, [&](std::size_t leaf) {
      any = true;
      most = std::max(most, look(leaf, past));
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
  std::size_t look(std::size_t leaf, const Past& past) {
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
  std::size_t stage_;
  std::uint32_t group_;
  bool bends_;
  double seconds_;
};

}  // namespace

LapSums::LapSums(const ContractCertificate& c)
    : late_s_(c.follow->stages(), -HUGE_VAL),
      way_m_(c.follow->stages(), HUGE_VAL),
      begin_s_(c.follow->stages(), HUGE_VAL),
      end_s_(c.follow->stages(), -HUGE_VAL),
      off_rad_(c.follow->off_rad.begin(), c.follow->off_rad.end()) {
  const FollowClaims& f = *c.follow;
  for (std::size_t k = 0; k < f.stages(); ++k) {
    along_.push_back(scaled_unit(f.heading_rad[k], 1.0));
    slowness_.push_back(
        f.bends(k) ? Point{0.0, 0.0}
                   : scaled_unit(f.heading_rad[k],
                                 1.0 / (c.contract.least_speed * std::cos(double(f.off_rad[k])))));
  }
}

/// From x to x' in a stage with slowness w takes at most w . (x' - x): over a lap the sum of
/// x . (w - w'), where one stage ends and the next begins, and what laps do not begin alike.
void LapSums::pass(std::size_t k, std::size_t stages, Point at) {
  const std::size_t count = late_s_.size();
  end_s_[k] = std::max(end_s_[k], dot(at, slowness_[k]));
  for (std::size_t i = 0; i < stages; ++i, k = (k + 1) % count) {
    const std::size_t next = (k + 1) % count;
    begin_s_[next] = std::min(begin_s_[next], dot(at, slowness_[next]));
    late_s_[k] = std::max(late_s_[k], dot(at, slowness_[k] - slowness_[next]));
    way_m_[k] = std::min(way_m_[k], dot(at, along_[k] - along_[next]));
    if (next != 0) continue;
    start_least_s_ = std::min(start_least_s_, dot(at, slowness_[0]));
    start_most_s_ = std::max(start_most_s_, dot(at, slowness_[0]));
    start_least_m_ = std::min(start_least_m_, dot(at, along_[0]));
    start_most_m_ = std::max(start_most_m_, dot(at, along_[0]));
  }
}

void LapSums::slow_down(std::size_t k, double off_rad) {
  off_rad_[k] = std::max(off_rad_[k], off_rad);
}

/// By how much longer stage k takes than with the angle claimed: along its whole extent at most.
double LapSums::slower_s(std::size_t k, double claimed_rad) const {
  if (!(off_rad_[k] > claimed_rad)) return 0.0;
  const double extent_s = std::max(0.0, end_s_[k] - begin_s_[k]);
  return extent_s * (std::cos(claimed_rad) / std::cos(off_rad_[k]) - 1.0);
}

void LapSums::add(const LapSums& other) {
  for (std::size_t k = 0; k < late_s_.size(); ++k) {
    late_s_[k] = std::max(late_s_[k], other.late_s_[k]);
    way_m_[k] = std::min(way_m_[k], other.way_m_[k]);
    begin_s_[k] = std::min(begin_s_[k], other.begin_s_[k]);
    end_s_[k] = std::max(end_s_[k], other.end_s_[k]);
    if (other.off_rad_[k] > off_rad_[k]) off_rad_[k] = other.off_rad_[k];
  }
  start_least_s_ = std::min(start_least_s_, other.start_least_s_);
  start_most_s_ = std::max(start_most_s_, other.start_most_s_);
  start_least_m_ = std::min(start_least_m_, other.start_least_m_);
  start_most_m_ = std::max(start_most_m_, other.start_most_m_);
}

std::string LapSums::defect(const ContractCertificate& c) const {
  const FollowClaims& f = *c.follow;
  if (f.holds) return f.lap_least_s == 0.0 && f.lap_most_s == 0.0 ? "" : "lap_time_s: expected 0";
  if (!f.closed) {
    const bool follows = f.lap_least_s == 0.0 && f.lap_most_s >= static_cast<double>(f.time_s[0]);
    return follows ? "" : "lap_time_s: does not follow from the time to the end";
  }
  double most_s = start_most_s_ - start_least_s_;
  double least_m = start_least_m_ - start_most_m_;
  for (std::size_t k = 0; k < late_s_.size(); ++k) {
    most_s += late_s_[k] + static_cast<double>(f.time_s[k]) +
              slower_s(k, static_cast<double>(f.off_rad[k]));
    least_m += way_m_[k];
  }
  // Every stage is left by somebody, or its sums are infinite.
  if (!std::isfinite(most_s) || !std::isfinite(least_m)) return "stages: one is never left";
  const double least_s = least_m / c.contract.most_speed;
  if (f.lap_most_s < most_s * time_margin || f.lap_least_s * time_margin > std::max(0.0, least_s)) {
    return fmt::format("lap_time_s: is {:.9g} to {:.9g} s, claimed as {:.9g} to {:.9g} s", least_s,
                       most_s, f.lap_least_s, f.lap_most_s);
  }
  return "";
}

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
      half_m_(std::sqrt(0.5) * c.parts.side_m * (1.0 + 0x1p-20)) {}

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
  // Else a small circle beside the path could be said to go round it.
  std::size_t wraps = 0;
  for (std::size_t k = 0; k < f.stages(); ++k) {
    const double by = static_cast<double>(f.station_m[(k + 1) % f.stages()]) -
                      static_cast<double>(f.station_m[k]);
    wraps += by < 0.0 ? 1 : 0;
    const double on = by < 0.0 ? by + path_.length() : by;
    if (!(on >= 0.0 && on <= 0.5 * path_.length())) wraps = f.stages();
  }
  return wraps == 1 ? "" : "stages: do not go round the path once";
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

bool CoreProof::is_near_stage(std::size_t part, std::size_t stage) const {
  const FollowClaims& f = *c_.follow;
  const double off = beside(part).station_m - static_cast<double>(f.station_m[stage]);
  return !f.closed || f.holds ||
         std::abs(std::remainder(off, path_.length())) <= most_beside_stage * path_.length();
}

std::string CoreProof::defect_of_leaf(Behaviours& behaviours, std::size_t section, std::size_t leaf,
                                      Share& share, LapSums& sums) const {
  const FollowClaims& f = *c_.follow;
  const std::size_t stage = f.stage[leaf] - std::size_t{1};
  if (!is_near_stage(section / 4, stage)) return "its stage begins far along the path";
  if (!f.holds && f.bends(stage) && c_.group_time_s[c_.group[leaf]] > f.time_s[stage]) {
    return fmt::format("its group takes longer than its stage {}", stage);
  }
  CoreOutcome outcome(c_, *this, leaf, sums);
  behaviours.follow_leaf(section / 4, static_cast<int>(section % 4), c_.begin_of(leaf),
                         c_.end_of(section, leaf), outcome);
  share = {outcome.onwards_s, outcome.astray_rad};
  if (outcome.astray_rad > 0.5 * pi - 1e-3 + angle_slack) {
    return "behaviours come back to its group far from the direction of progress";
  }
  return outcome.fault;
}

}  // namespace fairway_check
