// The flight of one state, or of one behaviour from it, for quick_lookup.hpp: that of
// set_flight.hpp with octagons for sets, integers for headings, and no memory but its own.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "fairway/base/vec2.hpp"
#include "fairway/inclusion/lookup_table.hpp"
#include "fairway/inclusion/octagon.hpp"
#include "fairway/inclusion/parts.hpp"

namespace fairway {

/// Of a QuickFlight: headings so near an arc count as aligned and as turning on, in TurnUnits.
inline constexpr std::uint64_t quick_slack = 256;
inline constexpr std::uint64_t whole_turn_units = std::uint64_t{1} << 32U;

struct QuickFlightOptions {
  SizeRange turn_radius;  ///< in parts
  double grown = 0.0;     ///< by how much sets are larger than what they hold, in parts
  TurnUnits hold_side = 0;
  TurnUnits opposite = 0;  ///< as far as a turn through the smaller angle may go
  double part_s = 0.0;     ///< for the way through a part, at most
  /// Powers of 2: steps end at multiples of the first where behaviours align or turn back, at
  /// multiples of the second where they only turn. 2^24 to 2^29.
  TurnUnits finest_bin = 1U << 27U;
  TurnUnits widest_bin = 1U << 29U;

  /// `steps`: finest ones in a whole turn, 8 to 256, a power of 2.
  static QuickFlightOptions of(const Parts& parts, double speed_least_mps, int steps);
  /// In parts: beyond, sets do not hold what floats and integers round off.
  static constexpr double most_radius = 32.0;
};

class QuickFlight {
 public:
  QuickFlight(const LookupTable& table, const QuickFlightOptions& options)
      : table_(table), options_(options) {}

  /// `place`: in parts, of the grid, and not within the slack of a border between parts; `unit`:
  /// the heading's.
  void fly(Vec2 place, TurnUnits heading, Vec2 unit);
  /// The same for all states at a place of `set` in an ordinary part, and with a heading from
  /// `from` over `span`, less than half a turn, counted counter-clockwise.
  void fly(PartPlace part, const Octagon& set, TurnUnits from, TurnUnits span);

  /// Single behaviours only, of the least and of the widest turn, looked at every few degrees: when
  /// is_undecided says so, flying all from this state will most probably say it, too. Proves
  /// nothing.
  void try_out(Vec2 place, TurnUnits heading, Vec2 unit);

  /// Bit v: some behaviour may come to Verdict v; all of them, when all are followed and the bits
  /// do not say undecided.
  unsigned verdicts() const { return verdicts_; }
  bool follows_all() const { return follows_all_; }
  /// It ended early, since sets lay over too many parts.
  bool was_too_wide() const { return was_too_wide_; }
  double worst_time_s() const { return worst_time_s_; }
  bool is_undecided() const {
    constexpr unsigned undecided = 1U << static_cast<unsigned>(Verdict::undecided);
    return (verdicts_ & undecided) != 0 || (verdicts_ & (verdicts_ - 1)) != 0;
  }

 private:
  enum class Turn : int { left = 1, right = -1 };

  /// A part that a step leads through.
  struct Met {
    PartPlace part;
    const PartRecord* record;
    std::uint64_t beyond;  ///< Step::beyond
  };
  /// What is aligned with a part, over all steps.
  struct Aligned {
    Met met;
    Octagon set;
    double flown;
    bool is_told;
  };
  /// Behaviours that turn, with headings from `first` over `span`, the way of the turn; `unit`: of
  /// the first.
  struct Turning {
    Octagon set;
    PartPlace from;
    Turn side;
    TurnUnits first;
    std::uint64_t span;
    Vec2 unit;
    double flown;
  };
  struct Step {
    TurnUnits at;
    TurnUnits size;
    TurnUnits end;
    Turn side;
    Vec2 end_unit;
    double flown;  ///< when it ends
    /// How far its headings lie beyond the beginning of an arc, counted the way of the turn.
    std::uint64_t beyond(const PartRecord& record) const {
      return side == Turn::left ? TurnUnits(at - record.lo)
                                : TurnUnits(record.lo + record.width - at);
    }
  };

  struct Sweep {
    Octagon swept;  ///< on the way
    Octagon ends;   ///< from its beginning to its end
  };

  /// Those who turn, at one heading.
  struct Front {
    Octagon set;
    TurnUnits at;
    Vec2 unit;  ///< of the heading `at`
    std::uint64_t turned;
  };
  /// How far behaviours do nothing but turn on.
  struct ClearWay {
    std::uint64_t size = 0;
    const PartRecord* first = nullptr;  ///< the arc that begins there, if one does
    bool forgets = false;               ///< some may hold no side after the step
  };

  bool may_turn(TurnUnits ahead) const;
  void try_turn(Vec2 place, TurnUnits heading, Vec2 unit, Turn side);
  void turn_all();
  void turn(const Turning& start);
  Sweep sweep(const Octagon& here, Vec2 from, const Step& step) const;
  static Step step_to(Turn side, TurnUnits at, TurnUnits bin);
  bool end_at_edges(Step& step) const;
  template <typename Body>
  bool for_met(const Octagon& swept, const Body& body) const;
  bool meet(const Octagon& swept, const Step& step);
  bool forgets(std::uint64_t beyond, TurnUnits size, const PartRecord& record) const;
  ClearWay clear_way(const Octagon& swept, const Step& step) const;
  static bool end_at(const ClearWay& way, Step& step);
  TurnUnits leap(TurnUnits bin, Front& front, Turn side);
  void keep_met(const Octagon& swept);
  bool pass(const Step& step, const Octagon& swept);
  void turn_back(const Step& step, const Octagon& set, PartPlace part);
  bool turns_on(TurnUnits size, const Met& met) const;
  bool ends_there(PartKind kind, double flown);
  bool adds_nothing(const Met& met, double flown) const;
  void align(const Met& met, const Octagon& set, double flown);
  void leave_parts();
  void leave(const Aligned& aligned);
  template <std::size_t side>
  void leave_over(const Aligned& aligned);

  const LookupTable& table_;
  const QuickFlightOptions& options_;
  unsigned verdicts_ = 0;
  bool follows_all_ = true;
  bool was_too_wide_ = false;
  bool forgot_ = false;  ///< some may hold no side any more
  double worst_time_s_ = 0.0;
  std::size_t met_count_ = 0;
  std::size_t aligned_count_ = 0;
  std::size_t turning_count_ = 0;
  std::size_t turning_kept_ = 0;  ///< from there on they come from the present turn
  int tries_ = 0;
  int turn_backs_left_ = 1000;
  // Not initialised: they are counted.
  static constexpr std::size_t most_met = 32;
  static constexpr std::size_t most_aligned = 12;
  static constexpr std::size_t most_turning = 12;
  static constexpr int most_tries = 600;
  union {
    std::array<Met, most_met> met_;
  };
  union {
    std::array<Aligned, most_aligned> aligned_;
  };
  union {
    std::array<Turning, most_turning> turning_;
  };
};

}  // namespace fairway
