// For the vehicle: what to steer, and what is proved, at any state. Reads a certificate file
// mapped into memory (docs/formats.md).
//
// No heap, no exceptions, only the standard library; safe to call from several threads at once.
//
//     fairway::runtime::Certificate certificate;
//     if (certificate.open(bytes, size) != fairway::runtime::Status::ok) ...
//     const fairway::runtime::Answer answer = certificate.query(x_m, y_m, heading_rad);
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
#include "fairway/verify/flow.hpp"
#include "fairway/verify/section_view.hpp"
#include "fairway/verify/state_flight.hpp"
#include "fairway/verify/verdict.hpp"

namespace fairway::runtime {

enum class Status : std::uint8_t {
  ok,
  too_short,        ///< not even a header
  not_certificate,  ///< an array is missing, or has another type
  misfit            ///< sizes, offsets or numbers do not match
};

struct Answer {
  Verdict verdict = Verdict::undecided;
  double time_bound_s = std::numeric_limits<double>::infinity();  ///< finite only for `reach`
};

using Command = HeadingCommand;

class Certificate {
 public:
  /// `bytes`: the whole file, aligned to 8 bytes, which must outlive this object.
  Status open(const void* bytes, std::size_t size) noexcept {
    opened_ = false;
    if (bytes == nullptr || size < 8) return Status::too_short;
    const char* file = static_cast<const char*>(bytes);
    std::uint64_t length = 0;
    std::memcpy(&length, file, 8);
    if (length > size - 8) return Status::too_short;
    const char* data = file + 8 + length;
    TensorHeader header;
    if (!header.read(file + 8, static_cast<std::size_t>(length), size - 8 - length) ||
        !header.has_record() || header.size() != 9) {
      return Status::not_certificate;
    }
    const HeaderEntry* heading = header.find("heading_rad");
    const HeaderEntry* verdict = header.find("leaf_verdict");
    if (heading == nullptr || heading->sizes != 2 || verdict == nullptr || verdict->sizes != 1) {
      return Status::not_certificate;
    }
    const std::uint64_t ny = heading->shape[0];
    const std::uint64_t nx = heading->shape[1];
    constexpr std::uint64_t most = 0x7fffffff;
    if (ny == 0 || nx == 0 || ny > most || nx > most) return Status::misfit;
    const std::uint64_t cells = ny * nx;
    const std::uint64_t leaves = verdict->shape[0];
    // The arrays, in place; null when one is missing or not as expected.
    const auto place = [&](const char* name, const char* dtype, std::uint64_t width,
                           auto... shape) {
      const HeaderEntry* entry = header.find(name);
      const bool fits = entry != nullptr && entry->dtype.is(dtype) && entry->has_shape(shape...) &&
                        (8 + length + entry->begin) % width == 0;
      return fits ? data + entry->begin : nullptr;
    };
    const char* numbers = place("geometry", "F64", 8, geometry_numbers);
    const char* commands = place("heading_rad", "F32", 4, ny, nx);
    const char* first = place("section_first", "U32", 4, 4 * cells + 1);
    const char* begin = place("leaf_begin", "U32", 4, leaves);
    const char* time = place("leaf_time_s", "F32", 4, leaves);
    const char* kind = place("cell_kind", "U8", 1, ny, nx);
    const char* verdicts = place("leaf_verdict", "U8", 1, leaves);
    for (const char* array :
         {numbers, commands, first, begin, time, kind, verdicts,
          place("leaf_rank", "U32", 4, leaves), place("region", "I8", 1, ny, nx)}) {
      if (array == nullptr) return Status::misfit;
    }
    Geometry geometry;
    std::memcpy(&geometry, numbers, sizeof geometry);
    if (!geometry.is_valid()) return Status::misfit;
    geometry.put_into(flow_.grid, flow_.vehicle);
    flow_.grid.nx = static_cast<int>(nx);
    flow_.grid.ny = static_cast<int>(ny);
    flow_.heading_rad = reinterpret_cast<const float*>(commands);
    flow_.kind = reinterpret_cast<const CellKind*>(kind);
    sections_.first = reinterpret_cast<const std::uint32_t*>(first);
    sections_.begin = reinterpret_cast<const std::uint32_t*>(begin);
    sections_.time_s = reinterpret_cast<const float*>(time);
    sections_.verdict = reinterpret_cast<const std::uint8_t*>(verdicts);
    for (std::size_t s = 0; s < 4 * cells; ++s) {
      if (sections_.first[s] > sections_.first[s + 1]) return Status::misfit;
    }
    if (sections_.first[0] != 0 || sections_.first[4 * cells] != leaves) return Status::misfit;
    for (std::size_t c = 0; c < cells; ++c) {
      if (static_cast<std::uint8_t>(flow_.kind[c]) > 2) return Status::misfit;
    }
    for (std::size_t k = 0; k < leaves; ++k) {
      if (sections_.verdict[k] >= verdict_count) return Status::misfit;
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
    answer.verdict = reader.found.only();
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
