// For the vehicle: what to steer, and what is proved, at any state. Reads a certificate file
// mapped into memory (docs/formats.md).
//
// No exceptions, only the standard library; safe to call from several threads at once (a TurnSide
// belongs to one). No heap, but for what a CommandField takes when it is made.
//
//     fairway::runtime::Certificate certificate;
//     if (certificate.open(bytes, size) != fairway::runtime::Status::ok) ...
//     const fairway::runtime::Answer answer = certificate.query(x_m, y_m, heading_rad);
//
// A vehicle under a contract takes its commands from a CommandField, ahead of itself by the
// contract's look_ahead_m, and hands them on through a TurnSide (docs/howto/vehicle.md):
//
//     const fairway::runtime::CommandField commands(flow.grid, flow.heading_rad);
//     fairway::runtime::TurnSide side;
//
// What is proved under a contract, from a contract certificate, is for a class of its own to
// answer, which takes memory and is part of the library: ContractCertificate,
// fairway/contract_runtime.hpp. A contract certificate is not a Certificate.
//
// open() reads the header like every other reader, and checks that every array is present and
// fits, so that no query can read out of bounds. It neither checks digests nor proves anything:
// `fairway check` does, once, on the ground. Properties that always hold:
//   1. A verdict other than undecided is that of every flight of the model from the state
//      (docs/trust.md), provided that `fairway check` accepts the certificate.
//   2. A state that is not finite, or far outside, is undecided; outside the grid it is `leave`.
// Cost (measured, docs/benchmarks.md): less than half a microsecond per query.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

#include "fairway/base/tensor_header.hpp"
#include "fairway/vehicle/bang_bang.hpp"
#include "fairway/vehicle/command_field.hpp"
#include "fairway/vehicle/turn_side.hpp"
#include "fairway/verify/flow.hpp"
#include "fairway/verify/section_view.hpp"
#include "fairway/verify/state_flight.hpp"
#include "fairway/verify/verdict.hpp"

namespace fairway::runtime {

enum class Status : std::uint8_t {
  ok,
  too_short,        ///< not even a header
  not_certificate,  ///< an array is missing, or has another type
  misfit,           ///< sizes, offsets or numbers do not match
  no_memory         ///< of a ContractCertificate alone
};

struct Answer {
  Verdict verdict = Verdict::undecided;
  double time_bound_s = std::numeric_limits<double>::infinity();  ///< finite only for `reach`
};

using Command = HeadingCommand;

// For vehicles under a contract: the command for any place, and the side of a turn.
using fairway::CommandField;
using fairway::point_ahead;
using fairway::TurnSide;

/// What both kinds of certificate have, those of the exact vehicle and those under a contract: the
/// arrays of a file, in place.
class FileArrays {
 public:
  /// `bytes`: the whole file, aligned to 8 bytes, which must outlive this object.
  Status open(const void* bytes, std::size_t size) noexcept {
    if (bytes == nullptr || size < 8) return Status::too_short;
    const char* file = static_cast<const char*>(bytes);
    std::uint64_t length = 0;
    std::memcpy(&length, file, 8);
    if (length > size - 8) return Status::too_short;
    begin_ = 8 + length;
    data_ = file + begin_;
    const bool read = header_.read(file + 8, static_cast<std::size_t>(length), size - begin_);
    return read && header_.has_record() ? Status::ok : Status::not_certificate;
  }

  int count() const noexcept { return header_.size(); }
  const HeaderEntry* find(const char* name) const noexcept { return header_.find(name); }
  /// Whether it says where the plan holds: an array more.
  bool holds() const noexcept { return find("holding") != nullptr; }

  /// An array's bytes; null when it is missing or not as expected.
  template <typename... Shape>
  const char* place(const char* name, const char* dtype, std::uint64_t width,
                    Shape... shape) const noexcept {
    const HeaderEntry* entry = header_.find(name);
    const bool fits = entry != nullptr && entry->dtype.is(dtype) && entry->has_shape(shape...) &&
                      (begin_ + entry->begin) % width == 0;
    return fits ? data_ + entry->begin : nullptr;
  }

  /// Grid, vehicle, commands and what the cells mean.
  Status take_flow(Flow& flow) const noexcept {
    const HeaderEntry* heading = find("heading_rad");
    if (heading == nullptr || heading->sizes != 2) return Status::not_certificate;
    const std::uint64_t ny = heading->shape[0];
    const std::uint64_t nx = heading->shape[1];
    constexpr std::uint64_t most = 0x7fffffff;
    if (ny == 0 || nx == 0 || ny > most || nx > most) return Status::misfit;
    const char* numbers = place("geometry", "F64", 8, geometry_numbers);
    const char* commands = place("heading_rad", "F32", 4, ny, nx);
    const char* kind = place("cell_kind", "U8", 1, ny, nx);
    if (numbers == nullptr || commands == nullptr || kind == nullptr) return Status::misfit;
    Geometry geometry;
    std::memcpy(&geometry, numbers, sizeof geometry);
    if (!geometry.is_valid()) return Status::misfit;
    geometry.put_into(flow.grid, flow.vehicle);
    flow.grid.nx = static_cast<int>(nx);
    flow.grid.ny = static_cast<int>(ny);
    flow.heading_rad = reinterpret_cast<const float*>(commands);
    flow.kind = reinterpret_cast<const CellKind*>(kind);
    for (std::size_t c = 0; c < flow.grid.size(); ++c) {
      if (static_cast<std::uint8_t>(flow.kind[c]) > 2) return Status::misfit;
    }
    flow.holding = nullptr;
    if (!holds()) return Status::ok;
    const char* holding = place("holding", "U8", 1, ny, nx);
    flow.holding = reinterpret_cast<const std::uint8_t*>(holding);
    return holding != nullptr ? Status::ok : Status::misfit;
  }

