#include "fairway/base/strict_json.hpp"

#include <gtest/gtest.h>

#include "fairway/base/error.hpp"

namespace fairway {
namespace {

TEST(StrictJson, TakesWhatJsonAllows) {
  const auto value = parse_strict_json(R"( {"a": [1, {"a": 2}], "b": {"a": null}} )", "w");
  EXPECT_EQ(value["a"][1]["a"], 2);
  EXPECT_EQ(finite_number(value["a"][1], "a", "w"), 2.0);
}

TEST(StrictJson, RefusesWhatIsAmbiguousOrHostile) {
  for (const std::string text : {"", "{", "{}x", "{\"a\":1,\"a\":2}", "{\"b\":{\"a\":1,\"a\":2}}",
                                 "[1e400]", "[NaN]", "[\"\xc3\"]", "[01]", "[1,]"}) {
    EXPECT_THROW((void)parse_strict_json(text, "w"), InputError) << text;
  }
  EXPECT_THROW((void)parse_strict_json(std::string(40, '[') + std::string(40, ']'), "w"),
               InputError);
  EXPECT_NO_THROW((void)parse_strict_json(std::string(30, '[') + std::string(30, ']'), "w"));
}

TEST(StrictJson, CountsMembersAndDoesNotEndAtAZeroByte) {
  EXPECT_NO_THROW((void)parse_strict_json(R"([{"a":1,"b":2},{"a":1,"b":2}])", "w", 2));
  EXPECT_THROW((void)parse_strict_json(R"({"a":1,"b":{"a":1,"b":2,"c":3}})", "w", 2), InputError);
  EXPECT_THROW((void)parse_strict_json(std::string("{}\0", 3), "w"), InputError);
}

TEST(StrictJson, ErrorsSayWhere) {
  const auto value = parse_strict_json(R"({"a": "x", "b": 1})", "w");
  try {
    (void)finite_number(value, "a", "file: plan");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "file: plan.a: expected a finite number, found \"x\"");
  }
  EXPECT_THROW((void)text_member(value, "b", "w"), InputError);
  EXPECT_THROW((void)member(value, "c", "w"), InputError);
  EXPECT_THROW(require_known_keys(value, {"a"}, "w"), InputError);
  EXPECT_NO_THROW(require_known_keys(value, {"a", "b"}, "w"));
}

TEST(StrictJson, LongValuesAreCutInMessages) {
  EXPECT_LT(shown(nlohmann::json(std::string(100000, 'x'))).size(), 70U);
}

}  // namespace
}  // namespace fairway
