#include "fairway/behaviour/behaviour_choices.hpp"
#include "fairway/behaviour/choices_at.hpp"

namespace fairway {

void ChoicesAt::add_all() {
  if (!options_.empty()) {
    for (const int side : {1, -1}) {
      for (const BehaviourChoices::StepTurn& step : all_.turns_[halved_]) add_turns(side, step);
    }
    add_straight();
  }
  if (choices_.empty()) add_unproved();
}

void ChoicesAt::add_first(const std::array<StepKind, step_kinds>& order) {
  if (!options_.empty()) {
    const std::vector<BehaviourChoices::StepTurn>& turns = all_.turns_[halved_];
    for (const StepKind kind : order) {
      const bool is_wide = kind == StepKind::left_wide || kind == StepKind::right_wide;
      if (kind == StepKind::straight) {
        add_straight();
      } else if (!is_wide || turns.size() > 1) {
        add_turns(kind <= StepKind::left_wide ? 1 : -1, is_wide ? turns.back() : turns.front());
      }
      if (!choices_.empty()) return;
    }
  }
  add_unproved();
}

void BehaviourChoices::list(const BehaviourState& state, BehaviourChoiceList& choices) const {
  choices = BehaviourChoiceList();
  ChoicesAt(*this, state, choices).add_all();
}

void BehaviourChoices::list_first(const BehaviourState& state,
                                  const std::array<StepKind, step_kinds>& order,
                                  BehaviourChoiceList& choices) const {
  choices = BehaviourChoiceList();
  ChoicesAt(*this, state, choices).add_first(order);
}

}  // namespace fairway
