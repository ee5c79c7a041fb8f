#include "fairway/identify/fitted_words.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "fairway/base/number_text.hpp"
#include "fairway/identify/rounded_out.hpp"

namespace fairway {
namespace {

constexpr double degrees = 180.0 / pi;

class Words {
 public:
  Words(const FittedContract& fit, std::span<const FlightLog> logs) : fit_(fit), logs_(logs) {}

  std::string decided(ContractPart part) const {
    const auto& decider = fit_.deciders[static_cast<std::size_t>(part)];
    if (!decider) return "no log asks for more";
    const FlightLog& log = logs_[decider->log];
    return fmt::format("decided by {} at t = {} s", log.name,
                       decimal_text(log.samples[decider->sample].time_s, 2));
  }

 private:
  const FittedContract& fit_;
  std::span<const FlightLog> logs_;
};

std::string margin_words(double share) {
  return share > 0.0 ? fmt::format("; with a margin of {:.3g} %", 100.0 * share) : "";
}

}  // namespace

ExplainedContract explained(const FittedContract& fit, std::span<const FlightLog> logs,
                            const FitMargins& margins) {
  const Words words(fit, logs);
  const VehicleContract& tight = fit.contract;
  const double more = 1.0 + margins.share;
  // A range or an error of nothing would have no margin.
  constexpr double margin_radius = 0.05;
  constexpr double margin_heading_rad = 1.0 / degrees;
  const double spread =
      std::pow(tight.turn_radius_m.most / tight.turn_radius_m.least, 0.5 * margins.share) *
      (1.0 + margin_radius * margins.share);
  const double speeds = std::pow(tight.speed_mps.most / tight.speed_mps.least, 0.5 * margins.share);
  const std::string margin = margin_words(margins.share);
  ExplainedContract e;
  VehicleContract& c = e.contract;
  c = tight;
  c.command_error_m = rounded_out(more * tight.command_error_m + margins.position_error_m, true);
  c.heading_error_rad =
      rounded_out(more * tight.heading_error_rad + margins.share * margin_heading_rad, true);
  c.turn_radius_m = {rounded_out(tight.turn_radius_m.least / spread, false),
                     rounded_out(tight.turn_radius_m.most * spread, true)};
  c.speed_mps = {rounded_out(tight.speed_mps.least / speeds, false),
                 rounded_out(tight.speed_mps.most * speeds, true)};
  c.side_uncertain_rad = std::min(rounded_out(more * tight.side_uncertain_rad, true), 1.57);
  e.about = {fmt::format("From {} flight log{}, at a tracking distance of {} m: add it to",
                         logs.size(), logs.size() == 1 ? "" : "s", length_text(fit.tracking_m)),
             "map.footprint_radius_m. Hold it against other flights of the same vehicle:",
             fmt::format("fairway contract --log OTHER.csv --contract FILE.toml --tracking-m {}",
                         length_text(fit.tracking_m)),
             fmt::format("Flown at full turn: a radius of {} m, the median.",
                         decimal_text(fit.turn_radius_m, 1))};
  e.command_error = fmt::format("{:.3g} m of way and distance; {}", tight.command_error_m,
                                words.decided(ContractPart::command_error)) +
                    margin;
  if (margins.position_error_m > 0.0) {
    e.command_error += fmt::format("; and a position error of {:.3g} m", margins.position_error_m);
  }
  e.heading_error = fmt::format("{:.3g} degrees; {}", c.heading_error_rad * degrees,
                                words.decided(ContractPart::heading_error)) +
                    margin;
  e.turn_radius =
      fmt::format("the least {};\nthe most {}", words.decided(ContractPart::least_radius),
                  words.decided(ContractPart::most_radius)) +
      margin;
  e.speed = "over ground, the least and the most of the logs, smoothed" + margin;
  e.side_uncertain =
      fmt::format("{:.3g} degrees; {}, and not less than is turned over command_error_m",
                  c.side_uncertain_rad * degrees, words.decided(ContractPart::side)) +
      margin;
  return e;
}

}  // namespace fairway
