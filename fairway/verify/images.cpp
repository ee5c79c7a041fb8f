#include "fairway/verify/images.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fairway/base/parallel.hpp"
#include "fairway/verify/state_flight.hpp"

namespace fairway {
namespace {

float rounded_up(double x) {
  const auto f = static_cast<float>(x);
  return static_cast<double>(f) < x ? std::nextafter(f, std::numeric_limits<float>::infinity()) : f;
}

/// Writes what a flight reports into a block.
struct Recorder {
  const Flow& flow;
  std::vector<ImagePiece>& pieces;
  std::size_t begin;  // of this image's pieces
  VerdictSet ends;
  bool gave_up = false;

  double seconds(double length_m) const { return above(length_m / flow.vehicle.speed_mps); }

  void arrive(std::size_t section, Interval along_m, double length_m, bool hop) {
    const UnitRange range = units_of(along_m, flow.grid.cell_m);
    const float flown_s = rounded_up(seconds(length_m));
    for (std::size_t i = begin; i < pieces.size(); ++i) {  // two branches may meet again
      ImagePiece& piece = pieces[i];
      if (piece.section != section || piece.hop != hop || range.lo > piece.range.hi ||
          piece.range.lo > range.hi) {
        continue;
      }
      piece.range = {std::min(piece.range.lo, range.lo), std::max(piece.range.hi, range.hi)};
      piece.flown_s = std::max(piece.flown_s, flown_s);
      return;
    }
    pieces.push_back({static_cast<std::uint32_t>(section), range, flown_s, hop});
  }
  void end(Verdict verdict, double length_m) {
    ends.add(verdict, verdict == Verdict::trapped ? std::numeric_limits<double>::infinity()
                                                  : seconds(length_m));
  }
  void give_up() { gave_up = true; }
};

}  // namespace

/// A wide leaf that is not resolved in a few crossings will not be in many: it has fallen apart,
/// and its halves are resolved sooner. Leaves narrower than cell_m / 2^12 may have a long weave to
/// follow. On dense maps, nine tenths of all work used to go into wide leaves that then gave up.
int crossings_worth(UnitRange leaf, int most_crossings) {
  const double width = static_cast<double>(leaf.hi) - static_cast<double>(leaf.lo);
  const double worth = 160.0 * std::sqrt(std::max(1.0, 0x1p20 / std::max(1.0, width)));
  return worth < static_cast<double>(most_crossings) ? static_cast<int>(worth) : most_crossings;
}

ImageStore::ImageStore(std::size_t count)
    : count_(count), blocks_((count + block_size - 1) / block_size) {}

std::size_t ImageStore::bytes() const {
  std::size_t total = 0;
  for (const Block& block : blocks_) {
    total += sizeof(Block) + block.first.capacity() * sizeof(std::uint32_t) +
             block.pieces.capacity() * sizeof(ImagePiece) +
             block.ends.capacity() * sizeof(VerdictSet) + block.gave_up.capacity();
  }
  return total;
}

Image ImageStore::operator[](std::size_t i) const {
  const Block& block = blocks_[i / block_size];
  const std::size_t k = i % block_size;
  return {block.ends[k], block.gave_up[k] != 0,
          std::span(block.pieces).subspan(block.first[k], block.first[k + 1] - block.first[k])};
}

template <typename Fly>
void ImageStore::fill(const Flow& flow, const Fly& fly, const std::function<bool()>& go_on) {
  for_ranges(blocks_.size(), 1, [&](std::size_t a, std::size_t b) {
    for (std::size_t n = a; n < b; ++n) {
      Block& block = blocks_[n];
      const std::size_t images = std::min(block_size, count_ - n * block_size);
      block.first.assign(images + 1, 0);
      block.ends.assign(images, {});
      block.gave_up.assign(images, 1);
      if (!go_on()) continue;
      for (std::size_t k = 0; k < images; ++k) {
        Recorder recorder{flow, block.pieces, block.pieces.size(), {}};
        fly(n * block_size + k, recorder);
        block.first[k + 1] = static_cast<std::uint32_t>(block.pieces.size());
        block.ends[k] = recorder.ends;
        const bool told = recorder.ends.bits != 0 || block.pieces.size() > recorder.begin;
        block.gave_up[k] = recorder.gave_up || !told ? 1 : 0;
      }
      block.pieces.shrink_to_fit();
    }
  });
}

ImageStore leaf_images(const Flow& flow, std::span<const LeafPlace> leaves, int most_crossings,
                       const std::function<bool()>& go_on) {
  ImageStore images(leaves.size());
  images.fill(
      flow,
      [&](std::size_t i, Recorder& recorder) {
        const Interval along_m = along_of(leaves[i].range, flow.grid.cell_m);
        follow_to_section(flow, front_of_section(flow, leaves[i].section, along_m),
                          crossings_worth(leaves[i].range, most_crossings), recorder);
      },
      go_on);
  return images;
}

ImageStore state_images(const Flow& flow, std::span<const Place> states, int most_crossings,
                        const std::function<bool()>& go_on) {
  ImageStore images(states.size());
  images.fill(
      flow,
      [&](std::size_t i, Recorder& recorder) {
        const Place& s = states[i];
        follow_state(flow, s.x_m, s.y_m, s.heading_rad, most_crossings, recorder);
      },
      go_on);
  return images;
}

VerdictSet verdicts_of(const Image& image, const SectionView& sections) {
  VerdictSet found = image.ends;
  if (image.gave_up) found.add(Verdict::undecided, 0.0);
  for (const ImagePiece& piece : image.pieces) {
    sections.look_up(piece.section, piece.range, static_cast<double>(piece.flown_s), found);
  }
  return found;
}

double least_move(UnitRange hop, UnitRange leaf) {
  if (hop.lo > leaf.lo) return static_cast<double>(hop.lo - leaf.lo);
  if (hop.hi < leaf.hi) return static_cast<double>(leaf.hi - hop.hi);
  return 0.0;
}

}  // namespace fairway
