// What is known of states under a plan: its certificates' answers, or what flights were seen to do.
#pragma once

#include <span>
#include <vector>

#include "fairway/compare/compared_plan.hpp"
#include "fairway/run/flight_costs.hpp"
#include "fairway/vehicle/vehicle.hpp"
#include "fairway/verify/verdict.hpp"

namespace fairway {

/// Does what the mission asks for.
constexpr bool is_kept(Verdict verdict) {
  return verdict == Verdict::reach || verdict == Verdict::follow;
}

/// Of the exact vehicle, [state]: of the certificate.
[[nodiscard]] std::vector<Verdict> verdicts_of(const Certificate& certificate,
                                               std::span<const State> states);

/// Whatever the vehicle does within the contract, [state]; undecided states may be at risk.
[[nodiscard]] std::vector<Verdict> verdicts_of(const ContractCertificate& certificate,
                                               std::span<const State> states);

/// Of exact flights, as the word for it would be if it were proved, [state]: a flight that circles
/// in a holding place holds; one that is to follow a loop, and collides after it has touched it,
/// collides.
[[nodiscard]] std::vector<Verdict> seen_in(const MeasuredFlights& flown, const Plan& plan,
                                           std::span<const State> states);
/// The same, flown for nothing else.
[[nodiscard]] std::vector<Verdict> seen_from(std::span<const State> states, const Plan& plan);

}  // namespace fairway
