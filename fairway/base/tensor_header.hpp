// The header of a safetensors file (docs/formats.md, "Header"), read in place: no heap, no
// exceptions, only the standard library.
//
// One pass over the text by the grammar, from the first byte to the last. Properties that always
// hold: it refuses the headers that parse_safetensors and fairway-check refuse, and reads the same
// from those they accept (check/header_test.cpp feeds all three).
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>

namespace fairway {

/// The text between the quotes of a JSON string, with its escapes left as they are.
struct HeaderText {
  const char* begin = nullptr;
  const char* end = nullptr;

  bool is(const char* word) const noexcept {
    unsigned unit = 0;
    for (const char* at = begin; next(at, end, unit);) {
      if (unit != static_cast<unsigned char>(*word++) || unit == 0) return false;
    }
    return *word == '\0';
  }
  bool is(const HeaderText& other) const noexcept {
    const char* b = other.begin;
    unsigned unit = 0;
    unsigned its = 0;
    for (const char* a = begin; next(a, end, unit);) {
      if (!next(b, other.end, its) || its != unit) return false;
    }
    return b == other.end;
  }

  /// The next UTF-16 unit of a text whose escapes are complete; false at its end.
  static bool next(const char*& at, const char* end, unsigned& unit) noexcept {
    if (at == end) return false;
    unit = static_cast<unsigned char>(*at++);
    if (unit != '\\') return true;
    const char kind = *at++;
    if (kind == 'u') {
      hex(at, unit);
      at += 4;
      return true;
    }
    unit = static_cast<unsigned char>(kind == 'b'   ? '\b'
                                      : kind == 'f' ? '\f'
                                      : kind == 'n' ? '\n'
                                      : kind == 'r' ? '\r'
                                      : kind == 't' ? '\t'
                                                    : kind);
    return true;
  }
  /// Four digits at `at`.
  static bool hex(const char* at, unsigned& unit) noexcept {
    unit = 0;
    for (int i = 0; i < 4; ++i) {
      const char c = at[i];
      const int digit = c >= '0' && c <= '9'   ? c - '0'
                        : c >= 'a' && c <= 'f' ? c - 'a' + 10
                        : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                               : -1;
      if (digit < 0) return false;
      unit = 16 * unit + static_cast<unsigned>(digit);
    }
    return true;
  }
};

/// An array, as given in the header.
struct HeaderEntry {
  static constexpr int most_sizes = 8;
  HeaderText name;
  HeaderText dtype;
  std::uint64_t shape[most_sizes] = {};
  int sizes = 0;
  std::uint64_t begin = 0;  ///< of its bytes, after the header
  std::uint64_t end = 0;

  bool has_shape(std::uint64_t n) const noexcept { return sizes == 1 && shape[0] == n; }
  bool has_shape(std::uint64_t ny, std::uint64_t nx) const noexcept {
    return sizes == 2 && shape[0] == ny && shape[1] == nx;
  }
  bool has_shape(std::uint64_t modes, std::uint64_t ny, std::uint64_t nx) const noexcept {
    return sizes == 3 && shape[0] == modes && shape[1] == ny && shape[2] == nx;
  }
};

class TensorHeader {
 public:
  static constexpr std::uint64_t most_bytes =
      100'000'000;                         ///< the limit of the format's own reader
  static constexpr int most_members = 32;  ///< of any object

  /// `text`: the header without its length, which must outlive this object; `data_size`: the bytes
  /// after it. False when it is not a header, or its arrays do not fill those bytes.
  bool read(const char* text, std::size_t size, std::uint64_t data_size) noexcept {
    at_ = text;
    end_ = text + size;
    count_ = 0;
    has_record_ = false;
    if (size == 0 || size > most_bytes || *text != '{') return false;
    const bool taken = take_object([this](const HeaderText& name) {
      return name.is("__metadata__") ? take_metadata() : take_entry(name);
    });
    skip_blanks();
    return taken && at_ == end_ && fill(data_size);
  }

  int size() const noexcept { return count_; }
  const HeaderEntry& operator[](int i) const noexcept { return entry_[i]; }
  const HeaderEntry* find(const char* name) const noexcept {
    for (int i = 0; i < count_; ++i) {
      if (entry_[i].name.is(name)) return entry_ + i;
    }
    return nullptr;
  }
  /// Whether __metadata__ has the string "fairway".
  bool has_record() const noexcept { return has_record_; }

 private:
  void skip_blanks() noexcept {
    while (at_ != end_ && (*at_ == ' ' || *at_ == '\t' || *at_ == '\n' || *at_ == '\r')) ++at_;
  }
  bool take(char c) noexcept {
    skip_blanks();
    if (at_ == end_ || *at_ != c) return false;
    ++at_;
    return true;
  }

