#include "fairway/base/plain_text.hpp"

#include <string>
#include <string_view>

#include <gtest/gtest.h>

#include "fairway/base/error.hpp"

namespace fairway {
namespace {

using namespace std::string_view_literals;

TEST(PlainText, AByteOrderMarkIsRemovedOnce) {
  EXPECT_EQ(plain_text("\xef\xbb\xbf"
                       "a",
                       "f"),
            "a");
  EXPECT_EQ(plain_text("\xef\xbb\xbf", "f"), "");
  EXPECT_EQ(plain_text("\xef\xbb\xbf\xef\xbb\xbf"
                       "a",
                       "f"),
            "\xef\xbb\xbf"
            "a");
  EXPECT_EQ(plain_text("a\xef\xbb\xbf", "f"), "a\xef\xbb\xbf");
}

TEST(PlainText, EveryLineEndBecomesOneLineFeed) {
  for (const char* text : {"a\nb\n\nc", "a\r\nb\r\n\r\nc", "a\rb\r\rc", "a\rb\n\r\nc"})
    EXPECT_EQ(plain_text(text, "f"), "a\nb\n\nc");
  EXPECT_EQ(plain_text("a\r", "f"), "a\n");
  EXPECT_EQ(plain_text("a\n\r", "f"), "a\n\n") << "two line endings: a line feed, then a return";
  EXPECT_EQ(plain_text("", "f"), "");
}

TEST(PlainText, TextOfWiderUnitsIsRefusedByName) {
  const auto error_of = [](std::string_view bytes) -> std::string {
    try {
      return plain_text(bytes, "f.csv");
    } catch (const InputError& error) {
      return error.what();
    }
  };
  EXPECT_EQ(error_of("\xff\xfe"
                     "a\0"sv),
            "f.csv: is text in UTF-16, expected UTF-8");
  EXPECT_EQ(error_of("\xfe\xff\0a"sv), "f.csv: is text in UTF-16, expected UTF-8");
  EXPECT_EQ(error_of("\xff\xfe\0\0a\0\0\0"sv), "f.csv: is text in UTF-32, expected UTF-8");
}

TEST(PlainText, FieldsLoseBlanksAndOnePairOfQuotes) {
  EXPECT_EQ(csv_field(" 1.5\t"), "1.5");
  EXPECT_EQ(csv_field("\"1.5\""), "1.5");
  EXPECT_EQ(csv_field(" '1.5 ' "), "1.5");
  EXPECT_EQ(csv_field("\"1.5"), "\"1.5");
  EXPECT_EQ(csv_field("\"\""), "");
  EXPECT_EQ(csv_field("\""), "\"");
  EXPECT_EQ(csv_field(""), "");
}

}  // namespace
}  // namespace fairway
