// Asks a certificate about states on a grid of places and headings; counts what is proved.
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <vector>

#include <fairway/runtime.hpp>

int main(int, char** argv) {
  std::ifstream file(argv[1], std::ios::binary | std::ios::ate);
  if (!file) return 2;
  const auto size = static_cast<std::size_t>(file.tellg());
  std::vector<std::uint64_t> bytes(size / 8 + 1);  // aligned as open() wants it
  file.seekg(0);
  file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));

  fairway::runtime::Certificate certificate;
  if (certificate.open(bytes.data(), size) != fairway::runtime::Status::ok) return 3;
  const fairway::Grid& grid = certificate.flow().grid;
  int asked = 0;
  int reach = 0;
  double longest_s = 0.0;
  for (int iy = 0; iy < grid.ny; ++iy) {
    for (int ix = 0; ix < grid.nx; ++ix) {
      for (const double heading_rad : {-2.5, -1.0, 0.5, 2.0}) {
        const double x_m = grid.x0_m + (ix + 0.5) * grid.cell_m;
        const double y_m = grid.y0_m + (iy + 0.5) * grid.cell_m;
        const auto answer = certificate.query(x_m, y_m, heading_rad);
        ++asked;
        if (answer.verdict != fairway::Verdict::reach) continue;
        ++reach;
        if (answer.time_bound_s > longest_s) longest_s = answer.time_bound_s;
      }
    }
  }
  const auto steer = certificate.command(8.0, 8.0, 3.0);
  std::printf("%d of %d states reach, within %.3f s; at the start steer to %.6f rad\n", reach,
              asked, longest_s, steer.heading_rad);
  return reach > asked / 4 && reach < asked && longest_s > 1.0 ? 0 : 1;
}
