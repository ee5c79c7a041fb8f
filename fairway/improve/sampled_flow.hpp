// A model of a plan that is cheap to change: what share of sampled states reaches the target, and
// how that share changes with the commands of a few cells.
//
// Two kinds of flights, each to the next place where a vehicle leaves a cell aligned with the
// cell's command: from *starts*, states spread evenly over every cell and all headings, and from
// *nodes*, points spread evenly over the sides by which the command of a cell leads out. A flight
// ends at the nearest node, or reaches, or fails; so starts lead into a forest of nodes, whose
// roots are the ends of flights (a node on a loop fails). Each cell knows which flights meet it:
// when its command changes, those are flown again, and no others.
//
// Properties that always hold:
//   1. After `apply` all figures are as if the model had been made of the new commands.
//   2. `Trial::ask` changes nothing, and says exactly by how much the figures change when the same
//      changes are applied. Trials on different threads do not meet.
// It is a model, not a proof: flights are snapped to nodes, so a share is good to some tenths of a
// percentage point.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "fairway/vehicle/cell_motion.hpp"
#include "fairway/verify/flow.hpp"

namespace fairway {

struct SampledFlowOptions {
  int nodes_per_side = 16;   ///< at least 1
  int starts_per_cell = 64;  ///< at least 1
  int most_crossings = 500;  ///< of a flight; after as many it circles, which is to fail
  /// Not whoever enters a target cell reaches, but whoever leaves one aligned with its command: of
  /// the cells of a path, whoever flies along it.
  bool reaches_aligned = false;
};

/// By how much the figures of a model change.
struct ModelChange {
  std::int64_t reached = 0;
  std::int64_t borders = 0;
  std::int64_t tears = 0;
};

/// Another command for an ordinary cell.
struct CommandChange {
  std::size_t cell = 0;  ///< index in the grid
  float heading_rad = 0.0F;
};

class SampledFlow {
 public:
  using Id = std::uint32_t;  ///< of a node, then of a start

  /// Keeps no reference to the arrays of `flow`. Throws PreconditionViolation when the cell is not
  /// smaller than the turning radius, an option is out of range, or the grid has more cells than
  /// most_cells().
  explicit SampledFlow(const Flow& flow, const SampledFlowOptions& options = {});
  /// Flights have 32-bit numbers. A ring of cells around the grid counts.
  static std::size_t most_cells(const SampledFlowOptions& options = {});

  /// How many starts reach, of `starts()`, those of ordinary cells.
  std::int64_t reached() const { return reached_; }
  std::int64_t starts() const { return starts_; }
  /// How many neighbouring nodes there are of which one reaches and the other fails. A proof must
  /// cut leaves there; where there are many, motion is chaotic, and no proof comes to an end.
  std::int64_t borders() const { return borders_; }
  /// How many neighbouring nodes there are whose flights end far apart: where nearby flights part.
  std::int64_t tears() const { return tears_; }
  /// About how many starts meet the cell on their way to their first node and fail: those that met
  /// it before commands changed may be among them.
  std::size_t failing_near(std::size_t cell) const;
  float heading_rad(std::size_t cell) const { return heading_rad_[cell]; }
  CellKind kind(std::size_t cell) const { return kind_[place_of(cell)]; }

  /// A flight that is about to cross a cell.
  struct Airborne {
    std::size_t place = 0;
    CellState state;
    int crossings = 0;
  };

  /// Asks what changes would do; one for each thread. Refers to its flow.
  class Trial {
   public:
    explicit Trial(const SampledFlow& flow);
    ModelChange ask(std::span<const CommandChange> changes);
    /// To be called after the flow was given these changes.
    void follow(std::span<const CommandChange> applied);

   private:
    friend class SampledFlow;
    void begin_trial();
    void fly(std::span<const CommandChange> changes);
    bool is_first(Id flight);
    void come_to(std::size_t place);
    void fly_through(std::size_t place);
    void find_values();
    bool value_of(Id end);
    std::int64_t count();
    std::int64_t count_upstream(Id node);
    std::int64_t count_borders() const;
    std::int64_t count_tears() const;

