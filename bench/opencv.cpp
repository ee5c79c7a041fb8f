#include "bench/opencv.hpp"

#include <cstddef>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace fairway::bench {

struct OpenCv::Images {
  cv::Mat free;
  cv::Mat distance;
  cv::Mat vectors;
  cv::Mat blurred;
};

OpenCv::OpenCv(int threads) : images_(std::make_unique<Images>()) { cv::setNumThreads(threads); }
OpenCv::~OpenCv() = default;

bool OpenCv::is_there() { return true; }

void OpenCv::place_features(std::span<const std::uint8_t> feature, int nx, int ny) {
  images_->free.create(ny, nx, CV_8UC1);  // OpenCV measures to the nearest zero
  for (std::size_t i = 0; i < feature.size(); ++i) images_->free.data[i] = feature[i] == 0 ? 1 : 0;
}

void OpenCv::distance_transform() {
  cv::distanceTransform(images_->free, images_->distance, cv::DIST_L2, cv::DIST_MASK_PRECISE,
                        CV_32F);
}

std::span<const float> OpenCv::distances() const {
  return {images_->distance.ptr<float>(), images_->distance.total()};
}

void OpenCv::place_vectors(std::span<const float> x, std::span<const float> y, int nx, int ny) {
  images_->vectors.create(ny, nx, CV_32FC2);
  auto* at = images_->vectors.ptr<float>();
  for (std::size_t i = 0; i < x.size(); ++i) {
    at[2 * i] = x[i];
    at[2 * i + 1] = y[i];
  }
}

void OpenCv::gaussian_blur(double sigma_cells, int half_width) {
  const int n = 2 * half_width + 1;
  cv::GaussianBlur(images_->vectors, images_->blurred, cv::Size(n, n), sigma_cells, sigma_cells);
}

void OpenCv::gaussian_blur_on_threads(double sigma_cells, int half_width) {
  const cv::Size kernel(2 * half_width + 1, 2 * half_width + 1);
  const int rows = images_->vectors.rows;
  const int bands = cv::getNumThreads();
  images_->blurred.create(images_->vectors.size(), images_->vectors.type());
  const auto blur = [&](const cv::Range& range) {
    for (int band = range.start; band < range.end; ++band) {
      // A part of an image: the filter reads the rows around it from the whole image.
      const cv::Range part(rows * band / bands, rows * (band + 1) / bands);
      cv::Mat out = images_->blurred.rowRange(part);
      cv::GaussianBlur(images_->vectors.rowRange(part), out, kernel, sigma_cells, sigma_cells);
    }
  };
  cv::parallel_for_(cv::Range(0, bands), blur, bands);
}

std::span<const float> OpenCv::blurred() const {
  return {images_->blurred.ptr<float>(), 2 * images_->blurred.total()};
}

}  // namespace fairway::bench
