#include "fairway/base/strict_json.hpp"

#include <string>

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
  EXPECT_NO_THROW(
      (void)parse_strict_json(R"([{"a":1,"b":2},{"a":1,"b":2}])", "w", {.most_members = 2}));
  EXPECT_THROW(
      (void)parse_strict_json(R"({"a":1,"b":{"a":1,"b":2,"c":3}})", "w", {.most_members = 2}),
      InputError);
  EXPECT_THROW((void)parse_strict_json(std::string("{}\0", 3), "w"), InputError);
}

std::string refusal_of(const std::string& text, const JsonLimits& limits = {}) {
  try {
    (void)parse_strict_json(text, "w", limits);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST(StrictJson, BrokenSyntaxIsToldWithItsLineWhereThereAreLines) {
  EXPECT_TRUE(refusal_of("{\n\"a\": 1,\n oops}").starts_with("w:3: is not JSON: syntax error"));
  EXPECT_TRUE(refusal_of("{\n").starts_with("w:2: is not JSON: syntax error"));
  EXPECT_TRUE(refusal_of("{oops}").starts_with("w: is not JSON: syntax error"));
  EXPECT_EQ(refusal_of("{\"a\\n\":1,\"a\\n\":2}"), "w: has the key \"a\\n\" twice in one object");
}

TEST(StrictJson, TheDepthThatIsAllowedIsTheCallersChoice) {
  const auto nested = [](std::size_t n) { return std::string(n, '[') + std::string(n, ']'); };
  EXPECT_EQ(refusal_of(nested(3), {.deepest = 3}), "");
  EXPECT_EQ(refusal_of(nested(4), {.deepest = 3}), "w: nests more than 3 levels of JSON");
}

// What looks each member up among those before it would take minutes here, beyond any test's time.
TEST(StrictJson, ManyMembersThatAreObjectsAreReadInOnePass) {
  constexpr int members = 200'000;
  std::string text = "{";
  for (int i = 0; i < members; ++i) {
    text += (i > 0 ? "," : "") + ('"' + std::to_string(i)) + "\":{\"a\":{}}";
  }
  EXPECT_EQ(parse_strict_json(text + "}", "w").size(), std::size_t{members});
  EXPECT_EQ(refusal_of(text + ",\"7\":0}"), "w: has the key \"7\" twice in one object");
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
