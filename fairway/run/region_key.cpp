#include "fairway/run/region_key.hpp"

namespace fairway {

using nlohmann::json;

void take(const TomlValue& v, RegionRequest& x) {
  constexpr const char* expected =
      "\"goal\", \"obstacle\", [x0, y0, x1, y1] with x0 < x1 and y0 < y1, or the name of a file";
  if (v.is_text()) {
    const auto request = region_request_of(v.text());
    if (!request || request->kind == RegionOfInterest::Kind::rectangle) v.refuse(expected);
    x = *request;
    return;
  }
  const std::vector<double> r = v.numbers(4);
  if (!(r[0] < r[2] && r[1] < r[3])) v.refuse(expected);
  x = {RegionOfInterest::Kind::rectangle, {r[0], r[1], r[2], r[3]}, {}};
}

json shown(const RegionRequest& x) {
  switch (x.kind) {
    case RegionOfInterest::Kind::goal:
      return "goal";
    case RegionOfInterest::Kind::obstacle:
      return "obstacle";
    case RegionOfInterest::Kind::rectangle:
      return x.rectangle_m;
    case RegionOfInterest::Kind::cells:
      return x.file.string();
  }
  return {};
}

}  // namespace fairway
