#include "fairway/steer/pose_csv.hpp"

#include <array>
#include <span>

#include <fmt/format.h>

#include "fairway/base/error.hpp"
#include "fairway/base/number_csv.hpp"
#include "fairway/steer/dubins_words.hpp"

namespace fairway {
namespace {

constexpr std::array<CsvColumn, 6> pair_columns{{{"x0_m"},
                                                 {"y0_m"},
                                                 {"h0_rad", CsvQuantity::heading},
                                                 {"x1_m"},
                                                 {"y1_m"},
                                                 {"h1_rad", CsvQuantity::heading}}};
constexpr std::array<CsvColumn, 3> waypoint_columns{
    {{"x_m"}, {"y_m"}, {"heading_rad", CsvQuantity::heading}}};

State state_of(std::span<const double> v) { return {{v[0], v[1]}, Heading::from_rad(v[2])}; }

struct Limit {
  double turn_radius_m;
  double most_radii;
};

void add(PosePairs& pairs, const State& from, const State& to, const Limit& limit,
         const CsvPlace& place) {
  if (!is_within_radii(from, to, limit.turn_radius_m, limit.most_radii)) {
    place.refuse(fmt::format("the poses are more than {:g} turning radii apart", limit.most_radii));
  }
  pairs.from.push_back(from);
  pairs.to.push_back(to);
}

}  // namespace

PosePairs read_pose_pairs(const std::string& file, double turn_radius_m, double most_radii) {
  PosePairs pairs;
  for_csv_lines(
      csv_text(file, pair_columns), csv_name(file), pair_columns, "pairs",
      [&](std::span<const double> v, const CsvPlace& place) {
        add(pairs, state_of(v), state_of(v.subspan(3)), {turn_radius_m, most_radii}, place);
      });
  return pairs;
}

PosePairs read_waypoints(const std::string& file, const std::optional<State>& start,
                         double turn_radius_m, double most_radii) {
  PosePairs pairs;
  std::optional<State> last = start;
  for_csv_lines(csv_text(file, waypoint_columns), csv_name(file), waypoint_columns, "waypoints",
                [&](std::span<const double> v, const CsvPlace& place) {
                  if (last) add(pairs, *last, state_of(v), {turn_radius_m, most_radii}, place);
                  last = state_of(v);
                });
  if (pairs.from.empty()) {
    throw InputError(csv_name(file), "has one waypoint; expected two or more, or a start");
  }
  return pairs;
}

}  // namespace fairway
