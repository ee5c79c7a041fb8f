// The one way in for text: what editors and other systems put around it is taken off here, so that
// no reader need know of it.
#pragma once

#include <string>
#include <string_view>

namespace fairway {

/// `bytes` without a UTF-8 byte order mark, every line end (CR, LF, CRLF) as LF. Lines keep their
/// numbers. Throws InputError{where, ...} for UTF-16 and UTF-32, told by their marks.
[[nodiscard]] std::string plain_text(std::string_view bytes, const std::string& where);

/// A field of a CSV file without the blanks around it and the pair of quotes around that.
[[nodiscard]] std::string_view csv_field(std::string_view field);

}  // namespace fairway
