#include <algorithm>
#include <cmath>

#include "fairway/base/parallel.hpp"
#include "fairway/map/rasterise.hpp"
#include "fairway/map/world_frame.hpp"

namespace fairway {

namespace {

// Half-open range of pixels whose interior overlaps the interior of cell `j` along one axis.
struct PixelRange {
  int first = 0;
  int last = 0;
};

std::vector<PixelRange> overlaps(int cells, double cell_m, int pixels, double pixel_m) {
  std::vector<PixelRange> ranges(static_cast<std::size_t>(cells));
  const double limit = pixels;
  for (int j = 0; j < cells; ++j) {
    const double low = std::floor(j * cell_m / pixel_m + pixel_slack);
    const double high = std::ceil((j + 1) * cell_m / pixel_m - pixel_slack);
    ranges[static_cast<std::size_t>(j)] = {static_cast<int>(std::clamp(low, 0.0, limit)),
                                           static_cast<int>(std::clamp(high, 0.0, limit))};
  }
  return ranges;
}

class PixelRasteriser {
 public:
  PixelRasteriser(const SourceRaster& source, const RasteriseOptions& options, const Grid& grid,
                  std::vector<std::uint8_t>& cells)
      : source_(source), options_(options), grid_(grid), cells_(cells) {
    blocks_[static_cast<int>(Pixel::obstacle)] = 1;
    blocks_[static_cast<int>(Pixel::unknown)] = options.unknown_is_obstacle ? 1 : 0;
  }

  void without_growth() {
    const auto columns = overlaps(grid_.nx, grid_.cell_m, source_.width, source_.pixel_width_m);
    const auto rows = overlaps(grid_.ny, grid_.cell_m, source_.height, source_.pixel_height_m);
    for_rows(grid_.ny, [&](int begin, int end) {
      std::vector<std::uint8_t> blocked(static_cast<std::size_t>(source_.width));
      for (int iy = begin; iy < end; ++iy) {
        std::fill(blocked.begin(), blocked.end(), std::uint8_t{0});
        const PixelRange range = rows[static_cast<std::size_t>(iy)];
        for (int k = range.first; k < range.last; ++k) mark_pixels_of_row(k, blocked);
        std::uint8_t* out = row_of_cells(iy);
        for (int ix = 0; ix < grid_.nx; ++ix) {
          const PixelRange across = columns[static_cast<std::size_t>(ix)];
          std::uint8_t hit = 0;
          for (int i = across.first; i < across.last; ++i)
            hit |= blocked[static_cast<std::size_t>(i)];
          out[ix] = hit;
        }
      }
    });
  }

  // For each row of cells, only the nearest obstacle pixels below and above in each column of
  // pixels matter: a pixel with vertical gap g reaches sqrt(R^2 - g^2) to either side. Two sweeps
  // that carry the nearest rows along make the cost independent of R.
  void with_growth() {
    const auto rows_per_piece =
        static_cast<std::size_t>(16.0 + std::min(1e6, 4.0 * options_.growth_m / grid_.cell_m));
    for_ranges(static_cast<std::size_t>(grid_.ny), rows_per_piece,
               [&](std::size_t begin, std::size_t end) {
                 sweep_up(static_cast<int>(begin), static_cast<int>(end));
                 sweep_down(static_cast<int>(begin), static_cast<int>(end));
               });
  }

 private:
  static constexpr int none = -1;

  std::uint8_t* row_of_cells(int iy) { return cells_.data() + grid_.index({0, iy}); }

  // Pixel rows are counted from the bottom here, like cell rows.
  const Pixel* row_from_bottom(int k) const { return source_.row(source_.height - 1 - k); }

  void mark_pixels_of_row(int k, std::vector<std::uint8_t>& blocked) const {
    const Pixel* pixels = row_from_bottom(k);
    for (std::size_t i = 0; i < blocked.size(); ++i)
      blocked[i] |= blocks_[static_cast<std::size_t>(pixels[i])];
  }

  void carry(int k, std::vector<int>& nearest) const {
    const Pixel* pixels = row_from_bottom(k);
    for (std::size_t i = 0; i < nearest.size(); ++i)
      if (blocks_[static_cast<std::size_t>(pixels[i])]) nearest[i] = k;
  }

  int clamped_row(double row) const {
    return static_cast<int>(std::clamp(row, 0.0, static_cast<double>(source_.height)));
  }

