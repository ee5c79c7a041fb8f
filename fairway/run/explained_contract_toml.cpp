#include "fairway/run/explained_contract_toml.hpp"

#include <string_view>
#include <utility>

#include "fairway/run/contract_file.hpp"

namespace fairway {
namespace {

void add_comment(std::string& text, std::string_view words) {
  while (!words.empty()) {
    const auto end = words.find('\n');
    text += "# " + std::string(words.substr(0, end)) + "\n";
    words.remove_prefix(end == std::string_view::npos ? words.size() : end + 1);
  }
}

std::string_view reason_of(const ExplainedContract& e, std::string_view line) {
  const std::string_view key = line.substr(0, line.find(' '));
  const std::pair<std::string_view, std::string_view> reasons[] = {
      {"command_error_m", e.command_error},
      {"heading_error_rad", e.heading_error},
      {"turn_radius_m", e.turn_radius},
      {"speed_mps", e.speed},
      {"side_uncertain_rad", e.side_uncertain}};
  for (const auto& [name, reason] : reasons) {
    if (key == name) return reason;
  }
  return {};
}

}  // namespace

std::string explained_contract_toml(const ExplainedContract& explained) {
  std::string text;
  for (const std::string& line : explained.about) add_comment(text, line);
  const std::string block = contract_toml(explained.contract);
  for (std::string_view rest = block; !rest.empty();) {
    const std::string_view line = rest.substr(0, rest.find('\n'));
    add_comment(text, reason_of(explained, line));
    text += std::string(line) + "\n";
    rest.remove_prefix(line.size() + 1);
  }
  return text;
}

}  // namespace fairway