 private:
  TensorHeader header_;
  std::uint64_t begin_ = 0;
  const char* data_ = nullptr;
};

class Certificate {
 public:
  /// `bytes`: the whole file, aligned to 8 bytes, which must outlive this object.
  Status open(const void* bytes, std::size_t size) noexcept {
    opened_ = false;
    flow_ = {};
    FileArrays arrays;
    if (const Status status = arrays.open(bytes, size); status != Status::ok) return status;
    const HeaderEntry* verdict = arrays.find("leaf_verdict");
    if (arrays.count() != (arrays.holds() ? 10 : 9) || verdict == nullptr || verdict->sizes != 1) {
      return Status::not_certificate;
    }
    if (const Status status = arrays.take_flow(flow_); status != Status::ok) return status;
    const std::uint64_t cells = flow_.grid.size();
    const std::uint64_t leaves = verdict->shape[0];
    const std::uint64_t ny = static_cast<std::uint64_t>(flow_.grid.ny);
    const std::uint64_t nx = static_cast<std::uint64_t>(flow_.grid.nx);
    const char* first = arrays.place("section_first", "U32", 4, 4 * cells + 1);
    const char* begin = arrays.place("leaf_begin", "U32", 4, leaves);
    const char* time = arrays.place("leaf_time_s", "F32", 4, leaves);
    const char* verdicts = arrays.place("leaf_verdict", "U8", 1, leaves);
    for (const char* array :
         {first, begin, time, verdicts, arrays.place("leaf_rank", "U32", 4, leaves),
          arrays.place("region", "I8", 1, ny, nx)}) {
      if (array == nullptr) return Status::misfit;
    }
    sections_.first = reinterpret_cast<const std::uint32_t*>(first);
    sections_.begin = reinterpret_cast<const std::uint32_t*>(begin);
    sections_.time_s = reinterpret_cast<const float*>(time);
    sections_.verdict = reinterpret_cast<const std::uint8_t*>(verdicts);
    for (std::size_t s = 0; s < 4 * cells; ++s) {
      if (sections_.first[s] > sections_.first[s + 1]) return Status::misfit;
    }
    if (sections_.first[0] != 0 || sections_.first[4 * cells] != leaves) return Status::misfit;
    for (std::size_t k = 0; k < leaves; ++k) {
      if (sections_.verdict[k] >= stored_verdict_count) return Status::misfit;
    }
    opened_ = true;
    return Status::ok;
  }

  /// The same for a certificate already read and in memory, which must outlive this object.
  void look_into(const Flow& flow, const SectionView& sections) noexcept {
    flow_ = flow;
    sections_ = sections;
    opened_ = true;
  }

  /// The verdict of a state: metres, radians.
  Answer query(double x_m, double y_m, double heading_rad) const noexcept {
    Answer answer;
    if (!is_near(x_m, y_m) || !std::isfinite(heading_rad)) return answer;
    Reader reader{flow_, sections_, {}};
    follow_state(flow_, x_m, y_m, heading_rad, usual_most_crossings, reader);
    answer.verdict = flow_.told(reader.found.only(), flow_.grid.cell_of({x_m, y_m}));
    if (answer.verdict == Verdict::reach) answer.time_bound_s = reader.found.time_s;
    return answer;
  }

  /// What to steer at a state; no command outside the grid.
  Command command(double x_m, double y_m, double heading_rad) const noexcept {
    if (!opened_) return {};
    return bang_bang(flow_.grid, flow_.vehicle, flow_.heading_rad, x_m, y_m, heading_rad);
  }

  const Flow& flow() const noexcept { return flow_; }

 private:
  struct Reader {
    const Flow& flow;
    const SectionView& sections;
    VerdictSet found;

    double seconds(double length_m) const {
      return length_m == 0.0 ? 0.0 : above(length_m / flow.vehicle.speed_mps);
    }
    void arrive(std::size_t section, Interval along_m, double length_m, bool) {
      sections.look_up(section, units_of(along_m, flow.grid.cell_m), seconds(length_m), found);
    }
    void end(Verdict verdict, double length_m) { found.add(verdict, seconds(length_m)); }
    void give_up() { found.add(Verdict::undecided, 0.0); }
  };

  bool is_near(double x_m, double y_m) const noexcept {
    const double far = 0x1p30 * flow_.grid.cell_m;
    return opened_ && std::abs(x_m - flow_.grid.x0_m) < far &&
           std::abs(y_m - flow_.grid.y0_m) < far;
  }

  Flow flow_;
  SectionView sections_;
  bool opened_ = false;
};

}  // namespace fairway::runtime
