// The flight of one set of behaviours to its image: what behaviour_flight.hpp promises, step by
// step. It never looks back: every set it is left with starts in a part with a range of headings.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "fairway/inclusion/behaviour_flight.hpp"

namespace fairway {

// Headings so near an arc count as aligned, one tolerance inside the next: what is left out of a
// turn must have been told as aligned, whatever rounding did.
inline constexpr double align_slack_rad = heading_slack_rad;
inline constexpr double drop_slack_rad = 0.5 * heading_slack_rad;
inline constexpr double start_slack_rad = 0.25 * heading_slack_rad;

struct SideAxis {
  Vec2 outward;
  double heading_rad;
};
inline constexpr std::array<SideAxis, 4> side_axes{
    {{{1.0, 0.0}, 0.0}, {{0.0, 1.0}, 0.5 * pi}, {{-1.0, 0.0}, pi}, {{0.0, -1.0}, 1.5 * pi}}};

/// Whether some heading of a part's arc leads out over this side of it.
inline bool is_crossed(const HeadingArc& arc, PartSide side) {
  return arc.meets({side_axes[static_cast<std::size_t>(side)].heading_rad - 0.5 * pi, pi});
}

/// Longer than any way through a part along headings of `arc`: every bit of the way leads on along
/// the arc's middle, by the cosine of half its width.
inline double longest_way(const HeadingArc& arc) {
  return 1.5 / std::max(std::cos(0.5 * arc.width_rad), 1e-6);
}

/// The segment of a side of a part over places [lo, hi].
ConvexSet segment_of_side(PartPlace part, PartSide side, double lo, double hi);
/// The part beyond it.
PartPlace part_beyond(PartPlace part, PartSide side);

/// What behaviours did since they started.
struct Past {
  HeadingArc headings;
  double flown = 0.0;  ///< at most, in parts
};

/// Behaviours at a place of `set` with a heading of [lo, hi].
struct ArrivingSet {
  ConvexSet set;
  double lo_rad = 0.0;
  double hi_rad = 0.0;
  Past past;
  double slack = 0.0;  ///< how far places may be off
};

class SetFlight {
 public:
  SetFlight(const Parts& parts, const BehaviourOptions& options, BehaviourImage& image)
      : parts_(parts), options_(options), image_(image) {}

  /// `from`: the arc of commands before, null when no side can be held.
  void start(PartPlace part, const ArrivingSet& arriving, const HeadingArc* from);
  void finish();
  /// Tells of all ends that the set touches at the start.
  void touch(const ConvexSet& set);
  /// The set at the start lies within `box`, exactly: who never moves against one direction of an
  /// axis does not come back behind it, however far the sets on the way are off.
  void starts_within(const Box& box) { start_ = box; }
  /// Where behaviours are, and with which headings: for the tube, if there is one.
  void note(PartPlace part, const HeadingArc& headings);

 private:
  enum class Turn : int { left = 1, right = -1 };
  static Turn other(Turn side) { return side == Turn::left ? Turn::right : Turn::left; }

  struct TurningSet {
    ArrivingSet from;
    Turn turn = Turn::left;
  };
  /// One step of a turning set.
  struct Step {
    double begin_rad;
    double size_rad;
    ConvexSet ends;   ///< from its beginning to its end
    ConvexSet swept;  ///< on the way
  };
  struct PartPiece {
    PartPlace part;
    PartKind kind;
    ConvexSet piece;
  };
  /// What of a turning set goes another way in a part, over successive steps.
  struct Gathered {
    PartPlace part;
    ArrivingSet arriving;
  };

  bool is_over();
  static double beyond(const HeadingArc& arc, double heading_rad, Turn turn);
  bool ends_there(PartKind kind);
  void keep_ahead_of_start(Crossing& crossing) const;
  template <typename Body>
  void exits(PartPlace part, const ConvexSet& set, const HeadingArc& arc, double slack,
             const Body& body) const;
  /// `slack`: how far the set may be off.
  void align(PartPlace part, const ConvexSet& set, const Past& past, double slack);
  static void gather(std::vector<Gathered>& sets, PartPlace part, const ConvexSet& piece,
                     const HeadingArc& headings, const Past& past);
  void add_turning(const ArrivingSet& arriving, HeadingArc wanted, Turn turn);
  void turn(const TurningSet& set);
  Step step_from(const ConvexSet& set, double begin_rad, double size_rad, Turn turn,
                 bool starting) const;
  double first_edge(const Step& step, Turn turn);

  const Parts& parts_;
  const BehaviourOptions& options_;
  BehaviourImage& image_;
  std::optional<Box> start_;
  std::vector<TurningSet> turning_;
  std::vector<PartPiece> pieces_;  ///< of the present step
  std::vector<Vec2> on_;           ///< corners of those who turn on
  int steps_ = 0;
};

}  // namespace fairway
