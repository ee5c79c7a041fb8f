// A bitmap's answers, place by place: paper 2's three-dimensional reachability map (section V.B,
// Fig. 23a) as slices of one heading each, and as the share of headings that reach. A noun for
// pictures.
//
// Properties that always hold: samples lie as in verify/verdict_map.hpp, at its `places`; where the
// cell is not ordinary nothing is asked: undecided, counts 0. Elsewhere the counts sum to
// headings_per_sample.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "fairway/bitmap/sampled.hpp"
#include "fairway/verify/verdict_map.hpp"

namespace fairway {

struct ReachabilityMap {
  VerdictMap places;            ///< grid, samples, kinds and headings; no verdicts
  std::vector<Sampled> answer;  ///< [headings][ny][nx], at places.place_m
  int headings_per_sample = 0;
  /// [ny][nx][Sampled]: answers at places.place_m for headings spread evenly over the circle.
  std::vector<std::array<std::uint16_t, sampled_count>> count;

  Sampled answer_at(std::size_t heading, std::size_t sample) const {
    return answer[heading * places.samples() + sample];
  }
};

}  // namespace fairway
