#include "fairway/tune/tuning_pictures.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <string>

#include "fairway/base/atomic_file.hpp"
#include "fairway/report/draw_chart.hpp"

namespace fairway {
namespace {

void write(const Picture& picture, const std::filesystem::path& folder, const std::string& name) {
  write_whole(folder / (name + ".svg"), Existing::keep, picture.svg);
  write_whole(folder / (name + ".png"), Existing::keep, picture.png);
}

}  // namespace

void write_tuning_pictures(const std::vector<Evaluation>& all, const Objective& objective,
                           const std::filesystem::path& folder) {
  constexpr double percent = 100.0;
  ChartSeries each{"each evaluation", {}, {}, LineStyle::dotted};
  ChartSeries best{"of the best so far", {}, {}, LineStyle::solid};
  double best_value = -std::numeric_limits<double>::infinity();
  double share_of_best = 0.0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double value = value_of(all[i], all.front(), objective);
    if (value > best_value) {
      best_value = value;
      share_of_best = all[i].share;
    }
    each.x.push_back(static_cast<double>(i + 1));
    each.y.push_back(percent * all[i].share);
    best.x.push_back(static_cast<double>(i + 1));
    best.y.push_back(percent * share_of_best);
  }
  const std::array search{best, each};
  write(draw_chart(
            search,
            {.title = "The search", .x_label = "evaluation", .y_label = "states that arrive, %"}),
        folder, "search");
  ChartSeries front{"no other is better in both", {}, {}, LineStyle::solid};
  for (const std::size_t i : pareto_front(all)) {
    front.x.push_back(all[i].mean_time_s);
    front.y.push_back(percent * all[i].share);
  }
  const std::array fronts{front};
  write(draw_chart(fronts, {.title = "Share against time",
                            .x_label = "mean time of those that arrive, s",
                            .y_label = "states that arrive, %"}),
        folder, "pareto");
}

}  // namespace fairway
