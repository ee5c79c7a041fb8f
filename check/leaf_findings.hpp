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

/// "" when no leaf fails, else which does first, and why. `fails`: 1 or 0 for every leaf of
/// `proof`. Adds to the counts of the report.
template <typename Proof, typename Why>
std::string defect_of_leaves(const Proof& proof, const std::vector<std::uint8_t>& fails, Why why,
                             nlohmann::ordered_json& report) {
  const auto add = [](nlohmann::ordered_json& count, std::ptrdiff_t more) {
    count = (count.is_null() ? 0 : count.get<std::ptrdiff_t>()) + more;
  };
  for (std::size_t v = 0; v < verdict_count; ++v) {
    add(report["leaves"][verdict_name[v]],
        std::count(proof.verdict.begin(), proof.verdict.end(), v));
  }
  const auto failing = std::count(fails.begin(), fails.end(), 1);
  add(report["leaves_not_reproved"], failing);
  if (failing == 0) return "";
  const auto first =
      static_cast<std::size_t>(std::find(fails.begin(), fails.end(), 1) - fails.begin());
  return fmt::format("{} of {} leaves could not be re-proved, the first is {}, claimed to {}: {}",
                     failing, fails.size(), proof.name_of(first),
                     verdict_name[proof.verdict[first]], why(proof.section_of(first), first));
}

}  // namespace fairway_check
