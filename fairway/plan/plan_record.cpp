#include "fairway/plan/plan_record.hpp"

#include "fairway/base/error.hpp"
#include "fairway/base/frame_json.hpp"
#include "fairway/base/strict_json.hpp"
#include "fairway/plan/plan_record_json.hpp"
#include "fairway/vehicle/contract_json.hpp"
#include "fairway/vehicle/mission_json.hpp"

namespace fairway {
namespace {

using nlohmann::json;

json object_of(const std::string& text, const char* promise) {
  if (text.empty()) return json::object();
  json value = json::parse(text, nullptr, false);
  require(value.is_object(), promise);
  return value;
}

json json_of(const HoldingPlace& place) {
  return {{"center_m", {place.center_m.x, place.center_m.y}},
          {"radius_m", place.radius_m},
          {"side", place.side == Rotation::left ? "left" : "right"}};
}

HoldingPlace holding_place_of(const json& value, const std::string& where) {
  const json& center = member(value, "center_m", where);
  if (!center.is_array() || center.size() != 2 || !center[0].is_number() ||
      !center[1].is_number()) {
    throw InputError(where + ".center_m", "expected [x, y], found " + shown(center));
  }
  const std::string side = text_member(value, "side", where);
  if (side != "left" && side != "right") {
    throw InputError(where + ".side", "is \"" + side + "\", expected \"left\" or \"right\"");
  }
  return {{center[0].get<double>(), center[1].get<double>()},
          finite_number(value, "radius_m", where),
          side == "left" ? Rotation::left : Rotation::right};
}

json json_of(const ImprovedRecord& improved) {
  json value = {{"from_sha256", improved.from_sha256},
                {"cells_changed", improved.cells_changed},
                {"exact", improved.exact}};
  if (improved.under_contract) value["under_contract"] = *improved.under_contract;
  return value;
}

ImprovedRecord improved_of(const json& value, const std::string& where) {
  if (!value.is_object()) throw InputError(where, "expected an object, found " + shown(value));
  const auto shares_of = [&](const char* key) {
    const json& shares = member(value, key, where);
    if (!shares.is_array() || shares.size() != 2 || !shares[0].is_number() ||
        !shares[1].is_number()) {
      throw InputError(where + "." + key, "expected [before, after], found " + shown(shares));
    }
    return std::array{shares[0].get<double>(), shares[1].get<double>()};
  };
  const json& cells = member(value, "cells_changed", where);
  if (!cells.is_number_unsigned()) {
    throw InputError(where + ".cells_changed", "expected a number of cells, found " + shown(cells));
  }
  ImprovedRecord improved{text_member(value, "from_sha256", where), cells.get<std::size_t>(),
                          shares_of("exact")};
  if (value.contains("under_contract")) improved.under_contract = shares_of("under_contract");
  return improved;
}

json json_of(const ModeRecord& mode) {
  json value = {{"rule", mode.rule}};
  if (mode.direction_rad) value["direction_rad"] = *mode.direction_rad;
  return value;
}

ModeRecord mode_of(const json& value, const std::string& where) {
  if (!value.is_object()) throw InputError(where, "expected an object, found " + shown(value));
  ModeRecord mode{text_member(value, "rule", where)};
  if (value.contains("direction_rad")) {
    mode.direction_rad = finite_number(value, "direction_rad", where);
  }
  return mode;
}

std::vector<InputFile> inputs_of(const json& value, const std::string& where) {
  if (!value.is_array()) throw InputError(where, "expected a list of files, found " + shown(value));
  std::vector<InputFile> inputs;
  for (const json& file : value) {
    inputs.push_back({text_member(file, "path", where), text_member(file, "sha256", where)});
  }
  return inputs;
}

}  // namespace

json json_of(const PlanRecord& record) {
  json value = object_of(record.more_json, "more_json is a JSON object");
  for (const char* key : {"program", "mission", "options", "inputs", "frame", "contract",
                          "holding_places", "improved", "modes"}) {
    require(!value.contains(key), "more_json leaves out what the record holds");
  }
  if (record.program) value["program"] = *record.program;
  if (record.mission) value["mission"] = json_of(*record.mission);
  if (!record.options_json.empty()) {
    value["options"] = object_of(record.options_json, "options_json is a JSON object");
  }
  if (record.inputs) {
    json& inputs = value["inputs"] = json::array();
    for (const InputFile& file : *record.inputs) {
      inputs.push_back({{"path", file.path}, {"sha256", file.sha256}});
    }
  }
  if (record.frame) value["frame"] = json_of(*record.frame);
  if (record.contract) value["contract"] = json_of(*record.contract);
  for (const HoldingPlace& place : record.holding_places) {
    value["holding_places"].push_back(json_of(place));
  }
  if (record.improved) value["improved"] = json_of(*record.improved);
  for (const ModeRecord& mode : record.modes) value["modes"].push_back(json_of(mode));
  return value;
}

PlanRecord plan_record_of(json value, const std::string& where) {
  PlanRecord record;
  const auto take = [&](const char* key, const auto& read) {
    const auto found = value.find(key);
    if (found == value.end()) return;
    if (!found->is_null()) read(*found, where + "." + key);
    value.erase(found);
  };
  take("program", [&](const json& found, const std::string& place) {
    if (!found.is_string()) throw InputError(place, "expected a string, found " + shown(found));
    record.program = found.get<std::string>();
  });
  take("mission", [&](const json& found, const std::string& place) {
    record.mission = mission_of(found, place);
  });
  take("options", [&](const json& found, const std::string& place) {
    if (!found.is_object()) throw InputError(place, "expected an object, found " + shown(found));
    record.options_json = found.dump();
  });
  take("inputs", [&](const json& found, const std::string& place) {
    record.inputs = inputs_of(found, place);
  });
  take("frame",
       [&](const json& found, const std::string& place) { record.frame = frame_of(found, place); });
  take("contract", [&](const json& found, const std::string& place) {
    record.contract = contract_of(found, place);
  });
  take("holding_places", [&](const json& found, const std::string& place) {
    if (!found.is_array()) throw InputError(place, "expected a list, found " + shown(found));
    for (const json& one : found) record.holding_places.push_back(holding_place_of(one, place));
  });
  take("improved", [&](const json& found, const std::string& place) {
    record.improved = improved_of(found, place);
  });
  take("modes", [&](const json& found, const std::string& place) {
    if (!found.is_array()) throw InputError(place, "expected a list, found " + shown(found));
    for (const json& one : found) record.modes.push_back(mode_of(one, place));
  });
  if (!value.empty()) record.more_json = value.dump();
  return record;
}

std::string json_text(const PlanRecord& record) {
  return json_of(record).dump(-1, ' ', true, json::error_handler_t::replace);
}

}  // namespace fairway
