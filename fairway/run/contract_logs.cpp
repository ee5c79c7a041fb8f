#include "fairway/run/contract_logs.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "fairway/base/error.hpp"
#include "fairway/base/number_text.hpp"
#include "fairway/base/parallel.hpp"
#include "fairway/identify/fitted_contract.hpp"
#include "fairway/identify/log_troubles.hpp"
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

}  // namespace

ExplainedContract contract_of_logs(const std::vector<FlightLog>& logs,
                                   std::optional<double> tracking_m, const FitMargins& margins) {
  const double radius_m = turn_radius_of(logs);
  std::vector<FlownTrack> tracks;
  for (const FlightLog& log : logs) {
    require_fine(log, radius_m);
    tracks.push_back(flown_track(log, smoothing_radii * radius_m));
  }
  const FitOptions options{tracking_m.value_or(usual_tracking_radii * radius_m), radius_m};
  Decider broken;
  const auto fit = fitted_contract(tracks, options, broken);
  if (fit) return explained(*fit, logs, margins);
  const LogSample& at = logs[broken.log].samples[broken.sample];
  throw InputError(
      fmt::format("{}:{}", logs[broken.log].name, at.line),
      fmt::format("no contract is kept: at t = {} and {} the vehicle leaves the {} m about every "
                  "motion towards its commands, even of the widest contract tried. Expected a "
                  "vehicle that follows its commands from the beginning of the log to its end; cut "
                  "out what was flown by hand",
                  time_text(at.time_s), place_text(at.place_m), length_text(options.tracking_m)));
}

HeldLog held_against(const FlightLog& log, const VehicleContract& contract, double tracking_m) {
  require_fine(log, contract.turn_radius_m.least);
  HeldLog held;
  held.name = log.name;
  held.kept = kept_contract(flown_track(log, smoothing_radii * contract.turn_radius_m.least),
                            contract, tracking_m);
  const LogSample& until = log.samples[held.kept.kept_until];
  const LogSample& worst = log.samples[held.kept.worst];
  held.kept_until_s = until.time_s;
  held.worst_s = worst.time_s;
  held.worst_m = worst.place_m;
  const std::string where =
      fmt::format("at t = {}, {}", time_text(worst.time_s), place_text(worst.place_m));
  if (held.kept.kept) {
    held.sentence = fmt::format("kept: a motion of the contract stays within {} m of the log "
                                "(allowed: {} m), the worst {}",
                                length_text(held.kept.needs_m), length_text(tracking_m), where);
    return held;
  }
  held.sentence = fmt::format("NOT kept: no motion of the contract was found that stays within {} m "
                              "of the log beyond t = {}, {}",
                              length_text(tracking_m), time_text(until.time_s),
                              place_text(until.place_m));
  held.sentence +=
      std::isfinite(held.kept.needs_m)
          ? fmt::format("; the log needs {} m, the worst {}", length_text(held.kept.needs_m), where)
          : fmt::format("; none within {:g} turning radii either, the worst {}", farthest_tried_radii,
                        where);
  return held;
}

std::size_t worst_of(const std::vector<HeldLog>& held) {
  const auto worst = std::max_element(held.begin(), held.end(), [](const HeldLog& a, const HeldLog& b) {
    return a.kept.needs_m < b.kept.needs_m;
  });
  return static_cast<std::size_t>(worst - held.begin());
}

std::string held_text(const std::vector<HeldLog>& held) {
  std::vector<const HeldLog*> order;
  for (const HeldLog& h : held) order.push_back(&h);
  std::stable_sort(order.begin(), order.end(), [](const HeldLog* a, const HeldLog* b) {
    return a->kept.kept < b->kept.kept;
  });
  std::string text;
  for (const HeldLog* h : order) text += fmt::format("{}: {}.\n", h->name, h->sentence);
  if (held.size() == 1) return text;
  const auto kept = std::count_if(held.begin(), held.end(), [](const HeldLog& h) { return h.kept.kept; });
  return text + fmt::format("{} of {} logs keep the contract.\n", kept, held.size());
}

json held_json(const std::vector<HeldLog>& held, double tracking_m) {
  json logs = json::array();
  for (const HeldLog& h : held) {
    json log{{"log", h.name},         {"kept", h.kept.kept},
             {"needs_m", nullptr},    {"worst_s", h.worst_s},
             {"worst_x_m", h.worst_m.x}, {"worst_y_m", h.worst_m.y}};
    if (std::isfinite(h.kept.needs_m)) log["needs_m"] = h.kept.needs_m;
    if (!h.kept.kept) log["kept_until_s"] = h.kept_until_s;
    logs.push_back(std::move(log));
  }
  return {{"tracking_m", tracking_m}, {"logs", std::move(logs)}};
}

Picture picture_of_log(const FlightLog& log, const HeldLog& held, double tracking_m) {
  LogPicture picture;
  picture.title = fmt::format("{}: contract {}", log.name, held.kept.kept ? "kept" : "not kept");
  for (const LogSample& sample : log.samples) picture.log_m.push_back(sample.place_m);
  picture.motion_m = held.kept.motion_m;
  picture.worst_name = fmt::format("worst place, t = {}", time_text(held.worst_s));
  picture.worst_sample = held.kept.worst;
  picture.tracking_m = tracking_m;
  return draw_log(picture);
}

}  // namespace fairway
