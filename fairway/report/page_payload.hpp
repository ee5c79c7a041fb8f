// Arrays for the page of a run, each compressed separately, so that a browser inflates only what
// it shows.
//
// Layout: 8 bytes little-endian length N of a JSON header; the header, an object of
// `{"dtype", "shape", "filter", "at": [begin, end]}` by name; then the compressed arrays (zlib
// streams, RFC 1950), `at` counted from byte 8 + N. Before compression an array is filtered:
//   none    its little-endian bytes unchanged
//   planes  the first byte of every element, then every second byte, and so on
//   delta   of integers: differences to the element before (the first to 0) modulo their size,
//           then as planes
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace fairway {

enum class PageFilter : std::uint8_t { none, planes, delta };

class PagePayload {
 public:
  /// `shape` in elements, the last running fastest. Throws PreconditionViolation for a name used
  /// twice or a shape that does not fit.
  void add(std::string_view name, std::vector<std::size_t> shape,
           std::span<const std::uint8_t> values);
  void add(std::string_view name, std::vector<std::size_t> shape,
           std::span<const std::uint16_t> values, PageFilter filter);
  void add(std::string_view name, std::vector<std::size_t> shape,
           std::span<const std::uint32_t> values, PageFilter filter);
  void add(std::string_view name, std::vector<std::size_t> shape, std::span<const float> values);
  /// A stream for each of the `shape[0]` layers: `at` is then [begin, end of layer 0, of layer 1,
  /// ...]. Layers are compressed on all threads.
  void add_layers(std::string_view name, std::vector<std::size_t> shape,
                  std::span<const std::uint8_t> values);

  /// The whole payload, as embedded in the page.
  [[nodiscard]] std::string bytes() const;

 private:
  struct Entry {
    std::string name;
    const char* dtype;
    std::vector<std::size_t> shape;
    PageFilter filter;
    std::vector<std::string> streams;
  };
  void add_entry(Entry entry, std::size_t elements);

  std::vector<Entry> entries_;
};

/// RFC 4648, with padding.
[[nodiscard]] std::string base64(std::string_view bytes);

}  // namespace fairway
