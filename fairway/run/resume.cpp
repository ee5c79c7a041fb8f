#include "fairway/run/resume.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "fairway/base/error.hpp"
#include "fairway/certificate/proof_identity.hpp"
#include "fairway/verify/reprove.hpp"

namespace fairway {
namespace {

std::size_t decided_leaves(const SectionVerdicts& sections) {
  const auto undecided = std::count(sections.verdict.begin(), sections.verdict.end(),
                                    static_cast<std::uint8_t>(Verdict::undecided));
  return sections.verdict.size() - static_cast<std::size_t>(undecided);
}

}  // namespace

SectionVerdicts taken_over(EarlierProof earlier, const Certificate& now, int most_crossings,
                           const std::function<bool()>& go_on, Resumed& resumed) {
  Certificate& certificate = earlier.certificate;
  if (proof_identity(certificate) != proof_identity(now)) {
    throw InputError(earlier.where,
                     "belongs to a different plan, vehicle or region; cannot resume from it");
  }
  if (!sections_fit(now.flow(), certificate.sections)) {
    throw InputError(earlier.where, "has leaves where the plan allows none; cannot resume from it");
  }
  resumed.from = earlier.where;
  resumed.decided = decided_leaves(certificate.sections);
  SectionVerdicts sections =
      reproved(now.flow(), std::move(certificate.sections), most_crossings, go_on);
  resumed.dropped = resumed.decided - decided_leaves(sections);
  resumed.in_time = resumed.dropped == 0 || go_on();
  return sections;
}

std::string resumed_words(const Resumed& r) {
  if (r.dropped == 0) {
    return fmt::format("All {} decided leaves of {} were proved again.", r.decided, r.from);
  }
  return fmt::format("Of {} decided leaves of {}, {} were dropped: {}.", r.decided, r.from,
                     r.dropped,
                     r.in_time ? "they could not be proved again"
                               : "the time limit left no time to prove them again");
}

nlohmann::json resumed_json(const Resumed& r) {
  return {{"from", r.from},
          {"decided_leaves", r.decided},
          {"dropped_leaves", r.dropped},
          {"in_time", r.in_time}};
}

}  // namespace fairway
