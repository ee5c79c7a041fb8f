#include "fairway/report/ticks.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "fairway/base/error.hpp"

namespace fairway {

double round_length_below(double length) {
  require(length > 0.0 && std::isfinite(length), "a length is positive and finite");
  const double power = std::pow(10.0, std::floor(std::log10(length)));
  for (const double digit : {5.0, 2.0, 1.0})
    if (digit * power <= length) return digit * power;
  return 0.5 * power;  // log10 rounded up across a power of ten
}

Ticks ticks_between(double low, double high, int wanted) {
  require(std::isfinite(low) && std::isfinite(high) && low <= high && wanted >= 1,
          "ticks need a finite range");
  Ticks ticks;
  const double range = high - low;
  // Below a billionth of the numbers' size a step would be lost in rounding.
  if (range <= 1e-9 * std::max(std::abs(low), std::abs(high))) {
    ticks.values.push_back(low);
    return ticks;
  }
  ticks.step = round_length_below(range / wanted);
  const double slack = 1e-9 * range;
  for (double k = std::ceil((low - slack) / ticks.step); k * ticks.step <= high + slack; k += 1.0)
    ticks.values.push_back(std::clamp(k * ticks.step, low, high));
  return ticks;
}

std::string tick_label(double value, double step) {
  const bool digits_would_run_on = step >= 1e7 || step <= 1e-7 || std::abs(value) >= 1e12;
  if (digits_would_run_on) return fmt::format("{:.4g}", value);
  const int decimals = std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-9)), 0, 9);
  std::string label = fmt::format("{:.{}f}", value, decimals);
  if (label.find_first_not_of("-0.") == std::string::npos && label.front() == '-')
    label.erase(0, 1);
  return label;
}

}  // namespace fairway
