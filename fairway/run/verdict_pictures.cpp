#include "fairway/run/verdict_pictures.hpp"

#include "fairway/base/atomic_file.hpp"
#include "fairway/report/draw_flights.hpp"
#include "fairway/report/draw_verdicts.hpp"
#include "fairway/simulate/exact_flight.hpp"
#include "fairway/verify/sample_verdicts.hpp"

namespace fairway {
namespace {

void write(const Picture& picture, const std::filesystem::path& folder, const std::string& name) {
  write_whole(folder / (name + ".svg"), Existing::keep, picture.svg);
  write_whole(folder / (name + ".png"), Existing::keep, picture.png);
}

std::string titled(const std::string& title, const char* what) {
  return title.empty() ? what : title + ": " + what;
}

/// The plan with the region of interest for a goal, as the certificate's flights see it.
Plan as_verified(Plan plan, const Certificate& certificate) {
  for (std::size_t i = 0; i < plan.region.size(); ++i) {
    if (certificate.kind[i] == CellKind::target) {
      plan.region[i] = Region::goal;
    } else if (plan.region[i] == Region::goal) {
      plan.region[i] = Region::free;
    }
  }
  return plan;
}

double flown_m(const Flight& flight) {
  double length_m = 0.0;
  for (const FlightSegment& piece : flight.segments) length_m += piece.length_m;
  return length_m;
}

std::vector<Flight> longest_of_each(const ExactFlights& flights,
                                    const std::vector<FailingState>& failing) {
  std::vector<Flight> longest;
  for (const Verdict verdict : verdicts_in_order) {
    if (!fails(verdict)) continue;
    std::vector<State> starts;
    for (const FailingState& state : failing) {
      if (state.verdict == verdict) starts.push_back(state.start);
    }
    const std::vector<Flight> flown = flights.record_all(starts);
    const Flight* best = nullptr;
    for (const Flight& flight : flown) {
      if (best == nullptr || flown_m(flight) > flown_m(*best)) best = &flight;
    }
    if (best != nullptr) longest.push_back(*best);
  }
  return longest;
}

}  // namespace

std::vector<std::string> verdict_picture_files() {
  return {"verdicts.svg", "verdicts.png",        "proved.svg",
          "proved.png",   "counterexamples.svg", "counterexamples.png"};
}

void write_verdict_pictures(const Plan& plan, const Certificate& certificate,
                            const std::vector<FailingState>& failing, std::uint64_t seed,
                            const std::string& title, const std::filesystem::path& folder) {
  VerdictMapOptions sampled;
  sampled.seed = seed;
  const VerdictMap map = verdict_map_of(certificate.flow(), certificate.sections.view(), sampled);
  write(draw_verdicts(map, {.title = titled(title, "verdicts near the cells' middles")}), folder,
        "verdicts");
  write(draw_proved_shares(map, {.title = titled(title, "verdicts over all headings")}), folder,
        "proved");

  const Plan flown = as_verified(plan, certificate);
  const std::vector<Flight> flights = longest_of_each(ExactFlights(flown), failing);
  if (flights.empty()) return;
  write(
      draw_flights(
          flown, flights,
          {.title = titled(title, "a flight to each kind of failure"), .mission = {}, .names = {}}),
      folder, "counterexamples");
}

}  // namespace fairway
