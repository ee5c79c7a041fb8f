// For the vehicle under a contract: what is proved at any state, from a contract certificate mapped
// into memory. The sister of runtime::Certificate (fairway/runtime.hpp), which answers for the
// exact vehicle; commands come from a runtime::CommandField either way.
//
//     fairway::runtime::ContractCertificate certificate;
//     if (certificate.open(bytes, size) != fairway::runtime::Status::ok) ...
//     const fairway::runtime::Answer answer = certificate.query(x_m, y_m, heading_rad);
//
// A ContractPilot (fairway/contract_pilot.hpp) keeps what there is to keep on the way: the side of
// a turn, the mode of a plan with modes, and until when the vehicle will have reached.
//
// It needs more than runtime.hpp does. A state under a contract is flown as sets of places, which
// take memory, and sets may be many: so this is not a header alone, but part of the library
// `fairway` (CMake: fairway::fairway). open() takes 65 bytes a part of a cell and mode, at most 256
// parts a cell (docs/formats.md, "Contract certificate"), and a few bytes a cell while it works; a
// query that flies at length takes some kilobytes and gives them back. Neither throws: where memory
// runs out, open() says no_memory, and query() undecided.
//
// open() checks what that of runtime::Certificate checks, and the contract; it neither checks
// digests nor proves anything: `fairway check` does, once, on the ground. Properties that always
// hold:
//   1. A verdict other than undecided is that of every behaviour within the contract that starts in
//      the state without a side held (docs/trust.md), provided that `fairway check` accepts the
//      certificate: what `fairway query` answers.
//   2. A state that is not finite is undecided; outside the grid it is `leave`. What a query calls
//      at_risk, after a search for a behaviour that fails, is undecided here.
// Cost (docs/benchmarks.md): a microsecond or two. Safe to query from several threads at once.
#pragma once

#include <cstddef>
#include <memory>

#include "fairway/runtime.hpp"
#include "fairway/vehicle/contract.hpp"

namespace fairway {
struct ContractCertificate;  // certificate/contract_certificate.hpp
}

namespace fairway::runtime {

class ContractCertificate {
 public:
  ContractCertificate() noexcept;
  ~ContractCertificate();
  ContractCertificate(ContractCertificate&& other) noexcept;
  ContractCertificate& operator=(ContractCertificate&& other) noexcept;

  /// `bytes`: the whole file, aligned to 8 bytes, which must outlive this object.
  Status open(const void* bytes, std::size_t size) noexcept;
  /// The same for a certificate already read, which must outlive this object. Throws
  /// std::bad_alloc.
  void look_into(const fairway::ContractCertificate& certificate);

  /// The verdict of a state: metres, radians. Undecided before open() said ok. Of a plan with
  /// modes: reach by the first that is proved to, which is named; else the verdict of mode 0.
  Answer query(double x_m, double y_m, double heading_rad) const noexcept;

  /// Its modes: 1, unless the plan has further ones; 0 before open() said ok.
  int modes() const noexcept;

  /// Of all states within the vehicle's error of the one that it takes itself to be in (at most
  /// command_error_m and heading_error_rad off, no side held): whether every behaviour reaches
  /// under `mode`, and by when. Undecided otherwise.
  Answer query_around(int mode, double x_m, double y_m, double heading_rad) const noexcept;

  /// To which mode a vehicle in `mode` may change from where it takes itself to be, as the proof
  /// hands over near there: with the least bound of time, if that is at most `in_time_s`. Undecided
  /// where there is none.
  Answer hand_over(int mode, double x_m, double y_m, double heading_rad,
                   double in_time_s) const noexcept;

  /// What the vehicle has to keep for the answers to hold; null before open() said ok.
  const VehicleContract* contract() const noexcept;
  /// Its commands, for a CommandField; null before open() said ok.
  const Flow* flow() const noexcept;
  /// Commands of a mode, [iy][ix]; null where there is no such mode.
  const float* heading_rad(int mode) const noexcept;

 private:
  struct Opened;
  std::unique_ptr<Opened> opened_;
};

}  // namespace fairway::runtime
