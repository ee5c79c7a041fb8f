#include "fairway/report/tube_outline.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "fairway/base/error.hpp"
#include "fairway/base/parallel.hpp"
#include "fairway/report/contours.hpp"
#include "fairway/vehicle/path_locator.hpp"

namespace fairway {
namespace {

constexpr double most_across = 1500.0;

/// How far within the tube places are; of those farther from the path than `limit_m` only that they
/// are outside.
class Depth {
 public:
  Depth(const FollowProof& proof, double limit_m)
      : path_(proof.path), tube_(proof.tube), limit_m_(limit_m) {}

  double at(Vec2 place_m) const {
    const auto nearest = path_.nearest_within(place_m, limit_m_);
    if (!nearest) return -limit_m_;
    const double share = nearest->along_m / path_.length_m();
    const auto stretch = static_cast<std::size_t>(share * static_cast<double>(tube_.size()));
    return tube_[std::min(stretch, tube_.size() - 1)].distance_m - nearest->distance_m;
  }

 private:
  PathLocator path_;
  const std::vector<TubeStretch>& tube_;
  double limit_m_;
};

}  // namespace

double widest_m(const FollowProof& proof) {
  return static_cast<double>(widest_of(proof.tube).distance_m);
}

std::vector<std::vector<Vec2>> tube_outline(const FollowProof& proof, double step_m) {
  require(!proof.tube.empty() && step_m > 0.0, "a tube has stretches, a lattice a step");
  Vec2 low = proof.path.vertices_m.front();
  Vec2 high = low;
  for (const Vec2 p : proof.path.vertices_m) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  const double wide_m = widest_m(proof);
  const double across_m = std::max(high.x - low.x, high.y - low.y) + 2.0 * wide_m;
  const double step = std::max(step_m, across_m / most_across);
  // A rim of places outside the tube, so that all lines close.
  const Vec2 corner = low - Vec2{wide_m + 1.5 * step, wide_m + 1.5 * step};
  const auto places = [&](double from_m, double to_m) {
    return static_cast<int>(std::ceil((to_m + wide_m + 1.5 * step - from_m) / step)) + 1;
  };
  const int nx = places(corner.x, high.x);
  const int ny = places(corner.y, high.y);
  const auto place_m = [&](Vec2 p) { return corner + step * p; };
  const Depth depth(proof, wide_m + 3.0 * step);  // lines pass between neighbours
  const auto width = static_cast<std::size_t>(nx);
  std::vector<float> value(width * static_cast<std::size_t>(ny));
  for_ranges(value.size(), 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Vec2 p{static_cast<double>(i % width), static_cast<double>(i / width)};
      value[i] = static_cast<float>(depth.at(place_m(p)));
    }
  });
  std::vector<std::vector<Vec2>> lines = contour_lines(nx, ny, value, 0.0);
  for (std::vector<Vec2>& line : lines) {
    // Where the width jumps, interpolated lines are off: so most of their pieces decide.
    double deep = 0.0;
    for (std::size_t i = 1; i < line.size(); ++i) {
      const Vec2 along = line[i] - line[i - 1];
      const double length = norm(along);
      if (!(length > 0.0)) continue;
      const Vec2 left = line[i - 1] + 0.5 * along + 0.5 / length * left_of(along);
      deep += depth.at(place_m(left)) < 0.0 ? -length : length;
    }
    if (deep < 0.0) std::reverse(line.begin(), line.end());
    for (Vec2& p : line) p = place_m(p);
  }
  return lines;
}

}  // namespace fairway
