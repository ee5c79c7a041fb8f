// The images of sets of states: where their flights meet the section next, or how they end.
// Computed once for each set; what is proved about the section is then looked up.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "fairway/verify/section_flight.hpp"
#include "fairway/verify/section_verdicts.hpp"

namespace fairway {

/// A part of an image on one section.
struct ImagePiece {
  std::uint32_t section = 0;
  UnitRange range;
  float flown_s = 0.0F;  ///< upper bound
  bool hop = false;      ///< section_flight.hpp, property 4
};

/// What a set of states does until all of it has met the section or ended.
struct Image {
  VerdictSet ends;
  bool gave_up = false;
  std::span<const ImagePiece> pieces;
};

/// Images by number, in blocks so that threads fill them without sharing.
class ImageStore {
 public:
  explicit ImageStore(std::size_t count = 0);

  std::size_t size() const { return count_; }
  std::size_t bytes() const;
  Image operator[](std::size_t i) const;

  /// Fills the images of all blocks in parallel: `fly(i, visitor)` follows set i. When `go_on()`
  /// is false, the blocks not yet started are left given up. Defined in images.cpp and so callable
  /// only there: only the two functions below fill a store.
  template <typename Fly>
  void fill(const Flow& flow, const Fly& fly, const std::function<bool()>& go_on);

 private:
  static constexpr std::size_t block_size = 256;
  struct Block {
    std::vector<std::uint32_t> first;  // [images + 1]
    std::vector<ImagePiece> pieces;
    std::vector<VerdictSet> ends;
    std::vector<std::uint8_t> gave_up;
  };
  std::size_t count_;
  std::vector<Block> blocks_;
};

/// Of borders, in one flight of a leaf: a wide leaf that is not resolved in a few crossings will
/// not be in many.
int crossings_worth(UnitRange leaf, int most_crossings);

/// A leaf of a section, by its range.
struct LeafPlace {
  std::uint32_t section = 0;
  UnitRange range;  ///< from its start to its end
};

/// The images of `leaves`.
ImageStore leaf_images(const Flow& flow, std::span<const LeafPlace> leaves, int most_crossings,
                       const std::function<bool()>& go_on);

/// A state of the configuration space.
struct Place {
  double x_m = 0.0;
  double y_m = 0.0;
  double heading_rad = 0.0;
};
/// The images of single states.
ImageStore state_images(const Flow& flow, std::span<const Place> states, int most_crossings,
                        const std::function<bool()>& go_on);

/// What is known about a set of states: the verdict of all, undecided when they differ.
VerdictSet verdicts_of(const Image& image, const SectionView& sections);

/// How far, at least, the hop of a weave moves every state of the leaf along the border, in units;
/// 0 when it may not move at all. All move alike (section_flight.hpp, property 4), so one end of
/// the leaf is enough: the end that the side's end cannot have cut.
double least_move(UnitRange hop, UnitRange leaf);
inline double least_move(const ImagePiece& hop, UnitRange leaf) {
  return least_move(hop.range, leaf);
}

}  // namespace fairway
