#include "fairway/base/strict_json.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_set>
#include <vector>

#include "fairway/base/error.hpp"

namespace fairway {

using nlohmann::json;

namespace {

/// Checks a text as it is parsed, without storing it: nlohmann's own parser, with a callback that
/// could refuse, takes time quadratic in the members of an object.
class Looker : public nlohmann::json_sax<json> {
 public:
  Looker(std::string_view text, const std::string& where, const JsonLimits& limits)
      : text_(text), where_(where), limits_(limits) {}

  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(number_integer_t) override { return true; }
  bool number_unsigned(number_unsigned_t) override { return true; }
  bool number_float(number_float_t, const string_t&) override { return true; }
  bool string(string_t&) override { return true; }
  bool binary(binary_t&) override { return true; }
  bool start_object(std::size_t) override {
    open();
    keys_.emplace_back();
    return true;
  }
  bool key(string_t& name) override {
    if (!keys_.back().insert(name).second) {
      throw InputError(where_, "has the key " + shown(json(name)) + " twice in one object");
    }
    if (keys_.back().size() > limits_.most_members) {
      throw InputError(where_, "has an object of more than " +
                                   std::to_string(limits_.most_members) + " members");
    }
    return true;
  }
  bool end_object() override {
    keys_.pop_back();
    --depth_;
    return true;
  }
  bool start_array(std::size_t) override {
    open();
    return true;
  }
  bool end_array() override {
    --depth_;
    return true;
  }
  bool parse_error(std::size_t byte, const std::string&, const json::exception& error) override {
    throw InputError(place_of(byte), "is not JSON: " + reason_of(error));
  }

 private:
  void open() {
    if (++depth_ > limits_.deepest) {
      throw InputError(where_,
                       "nests more than " + std::to_string(limits_.deepest) + " levels of JSON");
    }
  }
  std::string place_of(std::size_t byte) const {
    if (text_.find('\n') == std::string_view::npos) return where_;
    const std::string_view before = text_.substr(0, byte);
    return where_ + ":" + std::to_string(1 + std::count(before.begin(), before.end(), '\n'));
  }
  /// Without the parser's name for the kind of error.
  static std::string reason_of(const json::exception& error) {
    const std::string_view what = error.what();
    const std::size_t from = what.find("syntax error");
    return std::string(from == std::string_view::npos ? what : what.substr(from));
  }

  std::string_view text_;
  const std::string& where_;
  const JsonLimits& limits_;
  int depth_ = 0;
  std::vector<std::unordered_set<std::string>> keys_;  // of the objects that are open
};

}  // namespace

json parse_strict_json(std::string_view text, const std::string& where, const JsonLimits& limits) {
  // nlohmann takes a zero byte for the end of the text.
  if (text.find('\0') != std::string_view::npos) throw InputError(where, "holds a zero byte");
  Looker looker(text, where, limits);
  try {
    json::sax_parse(text.begin(), text.end(), &looker);
    return json::parse(text.begin(), text.end());
  } catch (const json::exception& error) {  // a number that does not fit a double
    throw InputError(where, std::string("is not JSON: ") + error.what());
  }
}

std::string shown(const json& value) {
  std::string text = value.dump(-1, ' ', true);
  constexpr std::size_t longest = 60;
  if (text.size() > longest) text = text.substr(0, longest) + "...";
  return text;
}

const json& member(const json& object, const char* key, const std::string& where) {
  if (!object.is_object()) throw InputError(where, "expected a JSON object");
  const auto found = object.find(key);
  if (found == object.end()) {
    throw InputError(where, std::string("lacks the key \"") + key + "\"");
  }
  return *found;
}

double finite_number(const json& object, const char* key, const std::string& where) {
  const json& value = member(object, key, where);
  if (!value.is_number() || !std::isfinite(value.get<double>())) {
    throw InputError(where + "." + key, "expected a finite number, found " + shown(value));
  }
  return value.get<double>();
}

std::string text_member(const json& object, const char* key, const std::string& where) {
  const json& value = member(object, key, where);
  if (!value.is_string()) {
    throw InputError(where + "." + key, "expected a string, found " + shown(value));
  }
  return value.get<std::string>();
}

void require_known_keys(const json& object, std::initializer_list<std::string_view> known,
                        const std::string& where) {
  if (!object.is_object()) throw InputError(where, "expected a JSON object");
  for (const auto& [key, value] : object.items()) {
    if (std::find(known.begin(), known.end(), key) == known.end()) {
      throw InputError(where, "has the unknown key \"" + key + "\"");
    }
  }
}

}  // namespace fairway
