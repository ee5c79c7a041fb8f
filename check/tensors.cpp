#include "check/tensors.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fmt/format.h>
#include <openssl/sha.h>

namespace fairway_check {

static_assert(std::endian::native == std::endian::little, "arrays are read in place");

void require(bool good, std::string_view otherwise, int code) {
  if (!good) throw Defect(code, otherwise);
}

namespace {

using nlohmann::json;

constexpr std::size_t longest_header = 100'000'000;
constexpr std::size_t most_members = 32;  // of any object of a header
constexpr int deepest = 32;

std::size_t members_in(const json& value) {
  std::size_t count = value.is_object() ? value.size() : 0;
  for (const json& part : value) count += part.is_structured() ? members_in(part) : 0;
  return count;
}

/// Not deep, and no repeated keys: the value has as many members as the text has colons.
json strict_json(std::string_view text) {
  require(text.find('\0') == std::string_view::npos, "holds a zero byte", unreadable);
  std::size_t colons = 0;
  int depth = 0;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '"') quoted = !quoted;
    if (quoted && c == '\\') ++i;  // and the escaped character
    if (quoted) continue;
    colons += c == ':' ? 1 : 0;
    depth += c == '{' || c == '[' ? 1 : c == '}' || c == ']' ? -1 : 0;
    require(depth <= deepest, "nests JSON more than 32 deep", unreadable);
  }
  json value = json::parse(text);
  require(members_in(value) == colons, "has a key twice in an object", unreadable);
  return value;
}

std::vector<std::uint64_t> whole_numbers(const json& list) {
  for (const json& number : list) {
    require(number.is_number_unsigned(), "header: expected non-negative integers", unreadable);
  }
  return list.get<std::vector<std::uint64_t>>();
}

bool is_ascii(char c) { return (c >= ' ' && c <= '~') || c == '\t' || c == '\n' || c == '\r'; }

}  // namespace

TensorFile tensors_of(std::string_view text, std::span<const char> data) {
  static const std::map<std::string, std::uint64_t> widths{
      {"F64", 8}, {"I64", 8}, {"U64", 8}, {"F32", 4}, {"I32", 4}, {"U32", 4},
      {"I16", 2}, {"U16", 2}, {"I8", 1},  {"U8", 1},  {"BOOL", 1}};
  require(text.starts_with('{') && text.size() <= longest_header &&
              std::all_of(text.begin(), text.end(), is_ascii),
          "has a header that is not ASCII text", unreadable);
  const json header = strict_json(text);
  const json& metadata = header.at("__metadata__");
  require(header.size() <= most_members && metadata.is_object() &&
              metadata.size() <= most_members &&
              std::all_of(metadata.begin(), metadata.end(),
                          [](const json& m) { return m.is_string(); }),
          "has a header with too many members, or __metadata__ that is not strings", unreadable);
  TensorFile file;
  file.record = strict_json(metadata.at("fairway").get<std::string>());
  std::vector<std::array<std::uint64_t, 2>> places;
  for (const auto& [name, entry] : header.items()) {
    if (name == "__metadata__") continue;
    Tensor& tensor = file.tensors[name];
    tensor.type = entry.at("dtype").get<std::string>();
    tensor.shape = whole_numbers(entry.at("shape"));
    const auto offsets = whole_numbers(entry.at("data_offsets"));
    std::uint64_t bytes = widths.contains(tensor.type) ? widths.at(tensor.type) : 0;
    bool fits = bytes > 0 && entry.size() == 3 && tensor.shape.size() <= 8 && offsets.size() == 2 &&
                offsets[0] <= offsets[1] && offsets[1] <= data.size();
    for (const std::uint64_t extent : tensor.shape)
      fits = fits && !__builtin_mul_overflow(bytes, extent, &bytes);
    require(fits && bytes == offsets[1] - offsets[0],
            name + ": type, shape and offsets do not match, or the file is cut short", unreadable);
    tensor.bytes = data.subspan(offsets[0], bytes);
    places.push_back({offsets[0], offsets[1]});
  }
  std::sort(places.begin(), places.end());
  std::uint64_t filled = 0;
  for (const auto& [begin, end] : places) {
    require(begin == filled, "has arrays that overlap or leave gaps", unreadable);
    filled = end;
  }
  require(filled == data.size(), "has bytes after its last array", unreadable);
  return file;
}

TensorFile read_tensors(const std::string& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  struct stat status {};
  const bool is_file = ::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode);
  const std::size_t size = is_file ? static_cast<std::size_t>(status.st_size) : 0;
  void* const place = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, descriptor, 0);
  ::close(descriptor);
  require(place != MAP_FAILED, "cannot be read", unreadable);
  const std::shared_ptr<void> mapping(place, [size](void* at) { ::munmap(at, size); });
  const std::span<const char> all(static_cast<const char*>(place), size);
  std::uint64_t length = 0;
  require(size >= 8, "is not a safetensors file", unreadable);
  std::memcpy(&length, all.data(), 8);
  require(length <= size - 8, "is truncated, or not a safetensors file", unreadable);
  TensorFile file = tensors_of({all.data() + 8, length}, all.subspan(8 + length));
  file.mapping = mapping;
  return file;
}

std::string sha256(std::span<const char> bytes) {
  unsigned char digest[SHA256_DIGEST_LENGTH];
  SHA256(reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size(), digest);
  return fmt::format("{:02x}", fmt::join(digest, ""));
}

}  // namespace fairway_check
