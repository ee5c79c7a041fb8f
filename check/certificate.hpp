// A certificate as its file claims it to be (docs/formats.md, "Certificate").
#pragma once

#include <array>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "check/flight.hpp"
#include "check/tensors.hpp"

namespace fairway_check {

/// The certificate is not good: the reason.
struct Refused : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Shares of the volume by verdict, as claimed; all 0 when there is no such cell.
using Shares = std::array<double, verdict_count>;

struct Certificate {
  double x0_m = 0.0;
  double y0_m = 0.0;
  double cell_m = 0.0;
  double turn_radius_m = 0.0;
  double speed_mps = 0.0;
  std::vector<float> command_rad;     ///< [iy][ix]
  std::vector<std::int8_t> region;    ///< [iy][ix]
  std::vector<std::uint8_t> kind;     ///< [iy][ix]
  std::vector<std::uint32_t> first;   ///< [4 cells + 1]
  std::vector<std::uint32_t> begin;   ///< [leaves]
  std::vector<std::uint32_t> rank;    ///< [leaves]
  std::vector<float> time_s;          ///< [leaves]
  std::vector<std::uint8_t> verdict;  ///< [leaves]
  Shares all{};
  Shares free{};
  Shares buffer{};
  double samples = 0.0;
  double worst_time_s = 0.0;
  Loop loop;  ///< looks into the arrays above: a certificate is not copied

  Certificate() = default;
  Certificate(const Certificate&) = delete;
  Certificate& operator=(const Certificate&) = delete;

  std::size_t cells() const { return region.size(); }
  /// Where a leaf ends, in units of a side / 2^32; the last one at the side's end.
  double end_of(std::size_t section, std::size_t leaf) const {
    return leaf + 1 < first[section + 1] ? begin[leaf + 1] : 0x1p32;
  }
  /// "leaf 3 on the top side of cell (4, 5)".
  std::string name_of(std::size_t section, std::size_t leaf) const;
};

/// Reads what is there, with digests compared. Throws Malformed when the file is no certificate,
/// Refused when it is one and its digests, geometry, commands, regions or claims are wrong.
void read_certificate(const std::string& path, Certificate& certificate);

/// Throws Refused unless a section has leaves exactly where it must, in order, with verdicts, ranks
/// and times that can be. `certificate.loop.direction` must be there.
void require_good_leaves(const Certificate& certificate);

/// Throws Refused unless the plan in `path` is the certificate's, by geometry and digests.
void require_plan(const std::string& path, const std::string& certificate_path);

}  // namespace fairway_check
