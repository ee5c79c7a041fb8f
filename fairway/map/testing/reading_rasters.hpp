// For tests: rasters as other programs read them.
#pragma once

#include <cstddef>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include <gdal_priv.h>

#include "fairway/base/grid.hpp"
#include "fairway/map/gdal_raster.hpp"

namespace fairway {

struct ReadBand {
  std::string name;
  std::vector<float> values;  ///< [iy][ix]
};

/// The bands of a file whose pixels are the cells of `grid`.
inline std::vector<ReadBand> bands_of(const std::filesystem::path& file, const Grid& grid) {
  GdalRaster raster(file);
  GDALDataset& dataset = raster.dataset();
  if (dataset.GetRasterXSize() != grid.nx || dataset.GetRasterYSize() != grid.ny) {
    throw std::runtime_error("the raster is not as large as the grid");
  }
  std::vector<ReadBand> bands;
  std::vector<float> rows(grid.size());
  for (int i = 1; i <= dataset.GetRasterCount(); ++i) {
    GDALRasterBand& band = *dataset.GetRasterBand(i);
    if (band.RasterIO(GF_Read, 0, 0, grid.nx, grid.ny, rows.data(), grid.nx, grid.ny, GDT_Float32,
                      0, 0, nullptr) != CE_None) {
      throw std::runtime_error("a band cannot be read");
    }
    ReadBand& read = bands.emplace_back(ReadBand{band.GetDescription(), {}});
    for (std::size_t cell = 0; cell < grid.size(); ++cell) {
      const Cell c = grid.cell_at(cell);
      read.values.push_back(rows[grid.index({c.ix, grid.ny - 1 - c.iy})]);
    }
  }
  return bands;
}

/// A reference system by its number in the EPSG register.
inline std::string wkt_of_epsg(int number) {
  OGRSpatialReference system;
  char* wkt = nullptr;
  if (system.importFromEPSG(number) != OGRERR_NONE || system.exportToWkt(&wkt) != OGRERR_NONE) {
    throw std::runtime_error("no such reference system");
  }
  std::string text = wkt;
  CPLFree(wkt);
  return text;
}

}  // namespace fairway
