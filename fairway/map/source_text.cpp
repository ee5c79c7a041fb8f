#include "fairway/map/source_text.hpp"

#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <limits>
#include <memory>
#include <span>
#include <system_error>

#include <fmt/format.h>

#include "fairway/base/digest.hpp"
#include "fairway/base/plain_text.hpp"

namespace fairway {

void require_regular_file(const std::filesystem::path& file) {
  const std::string name = file.string();
  if (name.empty()) throw InputError("map file", "the name is empty, expected a file");
  if (name.find('\0') != std::string::npos)
    throw InputError(shown(name), "the name contains a NUL character");
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (status.type() == std::filesystem::file_type::not_found)
    throw InputError(name, name.find("://") != std::string::npos || name.starts_with("/vsi")
                               ? "is not a local file; download it first, nothing is fetched"
                               : "no such file");
  if (error) throw InputError(name, "cannot be opened: " + error.message());
  if (status.type() == std::filesystem::file_type::directory)
    throw InputError(name, "is a folder, expected a file");
  if (status.type() != std::filesystem::file_type::regular)
    throw InputError(name, "is not a regular file");
}

SourceText read_bytes(const std::filesystem::path& file, std::uint64_t max_bytes) {
  require_regular_file(file);
  const std::string name = file.string();
  std::error_code error;
  const std::uint64_t size = std::filesystem::file_size(file, error);
  if (error) throw InputError(name, "cannot be opened: " + error.message());
  if (size > max_bytes)
    throw InputError(name, fmt::format("has {} bytes, expected at most {}", size, max_bytes));
  SourceText source{file, {}, {}};
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream(std::fopen(name.c_str(), "rb"),
                                                               &std::fclose);
  if (!stream) throw InputError(name, std::string("cannot be opened: ") + std::strerror(errno));
  source.text.resize(static_cast<std::size_t>(size));
  const std::size_t got = std::fread(source.text.data(), 1, source.text.size(), stream.get());
  if (std::ferror(stream.get())) throw InputError(name, "cannot be read to its end");
  source.text.resize(got);
  source.input = {name, sha256_hex(std::as_bytes(std::span(source.text.data(), got)))};
  return source;
}

SourceText read_source(const std::filesystem::path& file, std::uint64_t max_bytes) {
  SourceText source = read_bytes(file, max_bytes);
  source.text = plain_text(source.text, file.string());
  return source;
}

std::string at_line(const std::filesystem::path& file, std::size_t line) {
  return fmt::format("{}:{}", file.string(), line);
}

std::string reason_of(const InputError& error) {
  const std::string text = error.what();
  return error.where().empty() ? text : text.substr(error.where().size() + 2);
}

std::vector<Line> lines_of(std::string_view text) {
  std::vector<Line> lines;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    lines.push_back({lines.size() + 1, text.substr(begin, end - begin)});
    begin = end + 1;
  }
  return lines;
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\r\n\f\v";
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> pieces;
  if (separator == ' ') {
    constexpr std::string_view blanks = " \t";
    for (std::size_t at = text.find_first_not_of(blanks); at != std::string_view::npos;) {
      const std::size_t end = std::min(text.find_first_of(blanks, at), text.size());
      pieces.push_back(text.substr(at, end - at));
      at = text.find_first_not_of(blanks, end);
    }
    return pieces;
  }
  for (std::size_t at = 0;;) {
    const std::size_t end = text.find(separator, at);
    pieces.push_back(trimmed(text.substr(at, end == text.npos ? end : end - at)));
    if (end == text.npos) return pieces;
    at = end + 1;
  }
}

std::optional<double> parse_number(std::string_view text) {
  std::string_view digits = text;
  if (digits.starts_with('+')) digits.remove_prefix(1);
  if (digits.starts_with('+') || (digits.size() < text.size() && digits.starts_with('-')))
    return std::nullopt;
  double value = 0.0;
  const auto [end, problem] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (digits.empty() || end != digits.data() + digits.size()) return std::nullopt;
  if (problem == std::errc::result_out_of_range) {
    // Too large or too small for a double: only the large ones matter.
    const bool tiny = digits.find("e-") != digits.npos || digits.find("E-") != digits.npos ||
                      digits.starts_with("0.") || digits.starts_with("-0.");
    return tiny ? 0.0 : std::numeric_limits<double>::infinity();
  }
  if (problem != std::errc()) return std::nullopt;
  return value;
}

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return result;
}

std::string shown(std::string_view text) {
  std::string result = "\"";
  for (const char c : text.substr(0, 40)) result += (c >= ' ' && c <= '~') ? c : '?';
  return result + (text.size() > 40 ? "...\"" : "\"");
}

}  // namespace fairway
