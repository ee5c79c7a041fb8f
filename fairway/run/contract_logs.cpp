#include "fairway/run/contract_logs.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "fairway/base/error.hpp"
#include "fairway/base/number_text.hpp"
#include "fairway/base/parallel.hpp"
#include "fairway/identify/fitted_contract.hpp"
#include "fairway/identify/log_troubles.hpp"
#include "fairway/identify/nearest_motion.hpp"
#include "fairway/report/draw_log.hpp"

namespace fairway {
namespace {

using nlohmann::json;

constexpr double smoothing_radii = 0.125;

std::string time_text(double time_s) { return decimal_text(time_s, 2) + " s"; }

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// The radius smooths the track that it is taken from: first with a few samples, then as it should.
double turn_radius_of(const FlightLog& log) {
  constexpr double first_samples = 8.0;
  const FlownTrack rough = flown_track(log, 0.0);
  const double step_m = rough.way_m.back() / static_cast<double>(rough.size() - 1);
  const double first_m = turn_radius_flown_m(flown_track(log, first_samples * step_m));
  require_turns(log, first_m);
  return turn_radius_flown_m(flown_track(log, smoothing_radii * first_m));
}

double turn_radius_of(const std::vector<FlightLog>& logs) {
  std::vector<double> radii_m;
  for (const FlightLog& log : logs) {
    radii_m.push_back(turn_radius_of(log));
    require_turns(log, radii_m.back());
  }
  return median(std::move(radii_m));
}

std::string place_words(const FlightLog& log, const HeldLog& held, double tracking_m) {
  const LogSample& until = log.samples[held.place.kept_until];
  const std::string where =
      fmt::format("the worst at t = {}, {}", time_text(held.worst_s), place_text(held.worst_m));
  if (held.place.kept) {
    return fmt::format("a motion of the contract stays within {} m of the log (allowed: {} m), {}",
                       length_text(held.place.needs_m), length_text(tracking_m), where);
  }
  const std::string lost = fmt::format(
      "no motion of the contract was found that stays within {} m of the log beyond t = {}, {}",
      length_text(tracking_m), time_text(until.time_s), place_text(until.place_m));
  if (std::isfinite(held.place.needs_m)) {
    return fmt::format("{}; the log needs {} m, {}", lost, length_text(held.place.needs_m), where);
  }
  return lost + "; nor farther away, where its commands would not be in force";
}

/// The contract's ranges as they show over ground, where logs are; its look-ahead stays.
VehicleContract seen_over_ground(const VehicleContract& contract) {
  VehicleContract seen = over_ground(contract);
  seen.command_error_m = contract.command_error_m;
  seen.look_ahead_m = contract.look_ahead_m;
  return seen;
}

/// The fit in words, widened by a little more where its search, which drops motions, loses its way
/// in the rounded numbers.
ExplainedContract kept_by_all(const FittedContract& fit, const std::vector<FlightLog>& logs,
                              const std::vector<FlownTrack>& tracks, const FitMargins& margins,
                              SideRule sides) {
  ExplainedContract words;
  for (const double more : {0.0, 0.01, 0.02, 0.05, 0.1}) {
    words = explained(fit, logs, {margins.share + more, margins.position_error_m});
    const bool kept = std::all_of(tracks.begin(), tracks.end(), [&](const FlownTrack& track) {
      return nearest_motion(track, words.contract, {.limit_m = fit.tracking_m, .sides = sides})
          .stays;
    });
    if (kept) break;
  }
  return words;
}

}  // namespace

ExplainedContract contract_of_logs(const std::vector<FlightLog>& logs,
                                   std::optional<double> tracking_m, const FitMargins& margins,
                                   SideRule sides) {
  const double radius_m = turn_radius_of(logs);
  std::vector<FlownTrack> tracks;
  for (const FlightLog& log : logs) {
    require_fine(log, radius_m);
    tracks.push_back(flown_track(log, smoothing_radii * radius_m));
  }
  const FitOptions options{tracking_m.value_or(usual_tracking_radii * radius_m), radius_m, sides};
  Decider broken;
  const auto fit = fitted_contract(tracks, options, broken);
  if (fit) return kept_by_all(*fit, logs, tracks, margins, sides);
  const LogSample& at = logs[broken.log].samples[broken.sample];
  throw InputError(
      fmt::format("{}:{}", logs[broken.log].name, at.line),
      fmt::format("no contract is kept: at t = {} and {} the vehicle leaves the {} m about every "
                  "motion towards its commands, even of the widest contract tried. Expected a "
                  "vehicle that follows its commands from the beginning of the log to its end; cut "
                  "out what was flown by hand",
                  time_text(at.time_s), place_text(at.place_m), length_text(options.tracking_m)));
}

HeldLog held_against(const FlightLog& log, const VehicleContract& given, double tracking_m,
                     SideRule sides) {
  const VehicleContract contract = seen_over_ground(given);
  require_fine(log, contract.turn_radius_m.least);
  const FlownTrack track = flown_track(log, smoothing_radii * contract.turn_radius_m.least);
  HeldLog held;
  held.name = log.name;
  held.place = kept_contract(track, contract, tracking_m, sides);
  held.kept = held.place.kept && !held.place.wrong_speed;
  held.kept_until_s = log.samples[held.place.kept_until].time_s;
  held.worst_s = log.samples[held.place.worst].time_s;
  held.worst_m = log.samples[held.place.worst].place_m;
  held.sentence =
      std::string(held.kept ? "kept: " : "NOT kept: ") + place_words(log, held, tracking_m);
  if (const auto i = held.place.wrong_speed) {
    held.sentence += fmt::format(
        "; at t = {} it flies at {:.3g} m/s, the contract says {:.3g} to {:.3g} m/s: times would "
        "be "
        "wrong, places not",
        time_text(log.samples[*i].time_s), track.speed_mps[*i], contract.speed_mps.least,
        contract.speed_mps.most);
  }
  return held;
}

std::size_t worst_of(const std::vector<HeldLog>& held) {
  const auto worst = std::max_element(
      held.begin(), held.end(),
      [](const HeldLog& a, const HeldLog& b) { return a.place.needs_m < b.place.needs_m; });
  return static_cast<std::size_t>(worst - held.begin());
}

std::string held_text(const std::vector<HeldLog>& held) {
  std::vector<const HeldLog*> order;
  for (const HeldLog& h : held) order.push_back(&h);
  std::stable_sort(order.begin(), order.end(),
                   [](const HeldLog* a, const HeldLog* b) { return a->kept < b->kept; });
  std::string text;
  for (const HeldLog* h : order) text += fmt::format("{}: {}.\n", h->name, h->sentence);
  if (held.size() == 1) return text;
  const auto kept =
      std::count_if(held.begin(), held.end(), [](const HeldLog& h) { return h.kept; });
  return text + fmt::format("{} of {} logs keep the contract.\n", kept, held.size());
}

json held_json(const std::vector<HeldLog>& held, double tracking_m) {
  json logs = json::array();
  for (const HeldLog& h : held) {
    json log{{"log", h.name},        {"kept", h.kept},           {"needs_m", nullptr},
             {"worst_s", h.worst_s}, {"worst_x_m", h.worst_m.x}, {"worst_y_m", h.worst_m.y}};
    if (std::isfinite(h.place.needs_m)) log["needs_m"] = h.place.needs_m;
    if (!h.place.kept) log["kept_until_s"] = h.kept_until_s;
    log["speed_kept"] = !h.place.wrong_speed;
    logs.push_back(std::move(log));
  }
  return {{"tracking_m", tracking_m}, {"logs", std::move(logs)}};
}

Picture picture_of_log(const FlightLog& log, const HeldLog& held, double tracking_m) {
  LogPicture picture;
  picture.title = fmt::format("{}: contract {}", log.name, held.kept ? "kept" : "not kept");
  for (const LogSample& sample : log.samples) picture.log_m.push_back(sample.place_m);
  picture.motion_m = held.place.motion_m;
  picture.worst_name = fmt::format("worst place, t = {}", time_text(held.worst_s));
  picture.worst_sample = held.place.worst;
  picture.tracking_m = tracking_m;
  return draw_log(picture);
}

}  // namespace fairway
