#include <algorithm>
#include <cctype>
#include <vector>

#include <fmt/format.h>

#include "fairway/base/error.hpp"
#include "fairway/map/image_rows.hpp"

namespace fairway {

namespace {

// Tokens of a header or of plain samples, separated by blanks; '#' starts a comment.
class PnmReader {
 public:
  explicit PnmReader(const SourceText& source) : source_(source), at_(2) {}

  int number(const char* what, int max) {
    skip_blanks_and_comments();
    if (at_ >= source_.text.size()) fail(fmt::format("ends before the {}", what));
    const std::size_t begin = at_;
    std::int64_t value = 0;
    while (at_ < source_.text.size() && is_digit(source_.text[at_]))
      value = std::min(value * 10 + (source_.text[at_++] - '0'), std::int64_t{1} << 40);
    if (at_ == begin || (at_ < source_.text.size() && !is_blank_or_comment(source_.text[at_])))
      fail(fmt::format("the {} is not a whole number", what));
    if (value > max)
      fail(fmt::format("the {} is {}, expected at most {}", what,
                       std::string_view(source_.text).substr(begin, at_ - begin), max));
    return static_cast<int>(value);
  }

  // Exactly one blank separates the header from binary samples; a comment directly after the last
  // number takes its place, up to and including the line end.
  std::string_view binary_rest() {
    if (at_ < source_.text.size() && source_.text[at_] == '#') skip_comment();
    if (at_ >= source_.text.size()) fail("ends before the pixels");
    return std::string_view(source_.text).substr(at_ + 1);
  }

  // True after the last number of the header when blanks and a comment follow on its line.
  bool has_comment_for_pixels() const {
    const std::size_t from = source_.text.find_first_not_of(" \t", at_);
    return from != std::string::npos && from > at_ && source_.text[from] == '#';
  }

  // What follows the last value of a plain file, except blanks and comments.
  std::size_t left_over() {
    skip_blanks_and_comments();
    return source_.text.size() - at_;
  }

  [[noreturn]] void fail(const std::string& what) const {
    const auto end = source_.text.begin() + static_cast<std::ptrdiff_t>(at_);
    throw InputError(at_line(source_.file, 1 + static_cast<std::size_t>(
                                                   std::count(source_.text.begin(), end, '\n'))),
                     what);
  }

 private:
  static bool is_digit(char c) { return c >= '0' && c <= '9'; }
  static bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\f' || c == '\v';
  }
  static bool is_blank_or_comment(char c) { return is_blank(c) || c == '#'; }

  void skip_blanks_and_comments() {
    while (at_ < source_.text.size() && is_blank_or_comment(source_.text[at_])) {
      if (source_.text[at_] == '#')
        skip_comment();
      else
        ++at_;
    }
  }

  // Up to the line end, LF or CR.
  void skip_comment() {
    at_ = std::min(source_.text.find_first_of("\r\n", at_), source_.text.size());
  }

