#include "fairway/run/contract_resume.hpp"

#include <algorithm>
#include <bit>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "fairway/base/error.hpp"
#include "fairway/vehicle/contract_json.hpp"

namespace fairway {
namespace {

/// "command_error_m is 6.0 there and 5.0 now, ...".
std::string contract_difference(const VehicleContract& earlier, const VehicleContract& now) {
  const nlohmann::json there = json_of(earlier);
  const nlohmann::json here = json_of(now);
  std::string words;
  for (const auto& [key, value] : here.items()) {
    if (there[key] == value) continue;
    words += fmt::format("{}{} is {} there and {} now", words.empty() ? "" : ", ", key,
                         there[key].dump(), value.dump());
  }
  return words;
}

/// Of the plan's arrays.
std::string plan_difference(const ContractCertificate& earlier, const ContractCertificate& now) {
  const Grid& a = earlier.grid;
  const Grid& b = now.grid;
  if (a.nx != b.nx || a.ny != b.ny) {
    return fmt::format("is of a different plan, of {} x {} cells, not {} x {}", a.nx, a.ny, b.nx,
                       b.ny);
  }
  if (a.x0_m != b.x0_m || a.y0_m != b.y0_m || a.cell_m != b.cell_m) {
    return "is of a different plan: its grid lies elsewhere, or has cells of another size";
  }
  if (earlier.plan.region != now.plan.region) return "is of a different plan: its regions differ";
  if (earlier.plan.heading_rad != now.plan.heading_rad) {
    return "is of a different plan: its commands differ";
  }
  if (earlier.plan.cost_m != now.plan.cost_m) return "is of a different plan: its costs differ";
  if (earlier.vehicle != now.vehicle) {
    return fmt::format("is of another vehicle, of turning radius {:g} m and {:g} m/s",
                       earlier.vehicle.turn_radius_m, earlier.vehicle.speed_mps);
  }
  if (earlier.frame.value_or(Frame{}) != now.frame.value_or(Frame{})) {
    return "is of a plan that lies elsewhere: its frame differs";
  }
  return {};
}

/// Whether [begin, end) of a section has this verdict all over; end 0 is the side's end.
bool is_all(const ContractVerdicts& v, std::size_t section, std::uint32_t begin, std::uint32_t end,
            std::uint8_t verdict) {
  const auto first = v.begin.begin() + v.first[section];
  const auto last = v.begin.begin() + v.first[section + 1];
  auto at = std::upper_bound(first, last, begin);
  if (at == first) return false;
  for (--at; at != last && (end == 0 || *at < end); ++at) {
    if (v.verdict[static_cast<std::size_t>(at - v.begin.begin())] != verdict) return false;
  }
  return true;
}

}  // namespace

std::string difference(const ContractCertificate& earlier, const ContractCertificate& now) {
  if (std::string of_plan = plan_difference(earlier, now); !of_plan.empty()) return of_plan;
  if (earlier.follow.has_value() != now.follow.has_value()) {
    return earlier.follow ? "proves that a path is followed, which is not asked now"
                          : "does not prove that the path is followed, as is asked now";
  }
  if (earlier.follow && earlier.follow->path.vertices_m != now.follow->path.vertices_m) {
    return "is of following another line";
  }
  if (earlier.kind != now.kind) return "is about another region of interest (--region)";
  if (earlier.contract != now.contract) {
    return "is of another contract: " + contract_difference(earlier.contract, now.contract);
  }
  if (earlier.parts_per_cell != now.parts_per_cell) {
    return fmt::format("was proved with --parts {}, not {}", earlier.parts_per_cell,
                       now.parts_per_cell);
  }
  return {};
}

void require_same_proof(const EarlierContractProof& earlier, const ContractCertificate& now) {
  const std::string other = difference(earlier.certificate, now);
  if (!other.empty()) {
    throw InputError(earlier.where, other + "; cannot resume from it");
  }
}

int finest_level(const ContractVerdicts& v) {
  std::uint32_t shortest = ~std::uint32_t{0};  // less one, so that a whole side fits
  for (std::size_t s = 0; s + 1 < v.first.size(); ++s) {
    for (std::size_t k = v.first[s]; k < v.first[s + 1]; ++k) {
      const std::uint32_t end = k + 1 < v.first[s + 1] ? v.begin[k + 1] : 0U;
      shortest = std::min(shortest, end - v.begin[k] - 1U);
    }
  }
  return std::countl_zero(shortest);
}

Resumed taken_over(const EarlierContractProof& earlier, const ContractVerdicts& now, bool in_time) {
  const ContractVerdicts& v = earlier.certificate.verdicts;
  Resumed resumed;
  resumed.from = earlier.where;
  for (std::size_t s = 0; s + 1 < v.first.size(); ++s) {
    for (std::size_t k = v.first[s]; k < v.first[s + 1]; ++k) {
      if (v.verdict[k] == 0) continue;
      ++resumed.decided;
      const std::uint32_t end = k + 1 < v.first[s + 1] ? v.begin[k + 1] : 0;
      resumed.dropped += is_all(now, s, v.begin[k], end, v.verdict[k]) ? 0 : 1;
    }
  }
  resumed.in_time = resumed.dropped == 0 || in_time;
  return resumed;
}

}  // namespace fairway
