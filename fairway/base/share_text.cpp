#include "fairway/base/share_text.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace fairway {
namespace {

constexpr double two_sided_95 = 1.959963984540054;  // 97.5 % of the normal distribution

std::string percent_of(double percent, int decimals) {
  return fmt::format("{:.{}f} %", percent, decimals);
}

}  // namespace

std::string grouped(std::size_t n) {
  std::string text = std::to_string(n);
  for (std::size_t at = text.size(); at > 3;) text.insert(at -= 3, 1, ',');
  return text;
}

std::string plural(std::size_t n, const char* noun) {
  return grouped(n) + " " + noun + (n == 1 ? "" : "s");
}

std::string percent_text(double share, int decimals) {
  if (share <= 0.0) return "0 %";
  if (share >= 1.0) return "100 %";
  const double units = std::pow(10.0, decimals);
  const double percent = 100.0 * share;
  if (std::round(percent * units) <= 0.0) return "< " + percent_of(1.0 / units, decimals);
  if (std::round(percent * units) >= 100.0 * units) {
    return "> " + percent_of(100.0 - 1.0 / units, decimals);
  }
  return percent_of(percent, decimals);
}

std::string percent_text(std::size_t part, std::size_t whole) {
  return percent_text(whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole));
}

int decimals_of_sample(std::size_t samples) {
  if (samples == 0) return 0;
  const double worst_percent =
      100.0 * two_sided_95 * std::sqrt(0.25 / static_cast<double>(samples));
  return std::clamp(static_cast<int>(std::floor(-std::log10(worst_percent))), 0, 1);
}

std::array<double, 2> wilson_interval(std::size_t hits, std::size_t count) {
  if (count == 0) return {0.0, 1.0};
  constexpr double z = two_sided_95;
  const auto n = static_cast<double>(count);
  const double p = static_cast<double>(hits) / n;
  const double middle = (p + z * z / (2.0 * n)) / (1.0 + z * z / n);
  const double half = z / (1.0 + z * z / n) * std::sqrt(p * (1.0 - p) / n + z * z / (4.0 * n * n));
  return {hits == 0 ? 0.0 : middle - half, hits == count ? 1.0 : middle + half};
}

std::string bound_text(double share, int decimals, int towards) {
  const double ten = std::pow(10.0, decimals);
  const double units = 100.0 * share * ten;
  const double rounded = towards < 0 ? std::floor(units + 1e-9) : std::ceil(units - 1e-9);
  if (share > 0.0 && share < 1.0 && (rounded <= 0.0 || rounded >= 100.0 * ten)) {
    return percent_text(share, decimals);
  }
  return percent_text(rounded / (100.0 * ten), decimals);
}

SampledShare sampled_share(std::size_t hits, std::size_t count) {
  const auto [low, high] = wilson_interval(hits, count);
  const double half_percent = 50.0 * (high - low);
  const int decimals = std::clamp(static_cast<int>(std::ceil(-std::log10(half_percent))), 0, 6);
  const double share = count == 0 ? 0.0 : static_cast<double>(hits) / static_cast<double>(count);
  return {percent_text(share, decimals),
          fmt::format("{} to {}", bound_text(low, decimals, -1), bound_text(high, decimals, +1))};
}

}  // namespace fairway
