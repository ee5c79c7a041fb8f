#include "bench/ompl.hpp"

#include <ompl/base/ScopedState.h>
#include <ompl/base/spaces/DubinsStateSpace.h>

#include <vector>

namespace fairway::bench {

struct Ompl::Poses {
  using Pose = ompl::base::SE2StateSpace::StateType;

  explicit Poses(double turn_radius_m) : space(turn_radius_m) {}
  ~Poses() {
    for (Pose* pose : from) space.freeState(pose);
    for (Pose* pose : to) space.freeState(pose);
  }
  Poses(const Poses&) = delete;
  Poses& operator=(const Poses&) = delete;

  Pose* pose_of(const State& state) {
    auto* pose = space.allocState()->as<Pose>();
    pose->setXY(state.position_m.x, state.position_m.y);
    pose->setYaw(state.heading.rad());
    return pose;
  }

  ompl::base::DubinsStateSpace space;
  std::vector<Pose*> from;
  std::vector<Pose*> to;
};

Ompl::Ompl(std::span<const State> from, std::span<const State> to, double turn_radius_m)
    : poses_(std::make_unique<Poses>(turn_radius_m)) {
  for (const State& state : from) poses_->from.push_back(poses_->pose_of(state));
  for (const State& state : to) poses_->to.push_back(poses_->pose_of(state));
}
Ompl::~Ompl() = default;
bool Ompl::is_there() { return true; }
void Ompl::distances(std::span<double> length_m) const {
  for (std::size_t i = 0; i < length_m.size(); ++i) {
    length_m[i] = poses_->space.distance(poses_->from[i], poses_->to[i]);
  }
}

}  // namespace fairway::bench
