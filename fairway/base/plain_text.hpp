// The single entry point for text: what editors and other systems add to it is removed here, so no
// reader needs to know about it.
#pragma once

#include <string>
#include <string_view>

namespace fairway {

/// `bytes` without a UTF-8 byte order mark, every line ending (CR, LF, CRLF) as LF. Lines keep
/// their numbers. Throws InputError{where, ...} for UTF-16 and UTF-32, detected by their marks.
[[nodiscard]] std::string plain_text(std::string_view bytes, const std::string& where);

/// A field of a CSV file without surrounding blanks and quotes.
[[nodiscard]] std::string_view csv_field(std::string_view field);

}  // namespace fairway
