// The parts L, S and R as a vehicle drove them. Private to the flights of the steering laws.
#pragma once

#include <string>
#include <vector>

namespace fairway {

/// The letters driven, with the length of each.
class DrivenWord {
 public:
  /// `curvature`: times the turning radius, -1 .. 1.
  void add(double curvature, double length) {
    const char letter = curvature > 0.5 ? 'L' : curvature < -0.5 ? 'R' : 'S';
    if (parts_.empty() || parts_.back().letter != letter) parts_.push_back({letter, 0.0});
    parts_.back().length += length;
  }
  /// Without parts shorter than `shortest`, at most 16 letters.
  std::string text(double shortest) const {
    std::string word;
    for (const Part& part : parts_) {
      if (part.length < shortest || (!word.empty() && word.back() == part.letter)) continue;
      word += part.letter;
      if (word.size() == 16) break;  // it wanders
    }
    return word;
  }

 private:
  struct Part {
    char letter;
    double length;
  };
  std::vector<Part> parts_;
};

}  // namespace fairway
