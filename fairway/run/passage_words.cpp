#include "fairway/run/passage_words.hpp"

#include <fmt/format.h>

#include "fairway/base/number_text.hpp"
#include "fairway/map/degrees_from_frame.hpp"

namespace fairway {
namespace {

std::string place_words(Vec2 place_m, const Frame& frame) {
  const LonLatOf degrees = lon_lat_of(frame, "the map's frame");
  if (!degrees) return place_text(place_m);
  const LonLat place = degrees(place_m);
  constexpr int a_metre = 5;
  return fmt::format("{}, latitude {} longitude {}", place_text(place_m),
                     decimal_text(place.latitude_deg, a_metre),
                     decimal_text(place.longitude_deg, a_metre));
}

std::string share_words(std::size_t cells, const CutOff& cut_off) {
  return whole_percent_text(static_cast<double>(cells) /
                            static_cast<double>(cut_off.cut_off_cells)) +
         " of the cells that are cut off";
}

}  // namespace

CutOff cut_off_in(const Scenario& scenario, const ObstacleMap& map, const Plan& plan) {
  return cut_off(map, plan.vehicle, *plan.record.mission, scenario.plan, plan.region, plan.cost_m);
}

std::string passage_words(const CutOff& cut_off, const Frame& frame) {
  std::string words;
  if (cut_off.passage) {
    const Passage& p = *cut_off.passage;
    words = fmt::format(
        "The widest passage that is too narrow is at {}: it is {} m wide from obstacle cell to "
        "obstacle cell, but the buffers on both sides take {} m; alpha = {:.4g}{} would open it "
        "for {}.",
        place_words(p.place_m, frame), length_text(p.width_m), length_text(p.needed_m), p.alpha,
        p.turn_radius_m ? fmt::format(" or turn_radius_m = {:.4g}", *p.turn_radius_m) : "",
        share_words(p.opens_cells, cut_off));
  }
  if (cut_off.walled_off_cells > 0) {
    words += fmt::format("{}{}: no alpha or turning radius opens a way.",
                         words.empty() ? "Walls without a gap enclose "
                                       : " Walls without a gap "
                                         "enclose ",
                         share_words(cut_off.walled_off_cells, cut_off));
  }
  return words;
}

}  // namespace fairway
