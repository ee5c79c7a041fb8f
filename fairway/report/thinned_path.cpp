#include "fairway/report/thinned_path.hpp"

#include <algorithm>
#include <cmath>

#include "fairway/base/error.hpp"
#include "fairway/base/heading.hpp"

namespace fairway {
namespace {

using Piece = DrawingPath::Piece;

double bulge_of(const Piece& arc) {
  return arc.radius * (1.0 - std::cos(std::min(pi, 0.5 * std::abs(arc.sweep_rad))));
}

/// The line being drawn: from the anchor to the last point taken.
class Line {
 public:
  Line(DrawingPath& out, double reach_pt) : out_(out), reach_pt_(reach_pt) {}

  void begin_at(Vec2 p) {
    anchor_ = last_ = p;
    half_rad_ = pi;
    length_ = 0.0;
  }

  void take(Vec2 p) {
    if (!passes(p)) {
      out_.line_to(last_);
      begin_at(last_);
      (void)passes(p);
    }
    last_ = p;
  }

  void finish() {
    if (last_ != anchor_) out_.line_to(last_);
  }

 private:
  /// Whether the line may end at p; if so, narrows the directions it may still take.
  bool passes(Vec2 p) {
    const Vec2 along = p - anchor_;
    const double length = norm(along);
    if (length < length_) return false;
    length_ = length;
    if (length <= reach_pt_) return half_rad_ == pi;  // no direction yet: all of them pass
    const double middle = std::atan2(along.y, along.x);
    const double half = std::asin(reach_pt_ / length);
    if (half_rad_ == pi) {
      middle_rad_ = middle;
      half_rad_ = half;
      return true;
    }
    const double off = std::remainder(middle - middle_rad_, two_pi);
    if (std::abs(off) > half_rad_) return false;
    const double low = std::max(-half_rad_, off - half);
    const double high = std::min(half_rad_, off + half);
    middle_rad_ += 0.5 * (low + high);
    half_rad_ = 0.5 * (high - low);
    return true;
  }

  DrawingPath& out_;
  double reach_pt_;
  Vec2 anchor_;
  Vec2 last_;
  double length_ = 0.0;      // of the line so far
  double middle_rad_ = 0.0;  // the directions that pass all points: middle +- half
  double half_rad_ = pi;     // pi: any
};

}  // namespace

DrawingPath thinned(const DrawingPath& path, double tolerance_pt) {
  require(tolerance_pt > 0.0, "a tolerance is positive");
  const double bulge_pt = tolerance_pt / 3.0;
  DrawingPath out;
  Line line(out, tolerance_pt - bulge_pt);
  Vec2 start;
  for (const Piece& piece : path.pieces()) {
    switch (piece.kind) {
      case DrawingPath::Kind::move:
        line.finish();
        start = piece.end;
        out.move_to(start);
        line.begin_at(start);
        break;
      case DrawingPath::Kind::line:
        line.take(piece.end);
        break;
      case DrawingPath::Kind::arc:
        if (bulge_of(piece) <= bulge_pt) {
          line.take(piece.end);
          break;
        }
        line.finish();
        out.arc(piece.center, piece.radius, piece.from_rad, piece.sweep_rad);
        line.begin_at(piece.end);
        break;
      case DrawingPath::Kind::close:
        line.finish();
        out.close();
        line.begin_at(start);
        break;
    }
  }
  line.finish();
  return out;
}

}  // namespace fairway
