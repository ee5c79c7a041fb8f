// For the vehicle under a contract: what is proved at any state, from a contract certificate mapped
// into memory. The sister of runtime::Certificate (fairway/runtime.hpp), which answers for the
// exact vehicle; commands come from a runtime::CommandField either way.
//
//     fairway::runtime::ContractCertificate certificate;
//     if (certificate.open(bytes, size) != fairway::runtime::Status::ok) ...
//     const fairway::runtime::Answer answer = certificate.query(x_m, y_m, heading_rad);
//
// It needs more than runtime.hpp does. A state under a contract is flown as sets of places, and
// sets may be many: so this is not a header alone, but part of the library `fairway` (CMake:
// fairway::fairway). open() takes 65 bytes a part of a cell, at most 256 parts a cell
// (docs/formats.md, "Contract certificate"), and a few bytes a cell while it works; a query of a
// state on the very border of two parts takes some kilobytes and gives them back. Neither throws:
// where memory runs out, open() says no_memory, and query() undecided.
//
// open() checks what that of runtime::Certificate checks, and the contract; it neither checks
// digests nor proves anything: `fairway check` does, once, on the ground. Properties that always
// hold:
//   1. A verdict other than undecided is that of every behaviour within the contract that starts in
//      the state without a side held (docs/trust.md), provided that `fairway check` accepts the
//      certificate: what `fairway query` answers (inclusion/quick_lookup.hpp). What was asked
//      before changes no answer.
//   2. A state that is not finite is undecided; outside the grid it is `leave`. What a query calls
//      at_risk, after a search for a behaviour that fails, is undecided here.
// Cost: one to two microseconds (docs/benchmarks.md). Safe to query from several threads at once.
#pragma once

#include <cstddef>
#include <memory>

#include "fairway/runtime.hpp"
#include "fairway/vehicle/contract.hpp"

namespace fairway::runtime {

class ContractCertificate {
 public:
  ContractCertificate() noexcept;
  ~ContractCertificate();
  ContractCertificate(ContractCertificate&& other) noexcept;
  ContractCertificate& operator=(ContractCertificate&& other) noexcept;

  /// `bytes`: the whole file, aligned to 8 bytes, which must outlive this object.
  Status open(const void* bytes, std::size_t size) noexcept;

  /// The verdict of a state: metres, radians. Undecided before open() said ok.
  Answer query(double x_m, double y_m, double heading_rad) const noexcept;

  /// What the vehicle has to keep for the answers to hold; null before open() said ok.
  const VehicleContract* contract() const noexcept;
  /// Its commands, for a CommandField; null before open() said ok.
  const Flow* flow() const noexcept;

 private:
  struct Opened;
  std::unique_ptr<Opened> opened_;
};

}  // namespace fairway::runtime
