// The section under proof: leaves that are proved or cut in halves, round by round, until no round
// changes anything.
//
// reach, collide and leave are least fixpoints: in round k a leaf is proved when its whole image
// lies in leaves proved with one verdict before round k (or ends so). trapped is a greatest one:
// the largest set of leaves whose images lie in the set again. A leaf is cut only where that may
// help: when its image meets something decided, or itself, or could not be told; one whose image
// lies on undecided leaves alone waits for them.
//
// Properties that always hold: those of section_verdicts.hpp; and the answer does not depend on the
// number of threads (a round reads what the rounds before it wrote).
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "fairway/verify/images.hpp"
#include "fairway/verify/section_verdicts.hpp"

namespace fairway {

class Prover {
 public:
  /// Keeps a reference to nothing but what `flow` looks at. `start`: leaves as they are known.
  Prover(const Flow& flow, const SectionVerdicts& start, int most_crossings,
         std::function<bool()> go_on);

  /// Rounds until nothing changes, with no leaf narrower than `least_units`. False: stopped.
  bool settle(double least_units);

  /// The leaves as they are now, in order.
  [[nodiscard]] SectionVerdicts sections() const;

  /// Adds what the leaves that `range` touches say.
  void look_up(std::size_t section, UnitRange range, double flown_s, VerdictSet& found) const;

  std::size_t leaves() const { return leaf_count_; }
  std::size_t undecided() const;
  std::size_t bytes() const;
  /// Whether some undecided leaf is wide enough to be cut again.
  bool can_refine(double least_units) const;

 private:
  using Id = std::uint32_t;
  struct Leaf {
    LeafPlace place;
    std::uint32_t rank = 0;
    float time_s = 0.0F;
    Verdict verdict = Verdict::undecided;
    bool cut = false;    // replaced by its halves
    bool flown = false;  // its image is known
    bool gave_up = false;
    VerdictSet ends;
    std::size_t first_piece = 0;
    std::uint32_t pieces = 0;
  };
  struct Dependent {
    Id leaf;
    UnitRange range;
  };
  struct Finding {
    VerdictSet found;
    bool cut = false;
  };

  template <typename Body>
  void for_leaves(std::size_t section, UnitRange range, const Body& body) const;
  std::span<const ImagePiece> pieces_of(const Leaf& leaf) const;
  void fly(const std::vector<Id>& ids);
  VerdictSet verdicts_of(Id id) const;
  bool is_worth_cutting(const Leaf& leaf, Id id) const;
  Finding examine(Id id, double least_units) const;
  void wake_dependents(const Leaf& leaf);
  void wake(Id id);
  void cut(Id id, std::vector<Id>& halves);
  void prove_trapped();

  const Flow& flow_;
  int most_crossings_;
  std::function<bool()> go_on_;
  std::vector<Leaf> leaf_;
  std::vector<ImagePiece> piece_;
  std::vector<std::vector<Id>> on_section_;         // in order of their begins
  std::vector<std::vector<Dependent>> dependents_;  // of a section
  std::vector<Id> awake_;
  std::vector<std::uint8_t> is_awake_;
  std::size_t leaf_count_ = 0;
  std::uint32_t rank_ = 0;
};

}  // namespace fairway
