// Where a vehicle that cannot stop waits: a circle, flown round and round.
#pragma once

#include "fairway/base/vec2.hpp"

namespace fairway {

enum class Rotation { left, right };

struct HoldingPlace {
  Vec2 center_m;
  double radius_m = 0.0;
  Rotation side = Rotation::left;
  friend bool operator==(const HoldingPlace&, const HoldingPlace&) = default;
};

}  // namespace fairway
