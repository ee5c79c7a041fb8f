// The successor relation of the border samples of a plan: every sample state has one successor.
//
// A state flies from its sample through the cell it enters (exactly, bitmap_row.hpp) to the next
// border and is snapped to the nearest sample there. How open points of the model are decided here:
//   - no sample heads along a border, and snapping keeps the quadrant of a heading, so a state that
//     has crossed a border enters the next cell;
//   - exits at corners belong to one of the two borders, depending on rounding; a corner that is
//   only
//     touched is not seen;
//   - two commands that oppose each other across a border make a state weave along it in hops of at
//     least 2 r sin(pi / m): that is far more than half a sample, so it advances; a loop in
//     the relation never reaches;
//   - cells of the region end a flight with success, other obstacle cells and the grid's edge
//     without; everything else is flown through, including goal cells that are not the region;
//   - a state of a border of the region that heads out of it has not reached it. (The paper counts
//     the region's whole border as reached, whatever the heading.)
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "fairway/bitmap/bitmap_row.hpp"
#include "fairway/bitmap/bitmap_samples.hpp"
#include "fairway/bitmap/border_bitmap.hpp"
#include "fairway/plan/plan.hpp"

namespace fairway {

enum class BitmapEnd : std::uint8_t { none, reached, not_reached };

class BitmapGraph {
 public:
  /// A sample state, by the cell that it enters.
  struct Node {
    std::uint32_t place = 0;  ///< of the cell, see place_of
    Side entry = Side::left;
    int heading = 0;
    int position = 0;
  };

  /// Keeps no reference to `plan`. `target_cells` is [iy][ix], not 0 for cells of the region of
  /// interest. Throws PreconditionViolation when sizes do not fit or the cell is not smaller than
  /// the turning radius.
  BitmapGraph(const Plan& plan, const std::vector<std::uint8_t>& target_cells, int samples);

  const BitmapSamples& samples() const { return samples_; }
  BorderNumbers borders() const { return borders_; }

  /// The two cells of a border: what its nodes have in common.
  struct Border {
    std::uint32_t before = 0;  ///< to the left of it, or below
    std::uint32_t after = 0;
    bool upright = false;
  };
  Border border_at(std::size_t border) const {
    const bool upright = borders_.is_upright(border);
    const std::uint32_t before = place_of(borders_.cell_before(border));
    return {before, before + (upright ? 1 : stride_), upright};
  }
  Node node_at(const Border& border, int heading, int position) const {
    const int k = border.upright ? samples_.wrapped(heading + samples_.quarter()) : heading;
    const bool forward = k < 2 * samples_.quarter();  // east, or north
    const Side entry = border.upright ? (forward ? Side::left : Side::right)
                                      : (forward ? Side::bottom : Side::top);
    return {forward ? border.after : border.before, entry, heading, position};
  }
  Node node_at(std::size_t border, int heading, int position) const {
    return node_at(border_at(border), heading, position);
  }
  /// The border that a node lies on.
  std::size_t border_of(const Node& node) const {
    const Record& cell = cells_[node.place];
    switch (node.entry) {
      case Side::right:
        return cell.right_border;
      case Side::top:
        return cell.top_border;
      case Side::left:
        return cell.right_border - std::size_t{1};
      default:
        return cell.top_border - static_cast<std::size_t>(borders_.nx);
    }
  }
  std::uint32_t place_of(Cell c) const {
    return static_cast<std::uint32_t>(c.iy + 1) * stride_ + static_cast<std::uint32_t>(c.ix + 1);
  }

  /// What entering the node's cell decides.
  BitmapEnd end_of(const Node& node) const { return cells_[node.place].end; }

  BitmapRow row_of(const Node& node) const {
    return {samples_, cells_[node.place].command, turn_radius_, node.entry, node.heading};
  }
  /// The node after `node`, given its row. Its border is an inner one unless end_of is not none.
  Node successor(const Node& node, const BitmapRow& row) const {
    const BitmapExit exit = row.exit(samples_, node.position);
    const std::array<std::uint32_t, 4> steps{1, stride_, 0U - 1U, 0U - stride_};
    const auto side = static_cast<std::size_t>(exit.side);
    return {node.place + steps[side], static_cast<Side>((side + 2) & 3), exit.heading,
            exit.position};
  }

 private:
  struct Record {
    BitmapCommand command;
    std::uint32_t right_border = 0;
    std::uint32_t top_border = 0;
    BitmapEnd end = BitmapEnd::not_reached;
  };

  BitmapSamples samples_;
  BorderNumbers borders_;
  double turn_radius_;         // in cell sides
  std::uint32_t stride_;       // of the padded table
  std::vector<Record> cells_;  // [ny + 2][nx + 2], a ring around the grid
};

}  // namespace fairway
