#include "reproduce/tables.hpp"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>

namespace fairway::reproduce {
namespace {

double mean_of(const std::vector<double>& values) {
  if (values.empty()) return 0.0;
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

std::string goal_table(const std::vector<GoalRow>& rows) {
  std::string text =
      "| | turning (rad) | reversals | rms rate (rad/s) | largest rate (rad/s) | time (s) |"
      " reach | mean turning (rad) | mean reversals | mean rms rate (rad/s) | mean largest rate"
      " (rad/s) |\n|---|---|---|---|---|---|---|---|---|---|---|\n";
  for (const GoalRow& r : rows)
    text += fmt::format(
        "| {} | {:.2f} | {} | {:.3f} | {:.3f} | {:.1f} | {:.1f} % | {:.2f} | {:.2f} | {:.4f} |"
        " {:.4f} |\n",
        r.name, r.drawn.turning_rad, r.drawn.reversals, r.drawn.rms_rate_radps,
        r.drawn.largest_rate_radps, r.drawn_time_s, 100.0 * r.reached_share, r.mean_turning_rad,
        r.mean_reversals, r.mean_rms_rate_radps, r.mean_largest_rate_radps);
  return text;
}

std::string path_table(const std::vector<PathRow>& rows) {
  std::string text =
      "| | mean (m) | max (m) | mean away from corners (m) | mean corner spike (m) | spike at each"
      " corner (m) |\n|---|---|---|---|---|---|\n";
  for (const PathRow& r : rows) {
    std::string corners;
    for (const double spike : r.lap.corner_m)
      corners += fmt::format("{}{:.1f}", corners.empty() ? "" : ", ", spike);
    text += fmt::format("| {} | {:.2f} | {:.1f} | {:.2f} | {:.1f} | {} |\n", r.name, r.lap.mean_m,
                        r.lap.max_m, r.lap.mean_of_straights_m, mean_of(r.lap.corner_m), corners);
  }
  return text;
}

nlohmann::json numbers_of(const GoalRow& r) {
  return {{"cell_m", r.cell_m},
          {"sigma_cells", r.sigma_cells},
          {"turning_rad", r.drawn.turning_rad},
          {"reversals", r.drawn.reversals},
          {"rms_rate_radps", r.drawn.rms_rate_radps},
          {"largest_rate_radps", r.drawn.largest_rate_radps},
          {"time_s", r.drawn_time_s},
          {"reached_share", r.reached_share},
          {"mean_turning_rad", r.mean_turning_rad},
          {"mean_reversals", r.mean_reversals},
          {"mean_rms_rate_radps", r.mean_rms_rate_radps},
          {"mean_largest_rate_radps", r.mean_largest_rate_radps}};
}

nlohmann::json numbers_of(const PathRow& r) {
  return {{"cell_m", r.cell_m},
          {"sigma_cells", r.sigma_cells},
          {"mean_m", r.lap.mean_m},
          {"max_m", r.lap.max_m},
          {"mean_of_straights_m", r.lap.mean_of_straights_m},
          {"corner_m", r.lap.corner_m}};
}

template <typename Row>
nlohmann::json list_of(const std::vector<Row>& rows) {
  nlohmann::json list = nlohmann::json::array();
  for (const Row& row : rows) list.push_back(numbers_of(row));
  return list;
}

}  // namespace

std::string tables_of(const Reproduction& r) {
  return "Fig. 6, heading of the single goal mission by sigma, cells of 8 m:\n\n" +
         goal_table(r.goal_by_sigma) +
         "\nFig. 7, distance from the path by sigma, cells of 8 m:\n\n" +
         path_table(r.path_by_sigma) +
         "\nFig. 8a, heading by resolution (sigma 16, 8, 4 cells):\n\n" +
         goal_table(r.goal_by_cell) +
         "\nFig. 8b, distance from the path by resolution (sigma 16, 8, 4 cells):\n\n" +
         path_table(r.path_by_cell);
}

nlohmann::json numbers_of(const Reproduction& r) {
  return {{"fig6", list_of(r.goal_by_sigma)},
          {"fig7", list_of(r.path_by_sigma)},
          {"fig8a", list_of(r.goal_by_cell)},
          {"fig8b", list_of(r.path_by_cell)}};
}

std::string tables_of(const CellSetFigures& cells, const ExpansionFigures& e) {
  const auto percent = [](double share) { return fmt::format("{:.2f} %", 100.0 * share); };
  std::string out = "| figure | what | |\n|---|---|---|\n";
  const auto row = [&](const char* figure, const char* what, const std::string& value) {
    out += fmt::format("| {} | {} | {} |\n", figure, what, value);
  };
  row("8a", "points from which the top is out of reach, r = 20 m", percent(cells.unreachable_8a));
  row("8b", "the same, r = 8.1 m", percent(cells.unreachable_8b));
  row("20", "y max, Eq. 16", fmt::format("{:.3f} m", cells.y_max_m));
  for (std::size_t s = 0; s < e.border_shares.size(); ++s)
    row("21", fmt::format("S{} of all samples of its border", s + 1).c_str(),
        percent(e.border_shares[s]));
  row("23", "border states, n = 20, m = 200", fmt::format("{}", e.states));
  row("23", "stored", fmt::format("{} bytes", e.stored_bytes));
  row("23", "border states that reach", percent(e.border_share));
  row("23", "configuration volume that reaches", percent(e.volume_share));
  row("23", "sweeps of Algorithm 1 for the same bits",
      fmt::format("{}{}", e.sweeps, e.algorithm_1_agrees ? "" : " (THE BITS DIFFER)"));
  return out;
}

nlohmann::json numbers_of(const CellSetFigures& cells, const ExpansionFigures& e) {
  return {{"fig8a_unreachable", cells.unreachable_8a},
          {"fig8b_unreachable", cells.unreachable_8b},
          {"fig20_y_max_m", cells.y_max_m},
          {"fig21_border_shares", e.border_shares},
          {"fig23",
           {{"states", e.states},
            {"stored_bytes", e.stored_bytes},
            {"border_share", e.border_share},
            {"volume_share", e.volume_share},
            {"sweeps", e.sweeps},
            {"algorithm_1_agrees", e.algorithm_1_agrees}}}};
}

}  // namespace fairway::reproduce
