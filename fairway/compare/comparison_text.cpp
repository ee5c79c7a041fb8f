#include "fairway/compare/comparison_text.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "fairway/base/share_text.hpp"
#include "fairway/compare/state_verdicts.hpp"

namespace fairway {
namespace {

constexpr double two_sided_95 = 1.959963984540054;

int decimals_of(const ComparedMeasure& measure) {
  if (measure.unit == "%") return 1;
  double largest = 0.0;
  for (const SampledValue& e : measure.value) {
    if (std::isfinite(e.value)) largest = std::max(largest, std::abs(e.value));
  }
  return largest >= 100.0 ? 0 : largest >= 10.0 ? 1 : 2;
}

/// A 95 % error, rounded up.
std::string error_text(double standard_error, double scale, int decimals) {
  const double units = std::pow(10.0, decimals);
  const double half = std::ceil(two_sided_95 * standard_error * scale * units) / units;
  return fmt::format("{:.{}f}", half, decimals);
}

std::string signed_text(double value, int decimals) {
  if (std::abs(value) * std::pow(10.0, decimals) < 0.5) return "0";
  return fmt::format("{}{:.{}f}", value < 0.0 ? "−" : "+", std::abs(value), decimals);
}

/// Display columns of UTF-8 text.
std::size_t width_of(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xc0) != 0x80;
  }));
}

std::string padded(const std::string& text, std::size_t width, bool right = true) {
  const std::string room(width > width_of(text) ? width - width_of(text) : 0, ' ');
  return right ? room + text : text + room;
}

std::string csv_number(double value) {
  return std::isfinite(value) ? fmt::format("{}", value) : "";
}

std::string csv_text(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

}  // namespace

std::vector<std::string> difference_lines(const Comparison& c) {
  const auto share = [](const SampledValue& e) { return percent_text(e.value); };
  std::vector<std::string> lines;
  for (const PairDifference& d : c.pairs) {
    const bool proved = d.of == Knowledge::contract || c.is_proved;
    const auto line = [&](std::size_t winner, std::size_t loser, const SampledValue& only,
                          const SampledValue& failing) {
      lines.push_back(fmt::format("{} of all states are {} under {} but not under {}{}.",
                                  share(only), c.known_to(d.of), c.names[winner], c.names[loser],
                                  proved && only.value > 0.0
                                      ? fmt::format("; {} are proved to fail there", share(failing))
                                      : ""));
    };
    line(d.first, d.second, d.only_first, d.only_first_failing);
    line(d.second, d.first, d.only_second, d.only_second_failing);
  }
  return lines;
}

double error_of_shares(const Comparison& c) {
  double largest = 0.0;
  for (const ComparedMeasure& m : c.table) {
    if (m.unit != "%" || m.group != c.table.front().group) continue;
    for (const SampledValue& e : m.value) {
      if (std::isfinite(e.value)) largest = std::max(largest, two_sided_95 * e.standard_error);
    }
  }
  return largest;
}

MeasureText measure_text(const ComparedMeasure& measure, std::size_t plan) {
  const SampledValue& e = measure.value[plan];
  MeasureText text;
  const bool is_share = measure.unit == "%";
  const int decimals = decimals_of(measure);
  if (!std::isfinite(e.value)) {
    text.value = "none";
    return text;
  }
  text.value =
      is_share ? percent_text(e.value, decimals) : fmt::format("{:.{}f}", e.value, decimals);
  const SampledValue& difference = measure.difference_from_first[plan];
  if (plan == 0 || !std::isfinite(difference.value)) return text;
  const double scale = is_share ? 100.0 : 1.0;
  const double by = difference.value * scale;
  text.difference = signed_text(by, decimals);
  if (std::isfinite(difference.standard_error)) {
    if (difference.value != 0.0 || difference.standard_error > 0.0) {
      text.difference += " ± " + error_text(difference.standard_error, scale, decimals);
    }
    text.differs = std::abs(difference.value) > two_sided_95 * difference.standard_error;
  }
  return text;
}

std::string comparison_text(const Comparison& c) {
  const std::size_t plans = c.names.size();
  std::vector<std::vector<std::string>> rows;  // [line][0: name, then plans]; one entry: a group
  rows.push_back({""});
  for (const std::string& name : c.names) rows.back().push_back(name);
  std::string group;
  for (const ComparedMeasure& m : c.table) {
    if (m.group != group) rows.push_back({group = m.group});
    std::vector<std::string> row{"  " + m.name +
                                 (m.unit.empty() || m.unit == "%" ? "" : ", " + m.unit)};
    for (std::size_t k = 0; k < plans; ++k) {
      const MeasureText text = measure_text(m, k);
      row.push_back(text.value + (text.difference.empty() ? "" : "  (" + text.difference + ")"));
    }
    rows.push_back(std::move(row));
  }
  std::vector<std::size_t> width(plans + 1, 0);
  for (const auto& row : rows) {
    for (std::size_t i = 0; row.size() > 1 && i < row.size(); ++i) {
      width[i] = std::max(width[i], width_of(row[i]));
    }
  }
  std::string text;
  for (const auto& row : rows) {
    std::string line = padded(row[0], row.size() > 1 ? width[0] : 0, false);
    for (std::size_t i = 1; i < row.size(); ++i) line += "  " + padded(row[i], width[i]);
    text += line + "\n";
  }
  return text;
}

std::string comparison_csv(const Comparison& c) {
  std::string text =
      "measure,of,unit,plan,value,standard_error,states,difference_from_first,"
      "difference_standard_error\n";
  for (const ComparedMeasure& m : c.table) {
    for (std::size_t k = 0; k < c.names.size(); ++k) {
      const SampledValue& e = m.value[k];
      const SampledValue& d = m.difference_from_first[k];
      const bool known = std::isfinite(e.value);
      text += fmt::format("{},{},{},{},{},{},{},{},{}\n", m.key, csv_text(m.group),
                          m.unit == "%" ? "1" : m.unit, csv_text(c.names[k]), csv_number(e.value),
                          known ? csv_number(e.standard_error) : "", e.states, csv_number(d.value),
                          std::isfinite(d.value) ? csv_number(d.standard_error) : "");
    }
  }
  return text;
}

std::string differing_states_csv(const Comparison& c, Knowledge of) {
  const auto& verdicts = c.verdicts[static_cast<std::size_t>(of)];
  std::string text = "x_m,y_m,heading_rad";
  for (std::size_t k = 0; k < verdicts.size(); ++k) text += fmt::format(",verdict_{}", k + 1);
  text += "\n";
  for (std::size_t i = 0; i < c.ground.states.size(); ++i) {
    if (!c.ground.is_counted(i)) continue;
    std::size_t kept = 0;
    for (const auto& of_plan : verdicts) kept += is_kept(of_plan[i]) ? 1 : 0;
    if (kept == 0 || kept == verdicts.size()) continue;
    const State& s = c.ground.states[i];
    text += fmt::format("{},{},{}", s.position_m.x, s.position_m.y, s.heading.rad());
    for (const auto& of_plan : verdicts) text += fmt::format(",{}", name_of(of_plan[i]));
    text += "\n";
  }
  return text;
}

}  // namespace fairway
