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
#include "fairway/verify/ask_modes.hpp"
#include "fairway/verify/flow.hpp"
#include "fairway/verify/mode_choice.hpp"
#include "fairway/verify/section_view.hpp"
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
  /// The one to fly: the first that is proved to reach; 0 where none is, or where the plan has one.
  int mode = 0;
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
  /// Whether the plan has further modes: seven arrays more.
  bool has_modes() const noexcept { return find("mode_heading_rad") != nullptr; }

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
    proof_ = {};
    FileArrays arrays;
    if (const Status status = arrays.open(bytes, size); status != Status::ok) return status;
    const int expected = 9 + (arrays.holds() ? 1 : 0) + (arrays.has_modes() ? 7 : 0);
    if (arrays.count() != expected) return Status::not_certificate;
    Flow& flow = proof_.flow;
    if (const Status status = arrays.take_flow(flow); status != Status::ok) return status;
    const std::uint64_t ny = static_cast<std::uint64_t>(flow.grid.ny);
    const std::uint64_t nx = static_cast<std::uint64_t>(flow.grid.nx);
    if (arrays.place("region", "I8", 1, ny, nx) == nullptr) return Status::misfit;
    const Names names{"section_first", "leaf_begin", "leaf_rank", "leaf_time_s", "leaf_verdict"};
    Status status = take_leaves(arrays, names, 4 * flow.grid.size(), proof_.sections);
    if (status == Status::ok && arrays.has_modes()) status = take_modes(arrays);
    opened_ = status == Status::ok;
    return status;
  }

  /// The same for a certificate already read and in memory, which must outlive this object.
  void look_into(const ProofView& proof) noexcept {
    proof_ = proof;
    opened_ = true;
  }

  /// The verdict of a state: metres, radians.
  Answer query(double x_m, double y_m, double heading_rad) const noexcept {
    return told(x_m, y_m, heading_rad, modes());
  }

  /// Its modes: 1, unless the plan has further ones (docs/modes.md).
  int modes() const noexcept { return proof_.modes(); }

  /// The same as if the plan had only the modes before `end`.
  Answer query_before(int end, double x_m, double y_m, double heading_rad) const noexcept {
    return told(x_m, y_m, heading_rad, end);
  }

  /// What one mode does from a state, whatever others do.
  Answer query_mode(int mode, double x_m, double y_m, double heading_rad) const noexcept {
    if (!is_near(x_m, y_m) || !std::isfinite(heading_rad) || !has(mode)) return {};
    const VerdictSet found = ask_mode(proof_, mode, x_m, y_m, heading_rad);
    const bool reaches = found.only() == Verdict::reach;
    return {found.only(), reaches ? found.time_s : std::numeric_limits<double>::infinity(), mode};
  }

  /// What to steer at a state, in a mode; no command outside the grid.
  Command command(double x_m, double y_m, double heading_rad, int mode = 0) const noexcept {
    if (!opened_ || !has(mode)) return {};
    const Flow flow = proof_.flow_of(mode);
    return bang_bang(flow.grid, flow.vehicle, flow.heading_rad, x_m, y_m, heading_rad);
  }

  const Flow& flow() const noexcept { return proof_.flow; }
  const ProofView& proof() const noexcept { return proof_; }

 private:
  struct Names {
    const char* first;
    const char* begin;
    const char* rank;
    const char* time_s;
    const char* verdict;
  };

  static Status take_leaves(const FileArrays& arrays, const Names& names, std::uint64_t sections,
                            SectionView& into) noexcept {
    const HeaderEntry* entry = arrays.find(names.verdict);
    if (entry == nullptr || entry->sizes != 1) return Status::not_certificate;
    const std::uint64_t leaves = entry->shape[0];
    const char* first = arrays.place(names.first, "U32", 4, sections + 1);
    const char* begin = arrays.place(names.begin, "U32", 4, leaves);
    const char* time = arrays.place(names.time_s, "F32", 4, leaves);
    const char* verdicts = arrays.place(names.verdict, "U8", 1, leaves);
    for (const char* array :
         {first, begin, time, verdicts, arrays.place(names.rank, "U32", 4, leaves)}) {
      if (array == nullptr) return Status::misfit;
    }
    into.first = reinterpret_cast<const std::uint32_t*>(first);
    into.begin = reinterpret_cast<const std::uint32_t*>(begin);
    into.time_s = reinterpret_cast<const float*>(time);
    into.verdict = reinterpret_cast<const std::uint8_t*>(verdicts);
    for (std::size_t s = 0; s < sections; ++s) {
      if (into.first[s] > into.first[s + 1]) return Status::misfit;
    }
    if (into.first[0] != 0 || into.first[sections] != leaves) return Status::misfit;
    for (std::size_t k = 0; k < leaves; ++k) {
      if (into.verdict[k] >= stored_verdict_count) return Status::misfit;
    }
    return Status::ok;
  }

  Status take_modes(const FileArrays& arrays) noexcept {
    const Grid& grid = proof_.flow.grid;
    const HeaderEntry* commands = arrays.find("mode_heading_rad");
    if (commands->sizes != 3) return Status::not_certificate;
    const std::uint64_t further = commands->shape[0];
    if (further < 1 || further >= most_modes) return Status::misfit;
    const std::uint64_t ny = static_cast<std::uint64_t>(grid.ny);
    const char* fields = arrays.place("mode_heading_rad", "F32", 4, further, ny,
                                      static_cast<std::uint64_t>(grid.nx));
    if (fields == nullptr) return Status::misfit;
    const Names names{"mode_section_first", "mode_leaf_begin", "mode_leaf_rank", "mode_leaf_time_s",
                      "mode_leaf_verdict"};
    SectionView& sections = proof_.further_sections;
    const Status status = take_leaves(arrays, names, 4 * further * grid.size(), sections);
    if (status != Status::ok) return status;
    const std::uint64_t leaves = sections.first[4 * further * grid.size()];
    const char* next = arrays.place("mode_leaf_next", "U8", 1, leaves);
    if (next == nullptr) return Status::misfit;
    sections.next_mode = reinterpret_cast<const std::uint8_t*>(next);
    for (std::size_t k = 0; k < leaves; ++k) {
      if (sections.next_mode[k] != no_mode && sections.next_mode[k] >= further) {
        return Status::misfit;
      }
    }
    proof_.further_rad = reinterpret_cast<const float*>(fields);
    proof_.further = static_cast<int>(further);
    return Status::ok;
  }

  Answer told(double x_m, double y_m, double heading_rad, int end) const noexcept {
    if (!is_near(x_m, y_m) || !std::isfinite(heading_rad)) return {};
    const ProvedState known =
        ask_modes(proof_, end < modes() ? end : modes(), x_m, y_m, heading_rad);
    return {known.verdict, known.time_s, known.mode};
  }

  bool has(int mode) const noexcept { return mode >= 0 && mode < modes(); }
  bool is_near(double x_m, double y_m) const noexcept {
    const Grid& grid = proof_.flow.grid;
    const double far = 0x1p30 * grid.cell_m;
    return opened_ && std::abs(x_m - grid.x0_m) < far && std::abs(y_m - grid.y0_m) < far;
  }

  ProofView proof_;
  bool opened_ = false;
};

/// The side of a vehicle whose plan has modes: keeps the one that is flown. One for each vehicle;
/// the certificate's bytes must outlive it. States that it is told of are finite and near the grid.
class ModePilot {
 public:
  explicit ModePilot(const Certificate& certificate)
      : certificate_(certificate), choice_(certificate.proof()) {}

  /// What to steer now. `answer.verdict` other than reach: what was proved does not hold from here.
  /// Then modes are simulated, once in each cell, which may take milliseconds (mode_trial.hpp).
  struct Steered {
    Command command;
    Answer answer;
  };
  Steered steer(double x_m, double y_m, double heading_rad) noexcept {
    const ProvedState known = choice_.at(x_m, y_m, heading_rad);
    return {certificate_.command(x_m, y_m, heading_rad, known.mode),
            {known.verdict, known.time_s, known.mode}};
  }

 private:
  Certificate certificate_;
  ModeChoice choice_;
};

}  // namespace fairway::runtime
