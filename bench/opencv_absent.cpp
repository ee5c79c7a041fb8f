#include "bench/opencv.hpp"

namespace fairway::bench {

struct OpenCv::Images {};

OpenCv::OpenCv(int) {}
OpenCv::~OpenCv() = default;
bool OpenCv::is_there() { return false; }
void OpenCv::place_features(std::span<const std::uint8_t>, int, int) {}
void OpenCv::distance_transform() {}
std::span<const float> OpenCv::distances() const { return {}; }
void OpenCv::place_vectors(std::span<const float>, std::span<const float>, int, int) {}
void OpenCv::gaussian_blur(double, int) {}
void OpenCv::gaussian_blur_on_threads(double, int) {}
std::span<const float> OpenCv::blurred() const { return {}; }

}  // namespace fairway::bench
