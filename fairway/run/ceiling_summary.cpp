#include "fairway/run/ceiling_summary.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "fairway/base/share_text.hpp"

namespace fairway {
namespace {

nlohmann::json bounds(const CeilingShare& share) { return {share.lower, share.upper}; }

/// Rounded outwards: what is printed holds, too.
std::string bounds_text(const CeilingShare& share) {
  return fmt::format("{} to {}", percent_text(std::floor(share.lower * 1000.0) / 1000.0),
                     percent_text(std::min(1.0, std::ceil(share.upper * 1000.0) / 1000.0)));
}

}  // namespace

nlohmann::json json_of(const Ceiling& c) {
  return {{"ceiling", bounds(c.all)},
          {"ceiling_free", bounds(c.free)},
          {"ceiling_buffer", bounds(c.buffer)},
          {"cells", {c.grid.nx, c.grid.ny}},
          {"headings", c.headings},
          {"nodes_per_cell", c.nodes_per_cell},
          {"levels", c.levels},
          {"complete", c.complete}};
}

std::string words_of(const Ceiling& c) {
  std::string words;
  if (!c.complete) words = "A limit of time or memory came first. ";
  if (c.levels == 0) return words + "Nothing was found out.";
  return words + fmt::format(
                     "From {} of all states some control brings the vehicle to the "
                     "mission (safe starts {}, buffer {}); no plan can keep more.",
                     bounds_text(c.all), bounds_text(c.free), bounds_text(c.buffer));
}

double share_of_ceiling(const Ceiling& ceiling, double proved) {
  if (ceiling.all.upper <= 0.0) return 1.0;
  return std::min(1.0, proved / ceiling.all.upper);
}

}  // namespace fairway
