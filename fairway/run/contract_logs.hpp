// A contract fitted to flight logs, and logs held against a contract.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "fairway/identify/explained_contract.hpp"
#include "fairway/identify/fitted_words.hpp"
#include "fairway/identify/flight_log.hpp"
#include "fairway/identify/kept_contract.hpp"
#include "fairway/report/picture.hpp"

namespace fairway {

/// Where --tracking-m is not given: this share of the turning radius, the one flown at full turn
/// when a contract is fitted, the contract's least when one is given.
inline constexpr double usual_tracking_radii = 0.1;

/// The tightest contract that all the logs keep. Throws InputError{LOG, ...} for a log that never
/// turns, one whose samples are too far apart, and where no contract is kept.
[[nodiscard]] ExplainedContract contract_of_logs(const std::vector<FlightLog>& logs,
                                                 std::optional<double> tracking_m,
                                                 const FitMargins& margins, SideRule sides);

/// A log held against a contract.
struct HeldLog {
  std::string name;
  KeptContract place;
  bool kept = false;  ///< in place and speed
  double kept_until_s = 0.0;
  double worst_s = 0.0;
  Vec2 worst_m;
  /// "kept: a motion of the contract stays within 1.2 m (allowed 2) ..." or "NOT kept: ...".
  std::string sentence;
};

[[nodiscard]] HeldLog held_against(const FlightLog& log, const VehicleContract& contract,
                                   double tracking_m, SideRule sides);

/// The logs' lines, worst first, and a sentence on all.
[[nodiscard]] std::string held_text(const std::vector<HeldLog>& held);
[[nodiscard]] nlohmann::json held_json(const std::vector<HeldLog>& held, double tracking_m);

/// The log that needs the widest tracking distance.
[[nodiscard]] std::size_t worst_of(const std::vector<HeldLog>& held);

/// A log, the nearest motion found, and the worst place.
[[nodiscard]] Picture picture_of_log(const FlightLog& log, const HeldLog& held, double tracking_m);

}  // namespace fairway
