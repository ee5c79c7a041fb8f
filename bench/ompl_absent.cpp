#include "bench/ompl.hpp"

namespace fairway::bench {

struct Ompl::Poses {};

Ompl::Ompl(std::span<const State>, std::span<const State>, double) {}
Ompl::~Ompl() = default;
bool Ompl::is_there() { return false; }
void Ompl::distances(std::span<double>) const {}

}  // namespace fairway::bench