  const SourceText& source_;
  std::size_t at_;
};

void take_plain_rows(PnmReader& reader, const ImageFormat& format, std::size_t bytes,
                     const TakeRow& take_row) {
  // Each value takes a digit and a blank: a file that is too short is refused before allocating.
  const double values = static_cast<double>(format.width) * format.height * format.colours;
  if (2.0 * values - 1.0 > static_cast<double>(bytes))
    reader.fail(fmt::format("is truncated: {} bytes cannot hold {} by {} pixels", bytes,
                            format.width, format.height));
  std::vector<std::uint16_t> samples(static_cast<std::size_t>(format.width) *
                                     static_cast<std::size_t>(format.colours));
  for (int row = 0; row < format.height; ++row) {
    for (auto& sample : samples)
      sample = static_cast<std::uint16_t>(reader.number("pixel value", format.max_value));
    take_row(format, row, samples);
  }
}

// Returns how many bytes follow the last sample.
std::size_t take_binary_rows(PnmReader& reader, const ImageFormat& format,
                             const TakeRow& take_row) {
  const std::string_view bytes = reader.binary_rest();
  const std::size_t per_row =
      static_cast<std::size_t>(format.width) * static_cast<std::size_t>(format.colours);
  const std::size_t width_bytes = per_row * (format.max_value > 255 ? 2 : 1);
  const std::size_t needed = width_bytes * static_cast<std::size_t>(format.height);
  if (bytes.size() < needed)
    reader.fail(fmt::format("is truncated: {} bytes of pixels, expected {} for {} by {} pixels",
                            bytes.size(), needed, format.width, format.height));
  std::vector<std::uint16_t> samples(per_row);
  for (int row = 0; row < format.height; ++row) {
    const auto* from = reinterpret_cast<const unsigned char*>(bytes.data()) +
                       width_bytes * static_cast<std::size_t>(row);
    bool too_large = false;
    for (std::size_t i = 0; i < per_row; ++i) {
      // Two bytes a sample are big-endian.
      const int value = format.max_value > 255 ? from[2 * i] * 256 + from[2 * i + 1] : from[i];
      too_large |= value > format.max_value;
      samples[i] = static_cast<std::uint16_t>(value);
    }
    if (too_large)
      reader.fail(
          fmt::format("pixel row {} (from the top, 0 first) has a value above the maximum {}", row,
                      format.max_value));
    take_row(format, row, samples);
  }
  return bytes.size() - needed;
}

// Readers of the format agree that the pixels start one blank after the maximum value, so a
// comment there, or a two-byte line ending, shifts the image and leaves as many bytes over.
std::string left_over_words(const SourceText& source, std::size_t bytes, bool comment) {
  return fmt::format("{}: {} byte{} after the last pixel {} ignored; {}", source.file.string(),
                     bytes, bytes == 1 ? "" : "s", bytes == 1 ? "is" : "are",
                     comment ? "a comment after the maximum value is read as pixels and shifts "
                               "the image: put it before that line."
                             : "is the image shifted by as much, or is its size wrong?");
}

std::string shown_begin(std::string_view text) {
  return shown(text.substr(0, std::min(text.find_first_of("\r\n"), std::size_t{20})));
}

}  // namespace

bool is_pnm_file(const std::filesystem::path& file) {
  const std::string extension = lower(file.extension().string());
  return extension == ".pgm" || extension == ".ppm" || extension == ".pnm" || extension == ".pbm";
}

bool is_pnm(std::string_view head) {
  return head.size() >= 3 && head[0] == 'P' &&
         (head[1] == '2' || head[1] == '3' || head[1] == '5' || head[1] == '6') &&
         (std::isspace(static_cast<unsigned char>(head[2])) != 0 || head[2] == '#');
}

void require_image_size(const std::filesystem::path& file, std::int64_t width, std::int64_t height,
                        std::uint64_t max_pixels) {
  if (width < 1 || height < 1)
    throw InputError(file.string(),
                     fmt::format("the image is empty ({} by {} pixels)", width, height));
  if (static_cast<std::uint64_t>(width) > max_pixels / static_cast<std::uint64_t>(height))
    throw InputError(file.string(),
                     fmt::format("the image has {} by {} pixels, expected at most {} in all", width,
                                 height, max_pixels));
}

std::vector<std::string> read_pnm(const SourceText& source, std::uint64_t max_pixels,
                                  const TakeRow& take_row) {
  if (!is_pnm(source.text))
    throw InputError(at_line(source.file, 1),
                     fmt::format("starts with {}; a PGM starts with P5 or P2 and a PPM with P6 or "
                                 "P3, before any comment",
                                 shown_begin(source.text)));
  PnmReader reader(source);
  const char kind = source.text[1];
  ImageFormat format;
  format.colours = kind == '3' || kind == '6' ? 3 : 1;
  format.width = reader.number("width", 1 << 30);
  format.height = reader.number("height", 1 << 30);
  require_image_size(source.file, format.width, format.height, max_pixels);
  format.max_value = reader.number("maximum value", 65535);
  if (format.max_value < 1) reader.fail("the maximum value is 0, expected 1 to 65535");
  std::size_t left_over = 0;
  bool comment = false;
  if (kind == '2' || kind == '3') {
    take_plain_rows(reader, format, source.text.size(), take_row);
    left_over = reader.left_over();
  } else {
    comment = reader.has_comment_for_pixels();
    left_over = take_binary_rows(reader, format, take_row);
  }
  if (left_over == 0) return {};
  return {left_over_words(source, left_over, comment)};
}

}  // namespace fairway
