// Figs. 5 to 7 of paper 3, and the study of its law: where it converges, where it is shortest, its
// worst ratio to the shortest path, over a dense sample of poses.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "fairway/report/picture.hpp"
#include "fairway/steer/clf_law.hpp"
#include "fairway/steer/dubins_words.hpp"
#include "fairway/steer/steering_flight.hpp"

namespace fairway::reproduce {

/// A flight of a figure. Radius 1, the goal at (0, 0) heading +y.
struct SteeringExample {
  std::string figure;
  State start;
  SteeringFlight flight;
  DubinsPath shortest;
  bool repelled = false;  ///< at the start
};

/// The law over starts within 6 r of the goal, any heading.
struct SteeringStudy {
  std::string name;
  Repulsion repulsion = Repulsion::none;
  int starts = 0;
  double converged = 0.0;   ///< shares of all starts
  double shortest = 0.0;    ///< within 0.05 r of the shortest length
  double mean_ratio = 0.0;  ///< of lengths to the shortest, over those that converge
  double worst_ratio = 0.0;
  State worst_start;
};

struct SteeringFigures {
  std::map<std::string, Picture> pictures;  ///< "paper3-fig5a" and so on, "steering-map-none"
  std::vector<SteeringExample> examples;
  std::vector<SteeringStudy> studies;
};

/// `per_side` places along each side of the square, headings every 360 / `headings` degrees.
[[nodiscard]] SteeringStudy study_of(Repulsion repulsion, int per_side, int headings);
[[nodiscard]] std::vector<SteeringExample> steering_examples();
[[nodiscard]] SteeringFigures draw_steering();

/// The tables in Markdown.
[[nodiscard]] std::string tables_of(const SteeringFigures& figures);

}  // namespace fairway::reproduce
