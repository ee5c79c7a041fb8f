#include "fairway/run/contract_pictures.hpp"

#include <cstddef>

#include "fairway/base/atomic_file.hpp"
#include "fairway/base/parallel.hpp"
#include "fairway/inclusion/contract_lookup.hpp"
#include "fairway/report/draw_verdicts.hpp"

namespace fairway {

VerdictMap contract_verdict_map(const ContractCertificate& certificate) {
  constexpr int headings = 8;
  constexpr int most_across = 64;
  const Grid& grid = certificate.grid;
  VerdictMap map = VerdictMap::over(grid, headings, most_across);
  const Flow flow = certificate.flow();
  const Parts parts = certificate.parts();
  const double speed_mps = certificate.least_speed_mps();
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
            contract_answer(parts, certificate.verdicts, speed_mps, place, map.heading_rad[h])
                .verdict;
      }
    }
  });
  return map;
}

std::vector<std::string> contract_picture_files() { return {"contract.svg", "contract.png"}; }

void write_contract_pictures(const VerdictMap& map, const std::string& title,
                             const std::filesystem::path& folder) {
  const Picture picture = draw_verdicts(
      map, {.title = title + ": verdicts under the contract, near the cells' middles"});
  write_whole(folder / "contract.svg", Existing::keep, picture.svg);
  write_whole(folder / "contract.png", Existing::keep, picture.png);
}

}  // namespace fairway
