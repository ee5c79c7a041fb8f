#include "check/contract_places.hpp"

namespace fairway_check {

Shape moved(const Shape& at, Point by) {
  Shape all;
  for (const Point p : at.corners()) all.add(p + by);
  return all;
}

Shape within(const Shape& at, const Box& box) {
  Shape all;
  for (const Point p : at.corners()) {
    all.add({std::clamp(p.x, box.x0, box.x1), std::clamp(p.y, box.y0, box.y1)});
  }
  return all;
}

}  // namespace fairway_check
