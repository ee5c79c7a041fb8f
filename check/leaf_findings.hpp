// What is found out about a certificate's leaves, in the words of the report: the same for both
// kinds of certificates.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "check/flight.hpp"

namespace fairway_check {

/// Of the leaves' sections, [sections + 1], the one that a leaf lies in.
inline std::size_t section_of_leaf(const std::vector<std::uint32_t>& first, std::size_t leaf) {
  return static_cast<std::size_t>(std::upper_bound(first.begin(), first.end(), leaf) -
                                  first.begin()) -
         1;
}

/// `told`: a bit for every verdict.
inline std::string told_instead(unsigned told) {
  std::string text = "re-proved outcomes:";
  for (unsigned v = 0; v < verdict_count; ++v)
    text += (told >> v & 1U) != 0 ? fmt::format(" {}", verdict_name[v]) : "";
  return text;
}

/// "" when no leaf fails, else which does first, and why. `fails`: 1 or 0 for every leaf of `c`.
template <typename Certificate, typename Why>
std::string defect_of_leaves(const Certificate& c, const std::vector<std::uint8_t>& fails, Why why,
                             nlohmann::ordered_json& report) {
  for (std::size_t v = 0; v < verdict_count; ++v) {
    report["leaves"][verdict_name[v]] = std::count(c.verdict.begin(), c.verdict.end(), v);
  }
  const auto first =
      static_cast<std::size_t>(std::find(fails.begin(), fails.end(), 1) - fails.begin());
  report["leaves_not_reproved"] = std::count(fails.begin(), fails.end(), 1);
  if (first == fails.size()) return "";
  return fmt::format("{} of {} leaves could not be re-proved, the first is {}, claimed to {}: {}",
                     report["leaves_not_reproved"].dump(), fails.size(), c.name_of(first),
                     verdict_name[c.verdict[first]], why(c.section_of(first), first));
}

}  // namespace fairway_check
