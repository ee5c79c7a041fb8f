#include "fairway/ceiling/ceiling_file.hpp"

#include <cstdint>
#include <span>

#include <nlohmann/json.hpp>

#include "fairway/base/error.hpp"
#include "fairway/base/safetensors.hpp"
#include "fairway/base/tensor_arrays.hpp"
#include "fairway/vehicle/vehicle_json.hpp"

namespace fairway {

void write_ceiling(const Ceiling& c, const std::vector<Region>& region,
                   const std::filesystem::path& file, Existing existing) {
  require(region.size() == c.grid.size() && c.levels > 0,
          "a ceiling that was found, and its cells");
  const auto ny = static_cast<std::uint64_t>(c.grid.ny);
  const auto nx = static_cast<std::uint64_t>(c.grid.nx);
  const auto headings = static_cast<std::uint64_t>(c.headings);
  Safetensors content;
  content.tensors = {{"inside", "F32", {headings, ny, nx}, std::as_bytes(std::span(c.inside))},
                     {"lost", "F32", {headings, ny, nx}, std::as_bytes(std::span(c.lost))},
                     {"region", "I8", {ny, nx}, std::as_bytes(std::span(region))}};
  const auto bounds = [](const CeilingShare& s) { return nlohmann::json{s.lower, s.upper}; };
  const nlohmann::json record{{"format", "fairway-ceiling"},
                              {"format_version", 1},
                              {"origin_m", {c.grid.x0_m, c.grid.y0_m}},
                              {"cell_m", c.grid.cell_m},
                              {"vehicle", json_of(c.vehicle)},
                              {"ceiling", bounds(c.all)},
                              {"ceiling_free", bounds(c.free)},
                              {"ceiling_buffer", bounds(c.buffer)},
                              {"nodes_per_cell", c.nodes_per_cell},
                              {"levels", c.levels},
                              {"sha256", digests_of(content.tensors)}};
  content.metadata["fairway"] = record.dump();
  AtomicFile out(file, existing);
  write_safetensors(out, content);
  out.commit();
}

}  // namespace fairway
