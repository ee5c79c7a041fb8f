#include "fairway/run/ask_bitmap.hpp"

#include "fairway/bitmap/sample_bitmap.hpp"
#include "fairway/run/ask_certificate.hpp"

namespace fairway {

std::vector<Sampled> sampled_at(const Bitmap& bitmap, Heading heading) {
  return sampled_answers(bitmap, states_asked_at(bitmap.grid(), heading));
}

std::vector<SampledLayer> sampled_layers(const Bitmap& bitmap, std::span<const Heading> headings) {
  std::vector<SampledLayer> layers;
  for (const Heading heading : headings) layers.push_back({heading, sampled_at(bitmap, heading)});
  return layers;
}

}  // namespace fairway