  /// A string of printable ASCII.
  bool take_text(HeaderText& text) noexcept {
    if (!take('"')) return false;
    text.begin = at_;
    while (at_ != end_ && *at_ != '"') {
      if (*at_ < 0x20 || *at_ > 0x7e) return false;  // a signed char, or beyond 0x7e
      if (*at_++ == '\\' && !take_escape()) return false;
    }
    text.end = at_;
    return take('"');
  }
  bool take_escape() noexcept {
    if (at_ == end_) return false;
    const char kind = *at_++;
    if (kind != 'u') {
      for (const char* known = "\"\\/bfnrt"; *known != '\0'; ++known) {
        if (kind == *known) return true;
      }
      return false;
    }
    unsigned unit = 0;
    if (!take_unit(unit) || (unit >= 0xdc00 && unit <= 0xdfff)) return false;
    if (unit < 0xd800 || unit > 0xdbff) return true;
    if (end_ - at_ < 2 || at_[0] != '\\' || at_[1] != 'u') return false;  // half of a pair
    at_ += 2;
    return take_unit(unit) && unit >= 0xdc00 && unit <= 0xdfff;
  }
  bool take_unit(unsigned& unit) noexcept {
    if (end_ - at_ < 4 || !HeaderText::hex(at_, unit)) return false;
    at_ += 4;
    return true;
  }

  /// A whole number as JSON writes it: only digits, without leading zeros.
  bool take_number(std::uint64_t& value) noexcept {
    skip_blanks();
    const char* const first = at_;
    value = 0;
    for (; at_ != end_ && *at_ >= '0' && *at_ <= '9'; ++at_) {
      const auto digit = static_cast<std::uint64_t>(*at_ - '0');
      if (value > (UINT64_MAX - digit) / 10) return false;
      value = 10 * value + digit;
    }
    return at_ != first && (*first != '0' || at_ == first + 1);
  }

  /// Members, none of them twice; `take_value(name)` takes what follows the colon.
  template <typename TakeValue>
  bool take_object(const TakeValue& take_value) noexcept {
    if (!take('{')) return false;
    if (take('}')) return true;
    HeaderText names[most_members];
    for (int n = 0; n < most_members; ++n) {
      if (!take_text(names[n]) || !take(':')) return false;
      for (int i = 0; i < n; ++i) {
        if (names[i].is(names[n])) return false;
      }
      if (!take_value(names[n])) return false;
      if (take('}')) return true;
      if (!take(',')) return false;
    }
    return false;
  }
  bool take_metadata() noexcept {
    return take_object([this](const HeaderText& key) {
      has_record_ = has_record_ || key.is("fairway");
      HeaderText value;
      return take_text(value);
    });
  }
  bool take_entry(const HeaderText& name) noexcept {
    HeaderEntry entry;
    entry.name = name;
    int members = 0;
    const bool taken = take_object([&](const HeaderText& key) {
      ++members;
      if (key.is("dtype")) return take_text(entry.dtype);
      if (key.is("shape")) return take_shape(entry);
      return key.is("data_offsets") && take('[') && take_number(entry.begin) && take(',') &&
             take_number(entry.end) && take(']');
    });
    if (!taken || members != 3) return false;
    std::uint64_t bytes = width_of(entry.dtype);
    for (int i = 0; i < entry.sizes; ++i) {
      if (__builtin_mul_overflow(bytes, entry.shape[i], &bytes)) return false;
    }
    if (width_of(entry.dtype) == 0 || entry.begin > entry.end || entry.end - entry.begin != bytes) {
      return false;
    }
    entry_[count_++] = entry;  // at most as many as there are members
    return true;
  }
  bool take_shape(HeaderEntry& entry) noexcept {
    if (!take('[')) return false;
    if (take(']')) return true;
    while (entry.sizes < HeaderEntry::most_sizes) {
      if (!take_number(entry.shape[entry.sizes++])) return false;
      if (take(']')) return true;
      if (!take(',')) return false;
    }
    return false;
  }
  static std::uint64_t width_of(const HeaderText& dtype) noexcept {
    for (const char* eight : {"F64", "I64", "U64"}) {
      if (dtype.is(eight)) return 8;
    }
    for (const char* four : {"F32", "I32", "U32"}) {
      if (dtype.is(four)) return 4;
    }
    for (const char* two : {"I16", "U16"}) {
      if (dtype.is(two)) return 2;
    }
    for (const char* one : {"I8", "U8", "BOOL"}) {
      if (dtype.is(one)) return 1;
    }
    return 0;
  }

  /// Whether the arrays, in order of their offsets, follow each other from 0 to `data_size`.
  bool fill(std::uint64_t data_size) const noexcept {
    bool used[most_members] = {};
    std::uint64_t filled = 0;
    for (int n = 0; n < count_; ++n) {
      int next = -1;  // of those left, the one that starts at `filled`; an empty one goes first
      for (int i = 0; i < count_; ++i) {
        if (used[i] || entry_[i].begin != filled) continue;
        if (next < 0 || entry_[i].end < entry_[next].end) next = i;
      }
      if (next < 0) return false;
      used[next] = true;
      filled = entry_[next].end;
    }
    return filled == data_size;
  }

  const char* at_ = nullptr;
  const char* end_ = nullptr;
  HeaderEntry entry_[most_members];
  int count_ = 0;
  bool has_record_ = false;
};

}  // namespace fairway
