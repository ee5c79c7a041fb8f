// How a plan was made: everything in its file except the arrays (docs/formats.md).
//
// A plan made by Fairway has every member, and a contract if its scenario has one. Other plans may
// lack any of them, and may have members unknown to Fairway: these are kept, so that a file is
// written as it was read.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "fairway/base/frame.hpp"
#include "fairway/map/obstacle_map.hpp"
#include "fairway/vehicle/contract.hpp"
#include "fairway/vehicle/holding_place.hpp"
#include "fairway/vehicle/mission.hpp"

namespace fairway {

/// That commands were changed where verdicts confirmed that it helps. Shares are of all states,
/// proved to do what the mission asks, before and after.
struct ImprovedRecord {
  std::string from_sha256;  ///< of the commands before, as in the digests of that plan
  std::size_t cells_changed = 0;
  std::array<double, 2> exact{};
  std::optional<std::array<double, 2>> under_contract = std::nullopt;
  friend bool operator==(const ImprovedRecord&, const ImprovedRecord&) = default;
};

/// How a further mode was made (docs/modes.md).
struct ModeRecord {
  std::string rule;                                    ///< "direction" or "turning_places"
  std::optional<double> direction_rad = std::nullopt;  ///< the one that it goes on in
  friend bool operator==(const ModeRecord&, const ModeRecord&) = default;
};

struct PlanRecord {
  std::optional<std::string> program;  ///< name and version
  std::optional<Mission> mission;
  std::optional<Frame> frame;
  std::optional<std::vector<InputFile>> inputs;
  std::string options_json;  ///< every effective option, one JSON object; empty: none
  std::string more_json;     ///< members of other programs, one JSON object; empty: none
  std::optional<VehicleContract> contract = std::nullopt;  ///< none: the vehicle is exact
  std::vector<HoldingPlace> holding_places = {};           ///< in cells out of the mission's reach
  std::optional<ImprovedRecord> improved = std::nullopt;   ///< none: commands are the field's
  std::vector<ModeRecord> modes = {};                      ///< the further ones, in order
};

/// The record as one JSON object with sorted keys, as in the plan's file.
[[nodiscard]] std::string json_text(const PlanRecord& record);

/// The grid's frame; the default frame, the grid's own, when the record has none.
[[nodiscard]] inline Frame frame_in(const PlanRecord& record) {
  return record.frame.value_or(Frame{});
}

}  // namespace fairway
