// For the vehicle: what to steer, and what is proved, at any state. Looks into a certificate file
// mapped into memory (docs/formats.md).
//
// No heap, no exceptions, no library but the standard's; safe to call from several threads at once.
//
//     fairway::runtime::Certificate certificate;
//     if (certificate.open(bytes, size) != fairway::runtime::Status::ok) ...
//     const fairway::runtime::Answer answer = certificate.query(x_m, y_m, heading_rad);
//
// open() checks that every array is there and fits, so that no query can read beside the file. It
// neither checks digests nor proves anything: that is `fairway check`, once, on the ground.
// Properties that always hold:
//   1. A verdict other than undecided is that of every flight of the model from the state
//      (docs/trust.md), if the certificate is one that `fairway check` accepts.
//   2. A state that is not finite, or far outside, is undecided; outside the grid it is `leave`.
// Cost (measured, docs/benchmarks.md): less than half a microsecond a query.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

#include "fairway/verify/flow.hpp"
#include "fairway/verify/section_view.hpp"
#include "fairway/verify/state_flight.hpp"
#include "fairway/verify/verdict.hpp"

namespace fairway::runtime {

enum class Status : std::uint8_t {
  ok,
  too_short,        ///< not even a header
  not_certificate,  ///< an array is missing, or has another type
  misfit            ///< sizes, offsets or numbers do not fit together
};

struct Answer {
  Verdict verdict = Verdict::undecided;
  double time_bound_s = std::numeric_limits<double>::infinity();  ///< finite for `reach` alone
};

/// What the plan commands at a state.
struct Command {
  double heading_rad = std::numeric_limits<double>::quiet_NaN();  ///< NaN: none, fly straight
  double turn_rate_radps = 0.0;  ///< bang-bang; positive to the left, 0 when aligned or none
};

namespace detail {

/// Finds `"name":{... "data_offsets":[begin,end] ...}` in a safetensors header, without a parser:
/// array names are keys of the header and stand in quotes nowhere else in it (the metadata is an
/// escaped string, in which a quote follows a backslash).
struct HeaderText {
  const char* text;
  std::size_t size;

