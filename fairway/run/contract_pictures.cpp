#include "fairway/run/contract_pictures.hpp"

#include <algorithm>
#include <cstddef>

#include "fairway/base/atomic_file.hpp"
#include "fairway/base/parallel.hpp"
#include "fairway/inclusion/quick_lookup.hpp"
#include "fairway/report/draw_verdicts.hpp"

namespace fairway {
namespace {

constexpr int most_across = 64;

/// As many as some seconds allow, and each also one of the exact vehicle's on the page.
int headings_for(std::size_t samples, int most) {
  constexpr std::size_t most_states = 40'000;
  for (const int headings : {72, 36, 24, 12}) {
    const bool is_little = static_cast<std::size_t>(headings) * samples <= most_states;
    if (headings <= most && (is_little || headings == 12)) return headings;
  }
  return most;
}

/// The rows [heading][samples] of every `step`th heading.
template <typename Value>
std::vector<Value> thinned(const std::vector<Value>& rows, std::size_t samples, std::size_t step) {
  std::vector<Value> few;
  for (std::size_t begin = 0; begin < rows.size(); begin += step * samples) {
    const auto row = rows.begin() + static_cast<std::ptrdiff_t>(begin);
    few.insert(few.end(), row, row + static_cast<std::ptrdiff_t>(samples));
  }
  return few;
}

}  // namespace

VerdictMap contract_verdict_map(const ContractCertificate& certificate, int most_headings) {
  const Grid& grid = certificate.grid;
  VerdictMap map = VerdictMap::over(grid, 1, most_across);
  map = VerdictMap::over(grid, headings_for(map.samples(), most_headings), most_across);
  const Flow flow = certificate.flow();
  const Parts parts = certificate.parts();
  const QuickLookup lookup(parts, certificate.verdicts, certificate.least_speed_mps());
  for_ranges(map.samples(), 4, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Cell cell = map.cell_of_sample(i);
      map.kind[i] = flow.kind_at({cell.ix, cell.iy});
      if (map.kind[i] != CellKind::ordinary) continue;
      const Vec2 at_m = map.place_m(i);
      const Vec2 place{(at_m.x - grid.x0_m) / parts.part_m(),
                       (at_m.y - grid.y0_m) / parts.part_m()};
      for (std::size_t h = 0; h < map.heading_rad.size(); ++h) {
        map.verdict[h * map.samples() + i] =
            flow.told(lookup.answer(place, map.heading_rad[h]).verdict, {cell.ix, cell.iy});
      }
    }
  });
  return map;
}

std::vector<std::string> contract_picture_files() { return {"contract.svg", "contract.png"}; }

void write_contract_pictures(const VerdictMap& map, const std::vector<std::uint8_t>* at_risk,
                             const std::string& title, const std::filesystem::path& folder) {
  constexpr std::size_t most_panels = 12;
  const std::size_t step = std::max<std::size_t>(1, map.heading_rad.size() / most_panels);
  VerdictMap few = map;
  few.heading_rad = thinned(map.heading_rad, 1, step);
  few.verdict = thinned(map.verdict, map.samples(), step);
  VerdictPictureOptions options;
  options.title = title + ": verdicts under the contract, near the cells' middles";
  std::vector<std::uint8_t> few_at_risk;
  if (at_risk != nullptr) {
    few_at_risk = thinned(*at_risk, map.samples(), step);
    options.at_risk = &few_at_risk;
  }
  const Picture picture = draw_verdicts(few, options);
  write_whole(folder / "contract.svg", Existing::keep, picture.svg);
  write_whole(folder / "contract.png", Existing::keep, picture.png);
}

}  // namespace fairway
