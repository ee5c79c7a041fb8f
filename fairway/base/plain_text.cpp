#include "fairway/base/plain_text.hpp"

#include <utility>

#include "fairway/base/error.hpp"

namespace fairway {
namespace {

using namespace std::string_view_literals;

void require_utf8(std::string_view bytes, const std::string& where) {
  // The UTF-32 marks first: the little-endian one starts like that of UTF-16.
  for (const auto& [mark, name] : {std::pair("\xff\xfe\0\0"sv, "UTF-32"),
                                   {"\0\0\xfe\xff"sv, "UTF-32"},
                                   {"\xff\xfe"sv, "UTF-16"},
                                   {"\xfe\xff"sv, "UTF-16"}}) {
    if (bytes.starts_with(mark)) {
      throw InputError(where, std::string("is text in ") + name + ", expected UTF-8");
    }
  }
}

std::string_view without_blanks(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

}  // namespace

std::string plain_text(std::string_view bytes, const std::string& where) {
  require_utf8(bytes, where);
  if (bytes.starts_with("\xef\xbb\xbf")) bytes.remove_prefix(3);
  if (bytes.find('\r') == std::string_view::npos) return std::string(bytes);
  std::string text;
  text.reserve(bytes.size());
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const bool pair = bytes[i] == '\r' && i + 1 < bytes.size() && bytes[i + 1] == '\n';
    if (!pair) text += bytes[i] == '\r' ? '\n' : bytes[i];
  }
  return text;
}

std::string_view csv_field(std::string_view field) {
  field = without_blanks(field);
  for (const char quote : {'"', '\''}) {
    if (field.size() >= 2 && field.front() == quote && field.back() == quote) {
      return without_blanks(field.substr(1, field.size() - 2));
    }
  }
  return field;
}

}  // namespace fairway
