#include "fairway/improve/sampled_flow.hpp"

#include <algorithm>
#include <cmath>

#include "fairway/base/error.hpp"

namespace fairway {

namespace {

Direction direction_of(float heading_rad) {
  if (std::isnan(heading_rad)) return Direction::none();
  return Direction::of(Heading::from_rad(heading_rad));
}

}  // namespace

SampledFlow::SampledFlow(const Flow& flow, const SampledFlowOptions& options)
    : nx_(flow.grid.nx),
      stride_(static_cast<std::size_t>(flow.grid.nx) + 2),
      shape_(flow.shape()),
      per_side_(static_cast<std::uint32_t>(options.nodes_per_side)),
      per_cell_(static_cast<std::uint32_t>(options.starts_per_cell)),
      most_crossings_(options.most_crossings),
      reaches_aligned_(options.reaches_aligned),
      heading_rad_(flow.heading_rad, flow.heading_rad + flow.grid.size()) {
  require(options.nodes_per_side > 0 && options.starts_per_cell > 0 && options.most_crossings > 0,
          "samples are positive numbers");
  require(shape_.cell_m < shape_.turn_radius_m, "the cell is smaller than the turning radius");
  const std::size_t places = stride_ * (static_cast<std::size_t>(flow.grid.ny) + 2);
  require(places <= most_cells(options), "there are fewer than 2^32 sampled flights");
  const std::size_t flights = places * (4 * std::size_t{per_side_} + per_cell_);
  nodes_ = static_cast<Id>(places * 4 * per_side_);
  command_.assign(places, Direction::none());
  kind_.assign(places, CellKind::outside);
  for (std::size_t cell = 0; cell < flow.grid.size(); ++cell) {
    command_[place_of(cell)] = direction_of(heading_rad_[cell]);
    kind_[place_of(cell)] = flow.kind[cell];
    if (flow.kind[cell] == CellKind::ordinary) starts_ += per_cell_;
  }
  meeting_.resize(places);
  tidy_at_.assign(places, 0);
  end_.assign(flights, nowhere);
  value_.assign(nodes_, 0);
  steps_.assign(nodes_, never);
  direct_.assign(nodes_, 0);
  first_before_.assign(nodes_, nowhere);
  next_before_.assign(nodes_, nowhere);
  previous_before_.assign(nodes_, nowhere);

  std::vector<std::uint32_t> met;
  for (std::size_t place = 0; place < places; ++place) {
    if (kind_[place] != CellKind::ordinary) continue;
    const auto fly_first = [&](Id flight) {
      met.clear();
      end_[flight] = fly(flight, command_, &met);
      remember(flight, met);
      if (is_node(flight)) {
        link(flight, end_[flight]);
      } else if (is_node(end_[flight])) {
        ++direct_[end_[flight]];
      }
    };
    for (Id i = 0; i < 4 * per_side_; ++i) fly_first(first_node(place) + i);
    for (Id i = 0; i < per_cell_; ++i) fly_first(static_cast<Id>(nodes_ + place * per_cell_ + i));
  }
  for (std::size_t place = 0; place < places; ++place) {
    tidy_at_[place] = static_cast<std::uint32_t>(2 * meeting_[place].size() + 64);
  }
  std::vector<Id> all(nodes_);
  for (Id node = 0; node < nodes_; ++node) all[node] = node;
  renew_values(all);
  for (std::size_t flight = nodes_; flight < end_.size(); ++flight) {
    const Id end = end_[flight];
    if (end == reaches || (is_node(end) && value_[end] != 0)) ++reached_;
  }
  for (Id node = 0; node + 1 < nodes_; ++node) {
    const bool same_side = node % per_side_ + 1 < per_side_;
    if (same_side && value_[node] != value_[node + 1]) ++borders_;
    if (same_side && torn(end_[node], end_[node + 1])) ++tears_;
  }
  own_trial_ = std::make_unique<Trial>(*this);
}

void SampledFlow::remember(Id flight, std::span<const std::uint32_t> met) {
  for (std::size_t i = 0; i < met.size(); ++i) {
    const bool again = std::find(met.begin(), met.begin() + static_cast<std::ptrdiff_t>(i),
                                 met[i]) != met.begin() + static_cast<std::ptrdiff_t>(i);
    if (again) continue;
    std::vector<Id>& here = meeting_[met[i]];
    here.push_back(flight);
    if (tidy_at_[met[i]] == 0 || here.size() < tidy_at_[met[i]]) continue;
    std::sort(here.begin(), here.end());
    here.erase(std::unique(here.begin(), here.end()), here.end());
    tidy_at_[met[i]] = static_cast<std::uint32_t>(2 * here.size() + 64);
  }
}

void SampledFlow::link(Id node, Id end) {
  end_[node] = end;
  if (!is_node(end)) return;
  previous_before_[node] = nowhere;
  next_before_[node] = first_before_[end];
  if (first_before_[end] != nowhere) previous_before_[first_before_[end]] = node;
  first_before_[end] = node;
}

void SampledFlow::unlink(Id node) {
  const Id end = end_[node];
  if (!is_node(end)) return;
  const Id next = next_before_[node];
  const Id previous = previous_before_[node];
  (previous == nowhere ? first_before_[end] : next_before_[previous]) = next;
  if (next != nowhere) previous_before_[next] = previous;
}

std::size_t SampledFlow::most_cells(const SampledFlowOptions& options) {
  const auto flights =
      4 * std::size_t(options.nodes_per_side) + std::size_t(options.starts_per_cell);
  return passing / flights;  // the numbers above it mean something else
}

/// Values and steps of these nodes and of all before them, from the links as they are now.
void SampledFlow::renew_values(std::span<const Id> changed) {
  static constexpr std::uint32_t unknown = never - 1;
  std::vector<Id> waiting(changed.begin(), changed.end());
  std::vector<Id> before;
  while (!waiting.empty()) {
    const Id node = waiting.back();
    waiting.pop_back();
    if (steps_[node] == unknown) continue;
    steps_[node] = unknown;
    before.push_back(node);
    for (Id n = first_before_[node]; n != nowhere; n = next_before_[n]) waiting.push_back(n);
  }
  std::vector<Id> path;
  static constexpr std::uint32_t on_path = never - 2;
  for (const Id start : before) {
    path.clear();
    Id node = start;
    while (is_node(node) && steps_[node] == unknown) {
      steps_[node] = on_path;
      path.push_back(node);
      node = end_[node];
    }
    std::uint32_t steps = 0;
    std::uint8_t value = node == reaches ? 1 : 0;
    if (is_node(node)) {
      steps = steps_[node] == on_path ? never : steps_[node];
      value = steps == never ? 0 : value_[node];
    }
    for (; !path.empty(); path.pop_back()) {
      steps = steps == never ? never : steps + 1;
      steps_[path.back()] = steps;
      value_[path.back()] = value;
    }
  }
}

std::size_t SampledFlow::failing_near(std::size_t cell) const {
  std::size_t failing = 0;
  for (const Id flight : meeting_[place_of(cell)]) {
    if (is_node(flight)) continue;
    const Id end = end_[flight];
    if (end == fails || (is_node(end) && value_[end] == 0)) ++failing;
  }
  return failing;
}

bool SampledFlow::torn(Id a, Id b) const {
  if (!is_node(a) || !is_node(b)) return false;
  const auto at = [&](Id node) {
    const std::size_t place = node / (4 * per_side_);
    const Id number = node % (4 * per_side_);
    const auto side = static_cast<Side>(number / per_side_);
    const double along = (number % per_side_ + 0.5) / per_side_;
    const Vec2 corner{static_cast<double>(place % stride_), static_cast<double>(place / stride_)};
    switch (side) {
      case Side::right:
        return corner + Vec2{1.0, along};
      case Side::top:
        return corner + Vec2{along, 1.0};
      case Side::left:
        return corner + Vec2{0.0, along};
      default:
        return corner + Vec2{along, 0.0};
    }
  };
  return norm2(at(a) - at(b)) > 0.3 * 0.3;
}

void SampledFlow::apply(std::span<const CommandChange> changes) {
  Trial& trial = *own_trial_;
  const ModelChange gain = trial.ask(changes);
  for (const CommandChange& change : changes) {
    heading_rad_[change.cell] = change.heading_rad;
    command_[place_of(change.cell)] = direction_of(change.heading_rad);
  }
  trial.follow(changes);
  ++version_;
  std::vector<std::uint32_t> met;
  std::vector<Id> changed;
  for (const Trial::Flown& flown : trial.flown_) {
    met.clear();
    const Id end = fly(flown.flight, command_, &met);
    remember(flown.flight, met);
    if (is_node(flown.flight)) {
      unlink(flown.flight);
      link(flown.flight, end);
      changed.push_back(flown.flight);
    } else {
      if (is_node(end_[flown.flight])) --direct_[end_[flown.flight]];
      if (is_node(end)) ++direct_[end];
      end_[flown.flight] = end;
    }
  }
  renew_values(changed);
  reached_ += gain.reached;
  borders_ += gain.borders;
  tears_ += gain.tears;
}

}  // namespace fairway
