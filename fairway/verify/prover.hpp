// The proof of the section: which leaves are examined, decided and cut, round by round, until no
// round changes anything.
//
// reach, collide and leave are least fixpoints: in round k a leaf is proved when its whole image
// lies in leaves proved with one verdict before round k (or ends so). trapped is a greatest one:
// the largest set of leaves whose images lie in the set again (fixpoints.hpp). A leaf is cut only
// where that may help: when its image meets something decided, or itself, or is unknown; one whose
// image lies only on undecided leaves waits for them.
//
// Properties that always hold: those of section_verdicts.hpp; and the result does not depend on the
// number of threads (a round reads only what earlier rounds wrote).
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "fairway/verify/fixpoints.hpp"
#include "fairway/verify/hand_over.hpp"
#include "fairway/verify/leaf_graph.hpp"
#include "fairway/verify/section_verdicts.hpp"
#include "fairway/verify/ways_out.hpp"

namespace fairway {

class Prover {
 public:
  /// Keeps references to the arrays that `flow` points to. `start`: the leaves as known so far.
  /// `earlier`: modes that leaves may be handed over to; they must outlive this object.
  Prover(const Flow& flow, const SectionVerdicts& start, int most_crossings,
         std::function<bool()> go_on, LeafGraph::Keep keep = LeafGraph::Keep::links_of_open_leaves,
         std::span<const ModeView> earlier = {});

  /// Runs rounds until nothing changes, with no leaf narrower than `least_units`. False: stopped.
  bool settle(double least_units);

  /// The commands or meanings of some cells were changed in the arrays of the flow: everything that
  /// may depend on them is undecided until `settle` is called again. Needs Keep::all_links.
  void invalidate(const std::vector<bool>& changed_cells);

  const LeafGraph& graph() const { return graph_; }
  /// The leaves, when the work is done: frees everything else first.
  SectionVerdicts into_sections() {
    waiting_ = {};
    ways_out_ = {};
    worth_asking_ = std::vector<ModeSet>();
    return graph_.into_sections();
  }

  /// Adds the verdicts of the leaves that touch `range`.
  void look_up(std::size_t section, UnitRange range, double flown_s, VerdictSet& found) const;

  std::size_t bytes() const {
    return graph_.bytes() + waiting_.bytes() + ways_out_.bytes() +
           worth_asking_.capacity() * sizeof(ModeSet);
  }

 private:
  using Id = LeafGraph::Id;
  /// What an image has led to. A round may have millions of these.
  struct Finding {
    float time_s = 0.0F;    ///< upper bound
    std::uint8_t bits = 0;  ///< verdicts found, as in VerdictSet
    bool cut = false;

    Verdict only() const { return VerdictSet{bits, 0.0}.only(); }
    bool decides() const;
  };

  void fly(std::span<const Id> ids);
  void fly_some(std::span<const Id> ids);
  std::vector<Id> not_handed_over(std::span<const Id> ids);
  bool is_worth_cutting(Id id) const;
  Finding examine(Id id, double least_units) const;
  void conclude(const std::vector<Id>& round, const std::vector<Finding>& findings);
  void keep_waiting(Id id, const Finding& finding);
  void cut(std::span<const Id> ids);
  void wake_dependents(Id id);
  void forget_ways_over(Id id);
  void prove_trapped();
  template <typename IsNew>
  bool hopeless_lead_to(const IsNew& is_new) const;

  Flow flow_;
  int most_crossings_;
  std::function<bool()> go_on_;
  std::span<const ModeView> earlier_;
  LeafGraph graph_;
  std::vector<ModeSet> worth_asking_;  // [id] or shorter: every mode
  Worklist waiting_;
  WaysOut ways_out_;  // to find those that are trapped
  std::uint32_t rank_ = 0;
  bool may_give_up_hope_;
  bool last_round_decided_ = false;
  bool is_new_since_trapped_ = true;  // an image
};

}  // namespace fairway