  void sweep_up(int begin, int end) {
    const double pixel_m = source_.pixel_height_m;
    std::vector<int> nearest(static_cast<std::size_t>(source_.width), none);
    std::vector<int> covered(static_cast<std::size_t>(grid_.nx) + 1);
    // Rows lower than the first cell row by R or more cannot matter.
    int k = clamped_row(std::floor((begin * grid_.cell_m - options_.growth_m) / pixel_m) - 1.0);
    for (int iy = begin; iy < end; ++iy) {
      const double top_m = (iy + 1) * grid_.cell_m;
      for (; k < source_.height && k * pixel_m <= top_m; ++k) carry(k, nearest);
      mark_row(iy, nearest, covered,
               [&](int row) { return std::max(0.0, iy * grid_.cell_m - (row + 1) * pixel_m); });
    }
  }

  void sweep_down(int begin, int end) {
    const double pixel_m = source_.pixel_height_m;
    std::vector<int> nearest(static_cast<std::size_t>(source_.width), none);
    std::vector<int> covered(static_cast<std::size_t>(grid_.nx) + 1);
    int k = clamped_row(std::ceil((end * grid_.cell_m + options_.growth_m) / pixel_m) + 1.0) - 1;
    for (int iy = end - 1; iy >= begin; --iy) {
      const double bottom_m = iy * grid_.cell_m;
      for (; k >= 0 && (k + 1) * pixel_m >= bottom_m; --k) carry(k, nearest);
      mark_row(iy, nearest, covered,
               [&](int row) { return std::max(0.0, row * pixel_m - (iy + 1) * grid_.cell_m); });
    }
  }

  // `covered` is a difference array: +1 where a covered run of cells starts, -1 after its end.
  template <typename Gap>
  void mark_row(int iy, const std::vector<int>& nearest, std::vector<int>& covered,
                const Gap& gap_m) {
    const double radius_m = options_.growth_m;
    const double slack_m = pixel_slack * std::min(source_.pixel_width_m, source_.pixel_height_m);
    std::fill(covered.begin(), covered.end(), 0);
    const int width = source_.width;
    for (int i = 0; i < width;) {
      const int row = nearest[static_cast<std::size_t>(i)];
      const int first = i++;
      while (i < width && nearest[static_cast<std::size_t>(i)] == row) ++i;
      if (row == none) continue;
      const double gap = gap_m(row);
      if (gap >= radius_m - slack_m) continue;
      const double reach_m = std::sqrt(radius_m * radius_m - gap * gap) - slack_m;
      const double limit = grid_.nx;
      const double low = std::floor((first * source_.pixel_width_m - reach_m) / grid_.cell_m);
      const double high = std::ceil((i * source_.pixel_width_m + reach_m) / grid_.cell_m);
      const int from = static_cast<int>(std::clamp(low, 0.0, limit));
      const int to = static_cast<int>(std::clamp(high, 0.0, limit));
      if (from >= to) continue;
      ++covered[static_cast<std::size_t>(from)];
      --covered[static_cast<std::size_t>(to)];
    }
    std::uint8_t* out = row_of_cells(iy);
    int depth = 0;
    for (int ix = 0; ix < grid_.nx; ++ix) {
      depth += covered[static_cast<std::size_t>(ix)];
      out[ix] |= static_cast<std::uint8_t>(depth > 0);
    }
  }

  const SourceRaster& source_;
  const RasteriseOptions& options_;
  const Grid& grid_;
  std::vector<std::uint8_t>& cells_;
  std::uint8_t blocks_[3] = {0, 0, 0};
};

}  // namespace

ObstacleMap rasterise(const SourceRaster& source, const RasteriseOptions& options) {
  const MapExtent extent{source.lower_left_m, source.width * source.pixel_width_m,
                         source.height * source.pixel_height_m};
  const Grid inner = grid_over(extent, options);
  ObstacleMap map;
  map.obstacle.resize(inner.size());
  PixelRasteriser rasteriser(source, options, inner, map.obstacle);
  if (options.growth_m > 0.0)
    rasteriser.with_growth();
  else
    rasteriser.without_growth();
  map.grid = close_world(inner, extent, options, map.obstacle);
  map.frame.world_from_grid = source.world_from_grid;
  map.frame.projected_crs = source.projected_crs;
  map.inputs = source.inputs;
  map.warnings = source.warnings;
  return map;
}

}  // namespace fairway
