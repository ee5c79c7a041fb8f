#include "fairway/bitmap/sample_bitmap.hpp"

#include "fairway/base/error.hpp"
#include "fairway/base/parallel.hpp"
#include "fairway/bitmap/bitmap_lookup.hpp"

namespace fairway {

std::vector<Sampled> sampled_answers(const Bitmap& bitmap, std::span<const State> states) {
  const BitmapLookup lookup(bitmap);
  std::vector<Sampled> answers(states.size());
  for_ranges(states.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) answers[i] = lookup.answer(states[i]);
  });
  return answers;
}

ReachabilityMap reachability_map_of(const Bitmap& bitmap, const ReachabilityMapOptions& options) {
  require(options.headings >= 1 && options.most_across >= 1,
          "a reachability map has at least one heading and one sample across");
  require(options.headings_per_sample >= 0 && options.headings_per_sample <= 65535,
          "0 to 65535 headings a sample");
  const BitmapLookup lookup(bitmap);
  ReachabilityMap map;
  map.places = VerdictMap::over(bitmap.grid(), options.headings, options.most_across);
  map.headings_per_sample = options.headings_per_sample;
  VerdictMap& places = map.places;
  map.answer.assign(places.samples() * places.heading_rad.size(), Sampled::undecided);
  map.count.assign(places.samples(), {});
  for_ranges(places.samples(), 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      places.kind[i] = lookup.kind_at(places.grid.index(places.cell_of_sample(i)));
      if (places.kind[i] != CellKind::ordinary) continue;
      const auto asked = [&](double heading_rad) {
        return lookup.answer({places.place_m(i), Heading::from_rad(heading_rad)});
      };
      for (std::size_t h = 0; h < places.heading_rad.size(); ++h) {
        map.answer[h * places.samples() + i] = asked(places.heading_rad[h]);
      }
      for (int k = 0; k < map.headings_per_sample; ++k) {
        const Sampled found = asked(two_pi * (k + 0.5) / map.headings_per_sample);
        ++map.count[i][static_cast<std::size_t>(found)];
      }
    }
  });
  return map;
}

}  // namespace fairway
