#include "fairway/app/argument_checks.hpp"

#include <cmath>
#include <cstdlib>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "fairway/base/error.hpp"
#include "fairway/base/heading.hpp"
#include "fairway/map/source_text.hpp"
#include "fairway/simulate/state_files.hpp"

namespace fairway {
namespace {

std::optional<double> number_of(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0' || !std::isfinite(value)) return std::nullopt;
  return value;
}

CLI::Validator number_with(const std::string& expected, bool (*holds)(double, double), double low) {
  return {[=](const std::string& text) {
            const auto value = number_of(text);
            if (value && holds(*value, low)) return std::string();
            return fmt::format("is {}, expected {}", text, expected);
          },
          ""};
}

/// A reader's error message as CLI11 expects it: empty when the text is valid.
template <typename Read>
std::string complaint_of(const std::string& text, const Read& read) {
  try {
    static_cast<void>(read(text));
    return {};
  } catch (const InputError& error) {
    return fmt::format("{}: {}", text, error.what());
  }
}

}  // namespace

CLI::Validator finite_above(double low) {
  return number_with(
      fmt::format("a finite number above {}", low), [](double v, double l) { return v > l; }, low);
}

CLI::Validator finite_from(double low) {
  return number_with(
      fmt::format("a finite number of at least {}", low), [](double v, double l) { return v >= l; },
      low);
}

CLI::Validator finite_number() {
  return number_with(
      "a finite number", [](double, double) { return true; }, 0.0);
}

State state_of_argument(const std::string& text) { return state_of_text(text, ""); }

CLI::Validator readable(std::function<void(const std::string&)> read) {
  return {[read = std::move(read)](const std::string& text) -> std::string {
            try {
              read(text);
              return {};
            } catch (const InputError& error) {
              return reason_of(error);
            }
          },
          ""};
}

CLI::Validator state_argument() {
  return {[](const std::string& text) { return complaint_of(text, state_of_argument); }, ""};
}

EarthState earth_state_of_argument(const std::string& text) {
  return earth_state_of_text(text, "");
}

CLI::Validator earth_state_argument() {
  return {[](const std::string& text) { return complaint_of(text, earth_state_of_argument); }, ""};
}

double angle_of_argument_rad(const std::string& text) {
  const bool degrees = text.ends_with("deg");
  const auto value = number_of(degrees ? text.substr(0, text.size() - 3) : text);
  const double angle_rad = value.value_or(-1.0) * (degrees ? pi / 180.0 : 1.0);
  if (!(angle_rad >= 0.0 && angle_rad <= pi)) {
    throw InputError("", "expected an angle from 0 to pi, or to 180deg");
  }
  return angle_rad;
}

CLI::Validator angle_argument() {
  return {[](const std::string& text) { return complaint_of(text, angle_of_argument_rad); }, ""};
}

CLI::Validator picture_argument() {
  return {[](const std::string& file) -> std::string {
            if (file.ends_with(".svg") || file.ends_with(".png")) return {};
            return file + ": expected a file name that ends in .svg or .png";
          },
          ""};
}

}  // namespace fairway
