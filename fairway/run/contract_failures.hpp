// States that are not proved to reach under a contract: where a plan fails whatever its vehicle
// does, where some behaviour fails, and where neither is known.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "fairway/certificate/contract_certificate.hpp"
#include "fairway/plan/plan.hpp"
#include "fairway/run/ask_contract.hpp"
#include "fairway/run/failing_states.hpp"
#include "fairway/simulate/flight.hpp"
#include "fairway/vehicle/vehicle.hpp"

namespace fairway {

/// A state whose verdict under a contract is not `reach`.
struct ContractFailure {
  State start;
  ContractReply reply;  ///< with the behaviour that fails, where the state is at risk
  StartGround ground = StartGround::safe_start;
};

/// Of states sampled from safe starts with a command, then from all ordinary cells: by ground, then
/// collide, leave, trapped, at risk, undecided; at most `of_each` of each on each ground. Cost:
/// some 8,000 queries and searches for a witness.
[[nodiscard]] std::vector<ContractFailure> contract_failures(const ContractCertificate& certificate,
                                                             std::size_t of_each,
                                                             std::uint64_t seed);

/// For `fairway simulate --states`: CSV x_m,y_m,heading_rad,verdict,start, as failing_states_csv.
[[nodiscard]] std::string contract_failures_csv(const std::vector<ContractFailure>& failures);

/// Flights to show, each with a name for the kind of failure it stands for.
struct NamedFlights {
  std::vector<Flight> flights;
  std::vector<std::string> names;
};

/// One of each kind: from the first ground that has any, the longest. From a state that is at risk,
/// its witness; from one that is proved to fail, the flight without any error. `plan`: with the
/// certificate's target as its goal.
[[nodiscard]] NamedFlights failing_flights(const ContractCertificate& certificate, Plan plan,
                                           const std::vector<ContractFailure>& failures);

}  // namespace fairway
