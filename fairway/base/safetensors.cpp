#include "fairway/base/safetensors.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <string_view>
#include <utility>

#include <nlohmann/json.hpp>

#include "fairway/base/error.hpp"
#include "fairway/base/strict_json.hpp"

namespace fairway {
namespace {

using nlohmann::json;

static_assert(std::endian::native == std::endian::little,
              "arrays are written as they are in memory");

constexpr std::array<std::pair<std::string_view, std::uint64_t>, 11> widths{{{"F64", 8},
                                                                             {"I64", 8},
                                                                             {"U64", 8},
                                                                             {"F32", 4},
                                                                             {"I32", 4},
                                                                             {"U32", 4},
                                                                             {"I16", 2},
                                                                             {"U16", 2},
                                                                             {"I8", 1},
                                                                             {"U8", 1},
                                                                             {"BOOL", 1}}};

std::uint64_t width_of(const std::string& dtype, const std::string& where) {
  for (const auto& [name, width] : widths) {
    if (name == dtype) return width;
  }
  throw InputError(where + ".dtype", "is " + shown(json(dtype)) + ", which is not supported");
}

std::uint64_t unsigned_integer(const json& value, const std::string& where) {
  if (!value.is_number_unsigned()) {
    throw InputError(where, "expected a non-negative integer, found " + shown(value));
  }
  return value.get<std::uint64_t>();
}

struct Placed {
  Tensor tensor;
  std::uint64_t begin = 0;
  std::uint64_t end = 0;
};

Placed placed_tensor(const std::string& name, const json& entry, std::span<const std::byte> data,
                     const std::string& where) {
  require_known_keys(entry, {"dtype", "shape", "data_offsets"}, where);
  Placed placed;
  placed.tensor.name = name;
  placed.tensor.dtype = text_member(entry, "dtype", where);
  std::uint64_t size = width_of(placed.tensor.dtype, where);
  const json& shape = member(entry, "shape", where);
  if (!shape.is_array() || shape.size() > 8) {
    throw InputError(where + ".shape", "expected an array of at most 8 sizes");
  }
  for (const json& extent : shape) {
    const std::uint64_t n = unsigned_integer(extent, where + ".shape");
    if (__builtin_mul_overflow(size, n, &size)) {
      throw InputError(where + ".shape", "is larger than any file: " + shown(shape));
    }
    placed.tensor.shape.push_back(n);
  }
  const json& offsets = member(entry, "data_offsets", where);
  if (!offsets.is_array() || offsets.size() != 2) {
    throw InputError(where + ".data_offsets", "expected [begin, end]");
  }
  placed.begin = unsigned_integer(offsets[0], where + ".data_offsets");
  placed.end = unsigned_integer(offsets[1], where + ".data_offsets");
  if (placed.begin > placed.end || placed.end > data.size()) {
    throw InputError(where + ".data_offsets", "are " + shown(offsets) + ", but the file holds " +
                                                  std::to_string(data.size()) +
                                                  " bytes of arrays; is it cut short?");
  }
  if (placed.end - placed.begin != size) {
    throw InputError(where + ".data_offsets", "span " + std::to_string(placed.end - placed.begin) +
                                                  " bytes, expected " + std::to_string(size) +
                                                  " for the type and shape");
  }
  placed.tensor.data = data.subspan(placed.begin, placed.end - placed.begin);
  return placed;
}

constexpr std::size_t most_members = 32;  // of any object of a header

/// Printable, or one of JSON's blanks.
bool is_ascii(char c) { return (c >= 0x20 && c <= 0x7e) || c == '\t' || c == '\n' || c == '\r'; }

/// Header text and the bytes after it.
std::pair<std::string_view, std::span<const std::byte>> split(std::span<const std::byte> bytes,
                                                              const std::string& where) {
  constexpr std::uint64_t longest = 100'000'000;  // the limit of the format's own reader
  if (bytes.size() < 8) {
    throw InputError(where, "is not a safetensors file: expected at least 8 bytes, found " +
                                std::to_string(bytes.size()));
  }
  std::uint64_t length = 0;
  for (std::size_t i = 8; i-- > 0;)
    length = (length << 8) | std::to_integer<std::uint64_t>(bytes[i]);
  if (length > longest || length > bytes.size() - 8) {
    if (bytes.size() == 8 || bytes[8] != std::byte{'{'})
      throw InputError(where, "is not a safetensors file, as plans and certificates are");
    throw InputError(where, "is not a whole safetensors file: its header would be " +
                                std::to_string(length) + " bytes, the file has " +
                                std::to_string(bytes.size()));
  }
  const auto text = bytes.subspan(8, length);
  return {{reinterpret_cast<const char*>(text.data()), text.size()}, bytes.subspan(8 + length)};
}

}  // namespace

Safetensors parse_safetensors(std::span<const std::byte> bytes, const std::string& where) {
  const auto [text, data] = split(bytes, where);
  const std::string header_place = where + ": header";
  if (!text.starts_with('{')) throw InputError(header_place, "expected to start with {");
  if (!std::all_of(text.begin(), text.end(), is_ascii)) {
    throw InputError(header_place, "expected ASCII text: other characters are written as \\uXXXX");
  }
  const json header = parse_strict_json(text, header_place, {.most_members = most_members});
  Safetensors content;
  std::vector<Placed> placed;
  for (const auto& [name, entry] : header.items()) {
    const std::string place = where + ": " + shown(json(name));
    if (name == "__metadata__") {
      if (!entry.is_object()) throw InputError(place, "expected an object of strings");
      for (const auto& [key, value] : entry.items())
        content.metadata[key] = text_member(entry, key.c_str(), place);
      continue;
    }
    placed.push_back(placed_tensor(name, entry, data, place));
  }
  std::stable_sort(placed.begin(), placed.end(), [](const Placed& a, const Placed& b) {
    return std::pair(a.begin, a.end) < std::pair(b.begin, b.end);
  });
  std::uint64_t filled = 0;
  for (Placed& p : placed) {
    if (p.begin != filled) {
      throw InputError(where + ": \"" + p.tensor.name + "\".data_offsets",
                       "begin at " + std::to_string(p.begin) + ", expected " +
                           std::to_string(filled) + ": arrays must be contiguous");
    }
    filled = p.end;
    content.tensors.push_back(std::move(p.tensor));
  }
  if (filled != data.size()) {
    throw InputError(where, "has " + std::to_string(data.size() - filled) +
                                " bytes after its last array, expected none");
  }
  return content;
}

std::string safetensors_header(const Safetensors& content) {
  // Written by hand: the header lists the arrays in their order in the file.
  std::string text = "{\"__metadata__\":" + json(content.metadata).dump();
  std::uint64_t offset = 0;
  for (const Tensor& tensor : content.tensors) {
    const std::uint64_t end = offset + tensor.data.size();
    text += "," + json(tensor.name).dump() + ":{\"dtype\":" + json(tensor.dtype).dump() +
            ",\"shape\":" + json(tensor.shape).dump() + ",\"data_offsets\":[" +
            std::to_string(offset) + "," + std::to_string(end) + "]}";
    offset = end;
  }
  text += "}";
  while (text.size() % 8 != 0) text += ' ';
  std::string length(8, '\0');
  for (std::size_t i = 0; i < 8; ++i)
    length[i] = static_cast<char>((text.size() >> (8 * i)) & 0xff);
  return length + text;
}

void write_safetensors(AtomicFile& file, const Safetensors& content) {
  file.write(safetensors_header(content));
  for (const Tensor& tensor : content.tensors) file.write(tensor.data);
}

}  // namespace fairway
