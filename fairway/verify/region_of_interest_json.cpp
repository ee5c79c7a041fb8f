#include "fairway/verify/region_of_interest_json.hpp"

#include <cstddef>

#include "fairway/base/error.hpp"

namespace fairway {

using nlohmann::json;

json json_of(const RegionOfInterest& region) {
  switch (region.kind) {
    case RegionOfInterest::Kind::goal:
      return "goal";
    case RegionOfInterest::Kind::obstacle:
      return "obstacle";
    case RegionOfInterest::Kind::rectangle:
      return region.rectangle_m;
    case RegionOfInterest::Kind::cells:
      return "cells";
  }
  return {};
}

RegionOfInterest region_of_interest_of(const json& value, const std::vector<CellKind>& kind,
                                       const std::string& where) {
  RegionOfInterest region;
  if (value == "goal") return region;
  region.kind = RegionOfInterest::Kind::obstacle;
  if (value == "obstacle") return region;
  if (value == "cells") {
    region.kind = RegionOfInterest::Kind::cells;
    for (const CellKind k : kind) region.cells.push_back(k == CellKind::target ? 1 : 0);
    return region;
  }
  region.kind = RegionOfInterest::Kind::rectangle;
  if (!value.is_array() || value.size() != 4) {
    throw InputError(where, "expected \"goal\", \"obstacle\", [x0, y0, x1, y1] or \"cells\"");
  }
  for (std::size_t i = 0; i < 4; ++i) {
    if (!value[i].is_number()) throw InputError(where, "expected four numbers");
    region.rectangle_m[i] = value[i].get<double>();
  }
  return region;
}

}  // namespace fairway
