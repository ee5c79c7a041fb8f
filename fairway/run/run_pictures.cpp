#include "fairway/run/run_pictures.hpp"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "fairway/base/atomic_file.hpp"
#include "fairway/report/draw_chart.hpp"
#include "fairway/report/draw_flights.hpp"
#include "fairway/report/draw_plan.hpp"
#include "fairway/report/flight_series.hpp"

namespace fairway {
namespace {

void write(const Picture& picture, const std::filesystem::path& folder, const std::string& name) {
  write_whole(folder / (name + ".svg"), Existing::keep, picture.svg);
  write_whole(folder / (name + ".png"), Existing::keep, picture.png);
}

std::string name_of_start(const State& start) {
  return fmt::format("from ({:g}, {:g}, {:.2f} rad)", start.position_m.x, start.position_m.y,
                     start.heading.rad());
}

}  // namespace

void write_run_pictures(const Plan& plan, const Mission& mission, const ScenarioFlights& flown,
                        const std::string& title, const std::filesystem::path& folder) {
  write(draw_plan(plan, {.title = title, .mission = mission}), folder, "plan");
  write(draw_flights(plan, flown.recorded, {.title = title, .mission = mission, .names = {}}),
        folder, "flights");

  // Charts of more than a few lines say nothing: those of the given states, else the first ones.
  constexpr std::size_t most_lines = 6;
  const std::size_t wanted = flown.given > 0 ? flown.given : 3;
  const std::size_t lines = std::min({wanted, most_lines, flown.recorded.size()});
  if (lines == 0) return;
  const auto* path = std::get_if<PathMission>(&mission);
  std::vector<ChartSeries> headings;
  std::vector<ChartSeries> distances;
  for (const Flight& flight : std::span(flown.recorded).first(lines)) {
    const std::string name = name_of_start(flight.start);
    const double speed_mps = plan.vehicle.speed_mps;
    headings.push_back(heading_over_time(flight, speed_mps, name));
    if (path != nullptr) {
      const double step_m = plan.grid.cell_m / 4.0;
      distances.push_back(path_distance_over_time(flight, speed_mps, *path, step_m, name));
    }
  }
  ChartOptions chart{.title = title, .x_label = "time, s", .y_label = "heading, rad"};
  write(draw_chart(headings, chart), folder, "headings");
  if (path == nullptr) return;
  chart.y_label = "distance to the path, m";
  chart.y_from_zero = true;
  write(draw_chart(distances, chart), folder, "distance");
}

}  // namespace fairway
