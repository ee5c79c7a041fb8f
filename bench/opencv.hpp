// OpenCV, a peer on the same arrays. Without it (opencv_absent.cpp) there are no results.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

namespace fairway::bench {

class OpenCv {
 public:
  /// `threads` limits OpenCV's own threads.
  explicit OpenCv(int threads);
  ~OpenCv();
  OpenCv(const OpenCv&) = delete;
  OpenCv& operator=(const OpenCv&) = delete;

  [[nodiscard]] static bool is_there();

  /// Exact Euclidean distances to the nearest nonzero cell of `feature`
  /// (distanceTransform, DIST_L2, DIST_MASK_PRECISE), [iy][ix], in cells. place_features() first.
  void place_features(std::span<const std::uint8_t> feature, int nx, int ny);
  void distance_transform();
  [[nodiscard]] std::span<const float> distances() const;

  /// GaussianBlur of an image with two floats per pixel, kernels of 2 half_width + 1.
  void place_vectors(std::span<const float> x, std::span<const float> y, int nx, int ny);
  void gaussian_blur(double sigma_cells, int half_width);
  /// The same result from one call per thread, in parallel on bands of rows: GaussianBlur runs on
  /// one thread for float images.
  void gaussian_blur_on_threads(double sigma_cells, int half_width);
  [[nodiscard]] std::span<const float> blurred() const;  ///< x and y alternating

 private:
  struct Images;
  std::unique_ptr<Images> images_;
};

}  // namespace fairway::bench
