#include "fairway/run/contract_failure_pictures.hpp"

#include <cstddef>

#include "fairway/base/atomic_file.hpp"
#include "fairway/base/parallel.hpp"
#include "fairway/base/random.hpp"
#include "fairway/report/draw_flights.hpp"
#include "fairway/report/draw_verdicts.hpp"
#include "fairway/run/ask_contract.hpp"
#include "fairway/run/contract_pictures.hpp"
#include "fairway/run/find_at_risk.hpp"

namespace fairway {
namespace {

void write(const Picture& picture, const std::filesystem::path& folder, const std::string& name) {
  write_whole(folder / (name + ".svg"), Existing::keep, picture.svg);
  write_whole(folder / (name + ".png"), Existing::keep, picture.png);
}

/// Counts verdicts over all headings and places of each sample's cell, headings in even strata.
void count_verdicts(const ContractCertificate& certificate, std::uint64_t seed, VerdictMap& map) {
  constexpr int states = 8;
  map.states_per_sample = states;
  const Grid& grid = certificate.grid;
  const ContractQueries queries(certificate);
  for_ranges(map.samples(), 4, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (map.kind[i] != CellKind::ordinary) continue;
      const Cell cell = map.cell_of_sample(i);
      Random random = Random::stream(seed, grid.index(cell));
      for (int k = 0; k < states; ++k) {
        const Vec2 in{random.unit(), random.unit()};
        const double heading_rad = -pi + two_pi * (k + random.unit()) / states;
        const Vec2 place_m = grid.corner({cell.ix, cell.iy}) + grid.cell_m * in;
        const ContractReply reply = queries.proved({place_m, Heading::from_rad(heading_rad)});
        ++map.count[i][static_cast<std::size_t>(reply.verdict)];
      }
    }
  });
}

}  // namespace

Picture picture_of_verdicts(const ContractCertificate& certificate, const VerdictMap& map,
                            const std::string& title) {
  const PageWitnesses found = find_at_risk(certificate, map, {.most_steps = 0});
  VerdictPictureOptions options;
  options.title = title + ": verdicts under the contract, near the cells' middles";
  options.at_risk = &found.at_risk;
  return draw_verdicts(map, options);
}

void write_contract_verdict_pictures(const Plan& plan, const ContractCertificate& certificate,
                                     const NamedFlights& counterexamples, std::uint64_t seed,
                                     const std::string& title,
                                     const std::filesystem::path& folder) {
  VerdictMap map = contract_verdict_map(certificate);
  count_verdicts(certificate, seed, map);
  write(picture_of_verdicts(certificate, map, title), folder, "verdicts");
  write(draw_proved_shares(map, {.title = title + ": verdicts under the contract, over all "
                                                  "headings"}),
        folder, "proved");
  if (counterexamples.flights.empty()) return;
  write(draw_flights(plan, counterexamples.flights,
                     {.title = title + ": a flight to each kind of failure under the contract",
                      .mission = {},
                      .names = counterexamples.names}),
        folder, "counterexamples");
}

}  // namespace fairway
