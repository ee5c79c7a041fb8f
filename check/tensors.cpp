#include "check/tensors.hpp"

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstring>
#include <set>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <openssl/evp.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

namespace fairway_check {
namespace {

using nlohmann::json;

static_assert(std::endian::native == std::endian::little, "arrays are read as they lie");

std::span<const std::byte> map_file(const std::string& path, TensorFile& file) {
  const int handle = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  struct stat about {};
  if (handle < 0 || fstat(handle, &about) != 0 || !S_ISREG(about.st_mode)) {
    const int error = errno;
    if (handle >= 0) close(handle);
    throw Malformed(fmt::format("{}: cannot be read: {}", path,
                                handle < 0 ? std::strerror(error) : "it is no regular file"));
  }
  const auto size = static_cast<std::size_t>(about.st_size);
  void* at = size == 0 ? MAP_FAILED : mmap(nullptr, size, PROT_READ, MAP_PRIVATE, handle, 0);
  close(handle);
  if (at == MAP_FAILED) throw Malformed(path + ": is empty, or cannot be mapped into memory");
  file.mapped = {static_cast<const std::byte*>(at),
                 [at, size](const std::byte*) { munmap(at, size); }};
  return {file.mapped.get(), size};
}

/// JSON without repeated keys.
json parse(const char* begin, const char* end, const std::string& where) {
  std::vector<std::set<std::string>> keys;
  try {
    return json::parse(begin, end, [&](int, json::parse_event_t event, json& value) {
      if (event == json::parse_event_t::object_start) keys.emplace_back();
      if (event == json::parse_event_t::object_end) keys.pop_back();
      if (event == json::parse_event_t::key && !keys.back().insert(value).second) {
        throw Malformed(where + ": has a key twice: " + value.dump());
      }
      return true;
    });
  } catch (const json::exception& error) {
    throw Malformed(fmt::format("{}: is not JSON: {}", where, error.what()));
  }
}

std::uint64_t whole(const json& value, const std::string& where) {
  if (!value.is_number_unsigned()) throw Malformed(where + ": expected whole numbers");
  return value.get<std::uint64_t>();
}

/// One array of the header, and its place.
std::pair<std::uint64_t, std::uint64_t> take(const json& entry, const std::string& where,
                                             std::span<const std::byte> data, Tensor& tensor) {
  static const std::map<std::string, std::uint64_t> widths{
      {"F64", 8}, {"F32", 4}, {"U32", 4}, {"I8", 1}, {"U8", 1}};
  const json& type = member(entry, "dtype");
  const json& shape = member(entry, "shape");
  const json& offsets = member(entry, "data_offsets");
  if (!type.is_string() || !widths.contains(type) || !shape.is_array() || shape.size() > 2 ||
      !offsets.is_array() || offsets.size() != 2) {
    throw Malformed(where + ": has a type, a shape or offsets that are not understood");
  }
  tensor.type = type;
  std::uint64_t size = widths.at(tensor.type);
  for (const json& extent : shape) {
    tensor.shape.push_back(whole(extent, where));
    if (__builtin_mul_overflow(size, tensor.shape.back(), &size)) {
      throw Malformed(where + ": is larger than any file");
    }
  }
  const std::uint64_t begin = whole(offsets[0], where);
  const std::uint64_t end = whole(offsets[1], where);
  if (begin > end || end > data.size() || end - begin != size) {
    throw Malformed(where + ": its bytes do not fit its shape, or the file is cut short");
  }
  tensor.bytes = data.subspan(begin, size);
  return {begin, end};
}

}  // namespace

const json& member(const json& object, const char* key) {
  if (!object.is_object() || !object.contains(key)) {
    throw Malformed(fmt::format("lacks \"{}\"", key));
  }
  return object.at(key);
}

const Tensor& TensorFile::at(const std::string& name, const char* type) const {
  const auto found = tensors.find(name);
  if (found == tensors.end()) throw Malformed("lacks the array " + name);
  if (found->second.type != type) {
    throw Malformed(fmt::format("{}: is {}, expected {}", name, found->second.type, type));
  }
  return found->second;
}

TensorFile read_tensors(const std::string& path) {
  TensorFile file;
  const std::span<const std::byte> bytes = map_file(path, file);
  std::uint64_t length = 0;
  if (bytes.size() < 8) throw Malformed(path + ": is not a safetensors file");
  std::memcpy(&length, bytes.data(), 8);
  if (length > bytes.size() - 8) throw Malformed(path + ": is cut short within its header");
  const auto* text = reinterpret_cast<const char*>(bytes.data()) + 8;
  const json header = parse(text, text + length, path + ": header");
  const std::span<const std::byte> data = bytes.subspan(8 + length);
  std::vector<std::pair<std::uint64_t, std::uint64_t>> places;
  try {
    for (const auto& [name, entry] : header.items()) {
      if (name == "__metadata__") continue;
      places.push_back(take(entry, path + ": " + name, data, file.tensors[name]));
    }
    const json& words = member(member(header, "__metadata__"), "fairway");
    if (!words.is_string()) throw Malformed("__metadata__.fairway is no string");
    const auto& record = words.get_ref<const std::string&>();
    file.record = parse(record.data(), record.data() + record.size(), path + ": fairway");
  } catch (const Malformed& error) {
    const std::string what = error.what();
    throw Malformed(what.starts_with(path) ? what : path + ": header: " + what);
  }
  std::sort(places.begin(), places.end());
  std::uint64_t filled = 0;
  for (const auto& [begin, end] : places) {
    if (begin != filled) throw Malformed(path + ": has arrays that overlap or leave holes");
    filled = end;
  }
  if (filled != data.size()) throw Malformed(path + ": goes on after its last array");
  return file;
}

std::string sha256(std::span<const std::byte> bytes) {
  unsigned char digest[EVP_MAX_MD_SIZE];
  unsigned int size = 0;
  if (EVP_Digest(bytes.data(), bytes.size(), digest, &size, EVP_sha256(), nullptr) != 1) {
    throw std::runtime_error("SHA-256 is not to be had");
  }
  std::string hex;
  for (unsigned int i = 0; i < size; ++i) hex += fmt::format("{:02x}", digest[i]);
  return hex;
}

}  // namespace fairway_check
