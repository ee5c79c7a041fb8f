#include <algorithm>

#include "fairway/base/error.hpp"
#include "fairway/improve/sampled_flow.hpp"

namespace fairway {

SampledFlow::Trial::Trial(const SampledFlow& flow)
    : flow_(&flow),
      command_(flow.command_),
      seen_(flow.end_.size(), 0),
      slot_(flow.nodes_, 0),
      walked_(flow.nodes_, 0),
      turned_in_(flow.nodes_, 0) {}

ModelChange SampledFlow::Trial::ask(std::span<const CommandChange> changes) {
  for (const CommandChange& change : changes) {
    require(flow_->kind(change.cell) == CellKind::ordinary, "commands change in ordinary cells");
    command_[flow_->place_of(change.cell)] = Direction::of(Heading::from_rad(change.heading_rad));
  }
  fly(changes);
  find_values();
  turned_.clear();
  const std::int64_t reached = count();
  const ModelChange result{reached, count_borders(), count_tears()};
  follow(changes);
  return result;
}

void SampledFlow::Trial::follow(std::span<const CommandChange> applied) {
  for (const CommandChange& change : applied) {
    const std::size_t place = flow_->place_of(change.cell);
    command_[place] = flow_->command_[place];
  }
}

/// Whether this is the first time in this trial that the flight is met; it is then one of `flown_`,
/// with its end to be filled in.
bool SampledFlow::Trial::is_first(Id flight) {
  if (seen_[flight] == trial_) return false;
  seen_[flight] = trial_;
  if (flow_->is_node(flight)) {
    slot_[flight] = static_cast<std::uint32_t>(flown_.size());
    fewest_steps_ = std::min(fewest_steps_, flow_->steps_[flight]);
  }
  flown_.push_back({flight, nowhere, -1});
  return true;
}

void SampledFlow::Trial::begin_trial() {
  flown_.clear();
  fewest_steps_ = never;
  if (++trial_ != 0) return;
  // Numbers begin again, and must not be taken for old ones.
  seen_.assign(seen_.size(), 0);
  turned_in_.assign(turned_in_.size(), 0);
  trial_ = 1;
}

/// Flies again all that meets the changed cells, and what starts on their sides.
void SampledFlow::Trial::fly(std::span<const CommandChange> changes) {
  begin_trial();
  for (const CommandChange& change : changes) {
    const Id first = flow_->first_node(flow_->place_of(change.cell));
    for (Id i = 0; i < 4 * flow_->per_side_; ++i) {
      if (is_first(first + i)) flown_.back().end = flow_->fly(first + i, command_, nullptr);
    }
  }
  if (changes.size() == 1) {
    fly_through(flow_->place_of(changes[0].cell));
    return;
  }
  for (const CommandChange& change : changes) {
    for (const Id flight : flow_->meeting_[flow_->place_of(change.cell)]) {
      if (is_first(flight)) flown_.back().end = flow_->fly(flight, command_, nullptr);
    }
  }
}

/// Flights that meet the cell, on its border: until there they do not depend on its command.
void SampledFlow::Trial::come_to(std::size_t place) {
  if (coming_to_ == place && version_ == flow_->version_) return;
  coming_to_ = place;
  version_ = flow_->version_;
  coming_.clear();
  const Id first = flow_->first_node(place);
  for (const Id flight : flow_->meeting_[place]) {
    if (flight >= first && flight < first + 4 * flow_->per_side_) continue;
    Coming coming{flight, {}, {passing, passing}};
    if (!flow_->take_off(flight, flow_->command_, coming.at)) continue;
    if (flow_->fly_on(coming.at, flow_->command_, nullptr, place) == passing) {
      coming_.push_back(coming);
    }
  }
}

void SampledFlow::Trial::fly_through(std::size_t place) {
  come_to(place);
  const Direction& command = command_[place];
  for (Coming& coming : coming_) {
    if (!is_first(coming.flight)) continue;
    Id& end = flown_.back().end;
    const CellExit exit = cross_cell(coming.at.state, command, flow_->shape_);
    Id* known = exit.path == CellPath::arc ? &coming.end[exit.turn > 0 ? 0 : 1] : nullptr;
    if (known != nullptr && *known != passing) {
      end = *known;
      continue;
    }
    Airborne at = coming.at;
    end = flow_->cross(at, exit, true);
    if (end == passing) end = flow_->fly_on(at, command_, nullptr, place);
    if (end == passing) {  // comes back, and depends on the command once more
      end = flow_->fly_on(at, command_, nullptr, 0);
    } else if (known != nullptr) {
      *known = end;
    }
  }
}

/// Whether what ends at `end` reaches, with the changes. A node whose steps are no more than those
/// of every node flown again leads to none of them: each step onwards is one fewer.
bool SampledFlow::Trial::value_of(Id end) {
  path_.clear();
  if (++walk_ == 0) {
    walked_.assign(walked_.size(), 0);
    walk_ = 1;
  }
  bool value = false;
  for (Id id = end;;) {
    if (!flow_->is_node(id)) {
      value = id == reaches;
      break;
    }
    const bool flown = seen_[id] == trial_;
    if (flown && flown_[slot_[id]].value >= 0) {
      value = flown_[slot_[id]].value != 0;
      break;
    }
    const std::uint32_t steps = flow_->steps_[id];
    if (!flown && steps != never && steps <= fewest_steps_) {
      value = flow_->value_[id] != 0;
      break;
    }
    if (walked_[id] == walk_) break;  // a loop
    walked_[id] = walk_;
    if (flown) path_.push_back(id);
    id = flown ? flown_[slot_[id]].end : flow_->end_[id];
  }
  for (const Id node : path_) flown_[slot_[node]].value = value ? 1 : 0;
  return value;
}

void SampledFlow::Trial::find_values() {
  for (const Flown& flown : flown_) {
    if (flow_->is_node(flown.flight)) value_of(flown.flight);
  }
}

/// How many starts lead to this node, and to nodes that were not flown again before it.
std::int64_t SampledFlow::Trial::count_upstream(Id node) {
  std::int64_t count = 0;
  pending_.assign(1, node);
  while (!pending_.empty()) {
    const Id here = pending_.back();
    pending_.pop_back();
    turned_.push_back(here);
    turned_in_[here] = trial_;
    count += flow_->direct_[here];
    for (Id n = flow_->first_before_[here]; n != nowhere; n = flow_->next_before_[n]) {
      if (seen_[n] != trial_) pending_.push_back(n);
    }
  }
  return count;
}

std::int64_t SampledFlow::Trial::count() {
  std::int64_t gain = 0;
  for (std::size_t i = 0; i < flown_.size(); ++i) {
    const Flown flown = flown_[i];
    if (flow_->is_node(flown.flight)) {
      const bool was = flow_->value_[flown.flight] != 0;
      const bool is = flown.value != 0;
      if (was != is) gain += (is ? 1 : -1) * count_upstream(flown.flight);
    } else if (const Id end = flow_->end_[flown.flight]; end != flown.end) {
      // Through the node where it ended before, it has been counted with that node.
      gain += (value_of(flown.end) ? 1 : 0) - (value_of(end) ? 1 : 0);
    }
  }
  return gain;
}

std::int64_t SampledFlow::Trial::count_borders() const {
  std::int64_t gain = 0;
  const auto look = [&](Id a, Id b) {
    if (turned_in_[b] != trial_) gain += flow_->value_[a] == flow_->value_[b] ? 1 : -1;
  };
  for (const Id node : turned_) {
    const Id number = node % flow_->per_side_;
    if (number > 0) look(node, node - 1);
    if (number + 1 < flow_->per_side_) look(node, node + 1);
  }
  return gain;
}

std::int64_t SampledFlow::Trial::count_tears() const {
  std::int64_t gain = 0;
  const auto look = [&](const Flown& flown, Id b, bool higher) {
    const bool again = seen_[b] == trial_;
    if (again && higher) return;  // counted with the other one
    const Id was = flow_->end_[b];
    const Id is = again ? flown_[slot_[b]].end : was;
    gain += flow_->torn(flown.end, is) - flow_->torn(flow_->end_[flown.flight], was);
  };
  for (const Flown& flown : flown_) {
    if (!flow_->is_node(flown.flight)) continue;
    const Id number = flown.flight % flow_->per_side_;
    if (number > 0) look(flown, flown.flight - 1, false);
    if (number + 1 < flow_->per_side_) look(flown, flown.flight + 1, true);
  }
  return gain;
}

}  // namespace fairway