    const SampledFlow* flow_;
    std::vector<Direction> command_;     // by place, with the changes while they are asked about
    std::vector<std::uint32_t> seen_;    // by flight: the number of the trial that flew it last
    std::vector<std::uint32_t> slot_;    // by node: where in `flown_` it is, if seen in this trial
    std::vector<std::uint32_t> walked_;  // by node: the walk that came by last
    std::uint32_t trial_ = 0;
    std::uint32_t walk_ = 0;
    struct Flown {
      Id flight;
      Id end;
      std::int8_t value;  // of nodes: reaches 1, fails 0, unknown -1
    };
    std::vector<Flown> flown_;
    /// A flight as it comes to the cell that is asked about, and where it ends after a turn that
    /// lasts all through the cell: the same whatever the command, but for its side.
    struct Coming {
      Id flight;
      Airborne at;
      std::array<Id, 2> end;  // [left, right], passing: not known
    };
    std::vector<Coming> coming_;
    std::size_t coming_to_ = 0;             // place; 0, in the ring: none
    std::uint64_t version_ = 0;             // of the flow when they came
    std::uint32_t fewest_steps_ = 0;        // of the nodes flown, before the change
    std::vector<Id> turned_;                // nodes whose values change
    std::vector<std::uint32_t> turned_in_;  // by node: the last trial in which it did
    std::vector<Id> pending_;
    std::vector<Id> path_;
  };

  void apply(std::span<const CommandChange> changes);

 private:
  static constexpr Id reaches = ~Id{0};
  static constexpr Id fails = ~Id{1};
  static constexpr Id nowhere = ~Id{2};  // of a node on a side by which its command does not lead
  static constexpr Id passing = ~Id{3};  // has not ended yet
  static constexpr std::uint32_t never = ~std::uint32_t{0};

  std::size_t place_of(std::size_t cell) const {
    const auto nx = static_cast<std::size_t>(nx_);
    return (cell / nx + 1) * stride_ + cell % nx + 1;
  }
  std::size_t step(Side side) const {
    const std::array<std::size_t, 4> steps{1, stride_, std::size_t{0} - 1,
                                           std::size_t{0} - stride_};
    return steps[static_cast<std::size_t>(side)];
  }
  bool is_node(Id id) const { return id < nodes_; }
  std::size_t place_of_flight(Id flight) const;
  Id first_node(std::size_t place) const { return static_cast<Id>(place * 4 * per_side_); }
  Id fly(Id flight, const std::vector<Direction>& commands, std::vector<std::uint32_t>* met) const;
  bool take_off(Id flight, const std::vector<Direction>& commands, Airborne& at) const;
  Id fly_on(Airborne& at, const std::vector<Direction>& commands, std::vector<std::uint32_t>* met,
            std::size_t until) const;
  Id cross(Airborne& at, const CellExit& exit, bool commanded) const;
  CellState state_of_start(Id flight) const;
  void link(Id node, Id end);
  void unlink(Id node);
  void renew_values(std::span<const Id> changed);
  void remember(Id flight, std::span<const std::uint32_t> met);
  bool torn(Id a, Id b) const;

  int nx_ = 0;
  std::size_t stride_ = 0;  // of arrays by place: the grid with a ring of cells around it
  CellShape shape_;
  std::uint32_t per_side_ = 0;
  std::uint32_t per_cell_ = 0;
  int most_crossings_ = 0;
  bool reaches_aligned_ = false;
  Id nodes_ = 0;
  std::int64_t starts_ = 0;
  std::int64_t reached_ = 0;
  std::int64_t borders_ = 0;
  std::int64_t tears_ = 0;
  std::vector<float> heading_rad_;     // by cell
  std::vector<Direction> command_;     // by place
  std::vector<CellKind> kind_;         // by place
  std::vector<Id> end_;                // by flight
  std::vector<std::uint8_t> value_;    // by node: whether it reaches
  std::vector<std::uint32_t> steps_;   // by node: to its end; never, on a loop and before one
  std::vector<std::uint32_t> direct_;  // by node: how many starts lead to it directly
  // The nodes that lead to a node, as a list: links are changed far more often than read.
  std::vector<Id> first_before_, next_before_, previous_before_;
  std::vector<std::vector<Id>> meeting_;  // by place: flights that meet it, some no longer
  std::vector<std::uint32_t> tidy_at_;    // by place: length of that list when it is tidied
  std::uint64_t version_ = 1;             // one more for each change
  std::unique_ptr<Trial> own_trial_;
};

}  // namespace fairway