  static constexpr std::size_t npos = ~std::size_t{0};
  std::size_t find(const char* word, std::size_t from) const {
    const std::size_t length = std::strlen(word);
    for (std::size_t i = from; i + length <= size; ++i) {
      if (std::memcmp(text + i, word, length) == 0 && (i == 0 || text[i - 1] != '\\')) return i;
    }
    return npos;
  }
  bool number(std::size_t& at, std::uint64_t& value) const {
    value = 0;
    const std::size_t begin = at;
    while (at < size && text[at] >= '0' && text[at] <= '9' && at - begin < 18) {
      value = 10 * value + static_cast<std::uint64_t>(text[at++] - '0');
    }
    return at > begin;
  }
};

}  // namespace detail

class Certificate {
 public:
  /// `bytes`: the whole file, aligned to 8 bytes, which must outlive this object.
  Status open(const void* bytes, std::size_t size) noexcept {
    opened_ = false;
    if (bytes == nullptr || size < 8) return Status::too_short;
    const char* file = static_cast<const char*>(bytes);
    std::uint64_t header = 0;
    std::memcpy(&header, file, 8);
    if (header > size - 8 || header % 8 != 0) return Status::too_short;
    const detail::HeaderText text{file + 8, static_cast<std::size_t>(header)};
    const char* data = file + 8 + header;
    const std::size_t data_size = size - 8 - static_cast<std::size_t>(header);

    Array numbers, heading, first, begin, time, kind, verdict;
    if (!find(text, "\"geometry\":", "\"F64\"", numbers) ||
        !find(text, "\"heading_rad\":", "\"F32\"", heading) ||
        !find(text, "\"section_first\":", "\"U32\"", first) ||
        !find(text, "\"leaf_begin\":", "\"U32\"", begin) ||
        !find(text, "\"leaf_time_s\":", "\"F32\"", time) ||
        !find(text, "\"cell_kind\":", "\"U8\"", kind) ||
        !find(text, "\"leaf_verdict\":", "\"U8\"", verdict)) {
      return Status::not_certificate;
    }
    for (const Array* array : {&numbers, &heading, &first, &begin, &time, &kind, &verdict}) {
      if (array->end < array->begin || array->end > data_size) return Status::misfit;
    }
    const std::size_t cells = kind.bytes();
    const std::size_t leaves = verdict.bytes();
    if (numbers.bytes() != sizeof(Geometry) || cells == 0 || heading.bytes() != 4 * cells ||
        first.bytes() != 4 * (4 * cells + 1) || begin.bytes() != 4 * leaves ||
        time.bytes() != 4 * leaves || heading.columns == 0 || cells % heading.columns != 0 ||
        cells / heading.columns > 0x7fffffff || heading.columns > 0x7fffffff ||
        numbers.begin % 8 != 0 || (heading.begin | first.begin | begin.begin | time.begin) % 4) {
      return Status::misfit;
    }
    Geometry geometry;
    std::memcpy(&geometry, data + numbers.begin, sizeof geometry);
    if (!geometry.is_valid()) return Status::misfit;
    geometry.put_into(flow_.grid, flow_.vehicle);
    flow_.grid.nx = static_cast<int>(heading.columns);
    flow_.grid.ny = static_cast<int>(cells / heading.columns);
    flow_.heading_rad = reinterpret_cast<const float*>(data + heading.begin);
    flow_.kind = reinterpret_cast<const CellKind*>(data + kind.begin);
    sections_.first = reinterpret_cast<const std::uint32_t*>(data + first.begin);
    sections_.begin = reinterpret_cast<const std::uint32_t*>(data + begin.begin);
    sections_.time_s = reinterpret_cast<const float*>(data + time.begin);
    sections_.verdict = reinterpret_cast<const std::uint8_t*>(data + verdict.begin);
    for (std::size_t s = 0; s < 4 * cells; ++s) {
      if (sections_.first[s] > sections_.first[s + 1]) return Status::misfit;
    }
    if (sections_.first[0] != 0 || sections_.first[4 * cells] != leaves) return Status::misfit;
    for (std::size_t c = 0; c < cells; ++c) {
      if (static_cast<std::uint8_t>(flow_.kind[c]) > 2) return Status::misfit;
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
    Command answer;
    if (!is_near(x_m, y_m) || !std::isfinite(heading_rad)) return answer;
    const Cell cell = flow_.grid.cell_of({x_m, y_m});
    if (!flow_.grid.contains(cell)) return answer;
    const double command_rad = static_cast<double>(flow_.heading_rad[flow_.grid.index(cell)]);
    if (std::isnan(command_rad)) return answer;
    answer.heading_rad = command_rad;
    const double turn = std::remainder(command_rad - heading_rad, 2.0 * 3.14159265358979323846);
    const double rate = flow_.vehicle.speed_mps / flow_.vehicle.turn_radius_m;
    answer.turn_rate_radps = turn == 0.0 ? 0.0 : turn > 0.0 ? rate : -rate;
    return answer;
  }

  const Flow& flow() const noexcept { return flow_; }

 private:
  struct Array {
    std::uint64_t begin = 0;
    std::uint64_t end = 0;
    std::uint64_t columns = 0;  // the last number of the shape
    std::size_t bytes() const { return static_cast<std::size_t>(end - begin); }
  };
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

  static bool find(const detail::HeaderText& text, const char* name, const char* type,
                   Array& array) noexcept {
    std::size_t at = text.find(name, 0);
    if (at == detail::HeaderText::npos) return false;
    const std::size_t end = text.find("}", at);
    const std::size_t dtype = text.find(type, at);
    std::size_t shape = text.find("\"shape\":[", at);
    std::size_t offsets = text.find("\"data_offsets\":[", at);
    if (end == detail::HeaderText::npos || dtype > end || shape > end || offsets > end) {
      return false;
    }
    shape += 9;
    while (text.number(shape, array.columns) && text.text[shape] == ',') ++shape;
    offsets += 16;
    if (!text.number(offsets, array.begin) || text.text[offsets++] != ',') return false;
    return text.number(offsets, array.end);
  }
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
