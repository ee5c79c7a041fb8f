#include "fairway/map/occupancy.hpp"

#include <array>
#include <cmath>

#include <fmt/format.h>

namespace fairway {

namespace {

// Classes of all possible sums of a pixel's samples, computed once; and how often each occurred.
class OccupancyTable {
 public:
  OccupancyTable(const ImageFormat& format, const OccupancyRule& rule)
      : averaged_(rule.mode == OccupancyRule::Mode::trinary ? format.channels() : format.colours) {
    const int top = averaged_ * format.max_value;
    classes_.resize(static_cast<std::size_t>(top) + 1);
    for (int sum = 0; sum <= top; ++sum)
      classes_[static_cast<std::size_t>(sum)] = class_of(sum, top, rule);
    counts_.resize(classes_.size());
    grey_205_ =
        format.max_value == 255 ? 205 * format.colours + 255 * (averaged_ - format.colours) : -1;
    if (averaged_ == format.colours) return;
    const int colour_top = format.colours * format.max_value;
    for (int sum = 0; sum <= colour_top; ++sum)
      without_alpha_.push_back(class_of(sum, colour_top, rule));
  }

  int averaged() const { return averaged_; }

  Pixel take(unsigned sum) {
    ++counts_[sum];
    return classes_[sum];
  }

  /// Where alpha is averaged in: the class from the colours alone.
  void compare(unsigned colours, Pixel with_alpha) {
    if (without_alpha_.empty() || with_alpha == without_alpha_[colours]) return;
    ++by_alpha_[static_cast<std::size_t>(with_alpha)];
  }

  void count_transparent() { ++transparent_; }

  void warn_of_alpha(const OccupancyRule& rule, const std::string& image,
                     std::vector<std::string>& warnings) const {
    if (transparent_ > 0)
      warnings.push_back(fmt::format(
          "{}: {} pixels are not opaque (alpha channel); they count as unknown in mode scale.",
          image, transparent_));
    std::string made;
    for (const auto& [pixel, name] : {std::pair(Pixel::obstacle, "obstacles"),
                                      {Pixel::unknown, "unknown (by default obstacles)"},
                                      {Pixel::free, "free"}}) {
      const std::uint64_t count = by_alpha_[static_cast<std::size_t>(pixel)];
      if (count > 0) made += fmt::format("{}{} pixels {}", made.empty() ? "" : ", ", count, name);
    }
    if (made.empty()) return;
    warnings.push_back(
        fmt::format("{}: the alpha channel, which mode trinary averages in like a colour{}, "
                    "makes {} where "
                    "the colours alone would not; save the image without alpha.",
                    image, rule.negate ? " (with negate, opaque is occupied)" : "", made));
  }

  void warn(const OccupancyRule& rule, const std::string& image,
            std::vector<std::string>& warnings) const {
    if (rule.mode == OccupancyRule::Mode::trinary) {
      if (grey_205_ < 0) return;
      const auto at = static_cast<std::size_t>(grey_205_);
      if (classes_[at] == Pixel::free && counts_[at] > 0)
        warnings.push_back(
            fmt::format("{}: {} pixels have the grey 205 that map savers write for unknown; with "
                        "free_thresh {} they are read as free (0.196 keeps them unknown).",
                        image, counts_[at], rule.free));
      return;
    }
    std::uint64_t graded = 0;
    for (std::size_t sum = 0; sum < counts_.size(); ++sum)
      if (classes_[sum] == Pixel::unknown) graded += counts_[sum];
    if (graded > 0)
      warnings.push_back(
          fmt::format("{}: {} pixels are neither certainly free nor certainly occupied in mode {}; "
                      "they count as unknown.",
                      image, graded, rule.mode == OccupancyRule::Mode::raw ? "raw" : "scale"));
  }

 private:
  static Pixel class_of(int sum, int top, const OccupancyRule& rule) {
    if (rule.mode == OccupancyRule::Mode::raw) {
      const double percent = std::round(255.0 * sum / top);
      return percent == 0.0 ? Pixel::free : percent == 100.0 ? Pixel::obstacle : Pixel::unknown;
    }
    // A single rounding: grey 205 gives the double nearest to 50 / 255.
    const double occ = static_cast<double>(rule.negate ? sum : top - sum) / top;
    if (occ > rule.occupied) return Pixel::obstacle;
    if (occ < rule.free) return Pixel::free;
    if (rule.mode == OccupancyRule::Mode::trinary) return Pixel::unknown;
    const double percent = std::rint(100.0 * (occ - rule.free) / (rule.occupied - rule.free));
    return percent <= 0.0 ? Pixel::free : percent >= 100.0 ? Pixel::obstacle : Pixel::unknown;
  }

  int averaged_;
  int grey_205_ = -1;
  std::vector<Pixel> without_alpha_;  // by the sum of the colours; empty when alpha does not count
  std::array<std::uint64_t, 3> by_alpha_{};
  std::uint64_t transparent_ = 0;
  std::vector<Pixel> classes_;
  std::vector<std::uint64_t> counts_;
};

void classify_row(const ImageFormat& format, const OccupancyRule& rule,
                  std::span<const std::uint16_t> samples, OccupancyTable& table, Pixel* out) {
  const auto channels = static_cast<std::size_t>(format.channels());
  const auto averaged = static_cast<std::size_t>(table.averaged());
  const bool needs_opaque = rule.mode == OccupancyRule::Mode::scale && format.alpha;
  for (std::size_t i = 0; i < static_cast<std::size_t>(format.width); ++i) {
    const std::uint16_t* pixel = samples.data() + i * channels;
    unsigned sum = 0;
    for (std::size_t c = 0; c < averaged; ++c) sum += pixel[c];
    out[i] = table.take(sum);
    if (averaged > static_cast<std::size_t>(format.colours))
      table.compare(sum - pixel[channels - 1], out[i]);
    if (needs_opaque && pixel[channels - 1] != format.max_value) {
      out[i] = Pixel::unknown;
      table.count_transparent();
    }
    if (format.nodata && pixel[0] == *format.nodata) out[i] = Pixel::unknown;
  }
}

}  // namespace

SourceRaster read_occupancy(const std::filesystem::path& image, const OccupancyRule& rule,
                            std::uint64_t max_pixels) {
  SourceRaster raster;
  std::optional<OccupancyTable> table;
  const std::vector<std::string> of_image =
      read_image(image, max_pixels,
                 [&](const ImageFormat& format, int row, std::span<const std::uint16_t> samples) {
                   if (!table) {
                     raster.width = format.width;
                     raster.height = format.height;
                     raster.pixels.resize(static_cast<std::size_t>(format.width) *
                                          static_cast<std::size_t>(format.height));
                     table.emplace(format, rule);
                   }
                   classify_row(format, rule, samples, *table, raster.row(row));
                 });
  raster.warnings = of_image;
  if (table) table->warn_of_alpha(rule, image.string(), raster.warnings);
  if (table) table->warn(rule, image.string(), raster.warnings);
  return raster;
}

}  // namespace fairway
