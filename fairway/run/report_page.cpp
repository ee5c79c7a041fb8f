#include "fairway/run/report_page.hpp"

#include <algorithm>
#include <optional>
#include <span>

#include <fmt/format.h>

#include "fairway/base/atomic_file.hpp"
#include "fairway/map/degrees_from_frame.hpp"
#include "fairway/report/page.hpp"
#include "fairway/report/page_template.hpp"
#include "fairway/run/products.hpp"
#include "fairway/run/verification_summary.hpp"
#include "fairway/verify/sample_verdicts.hpp"

namespace fairway {
namespace {

/// Every cell up to 512 across, and headings 5 degrees apart; on the largest plans 15 degrees,
/// so that sampling takes seconds (a microsecond a state and core) and the page stays small.
VerdictMapOptions sampling_of(const Grid& grid) {
  VerdictMapOptions options;
  options.most_across = 512;
  options.headings = page_headings(grid);
  options.states_per_sample = 0;
  return options;
}

/// Shown instead of the assumptions when there is no certificate.
std::vector<std::string> nothing_proved() {
  return {
      fmt::format("Nothing on this page is proved. What the samples of {} show at every place is "
                  "drawn in slices.svg and sampled.svg, next to this page.",
                  product::bitmap)};
}

/// Failures from safe starts with a command first, then the scenario's own flights.
std::vector<PageFlights> flights_of(const std::vector<FailingFlights>& failing,
                                    std::span<const Flight> given, std::span<const Flight> random) {
  std::vector<PageFlights> groups;
  const auto add_failing = [&](bool from_safe_starts) {
    for (const FailingFlights& from : failing) {
      if ((from.ground == StartGround::safe_start) != from_safe_starts) continue;
      groups.push_back({"failing", from.flights, from.flights.size(), name_of(from.ground)});
    }
  };
  add_failing(true);
  groups.push_back({"given", given, 100});
  add_failing(false);
  groups.push_back({"random", random, 100});
  return groups;
}

}  // namespace

int page_headings(const Grid& grid) { return std::max(grid.nx, grid.ny) <= 512 ? 72 : 24; }

std::string write_report_page(const Plan& plan, const Mission& mission,
                              const ScenarioFlights& flown, const ReportPage& page,
                              const std::filesystem::path& folder) {
  if (!has_page_template()) {
    return fmt::format("{} was not written: {}", product::report_page, page_template());
  }
  std::optional<VerdictMap> verdicts;
  if (page.certificate != nullptr) {
    verdicts = verdict_map_of(page.certificate->view(), sampling_of(plan.grid));
  }
  const std::span recorded(flown.recorded);
  const std::size_t given = std::min(flown.given, recorded.size());
  const PageContent content{
      page.title,
      plan,
      mission,
      flights_of(page.failing, recorded.first(given), recorded.subspan(given)),
      verdicts ? &*verdicts : nullptr,
      page.words,
      page.summary.dump(-1, ' ', true),
      verdicts ? proof_assumptions() : nothing_proved(),
      lon_lat_of(frame_in(plan.record), page.title),
      page.contract_verdicts,
      page.witnesses,
      page.follow,
      page.exact_contract};
  write_whole(folder / product::report_page, Existing::keep, page_html(content));
  return {};
}

}  // namespace fairway
