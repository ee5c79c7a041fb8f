#include "fairway/base/file_kind.hpp"

#include <algorithm>
#include <string_view>

#include "fairway/base/error.hpp"
#include "fairway/base/plain_text.hpp"
#include "fairway/base/safetensors.hpp"
#include "fairway/base/strict_json.hpp"

namespace fairway {
namespace {

using namespace std::string_view_literals;

bool is_image(std::string_view head) {
  const bool pnm = head.size() > 2 && head[0] == 'P' && head[1] >= '1' && head[1] <= '7' &&
                   (head[2] == '\n' || head[2] == ' ' || head[2] == '\r' || head[2] == '#');
  return pnm || head.starts_with("\x89PNG"sv) || head.starts_with("BM"sv) ||
         head.starts_with("II*\0"sv) || head.starts_with("MM\0*"sv) ||
         head.starts_with("II+\0"sv) || head.starts_with("MM\0+"sv) ||
         head.starts_with("\xff\xd8\xff"sv);
}

FileKind product_kind_of(std::span<const std::byte> bytes) {
  const Safetensors content = parse_safetensors(bytes, "");
  const auto text = content.metadata.find("fairway");
  if (text == content.metadata.end()) return FileKind::unknown;
  const nlohmann::json record = parse_strict_json(text->second, "");
  if (!record.is_object() || !record.contains("format")) return FileKind::plan;
  if (record["format"] == "fairway-bitmap") return FileKind::bitmap;
  if (record["format"] == "fairway-contract-certificate") return FileKind::contract_certificate;
  return record["format"] == "fairway-certificate" ? FileKind::certificate : FileKind::unknown;
}

/// True when some line starts with `word`, after any blanks.
bool has_line(std::string_view text, std::string_view word) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    std::string_view line = text.substr(at, end - at);
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
    if (line.starts_with(word)) return true;
    at = end + 1;
  }
  return false;
}

FileKind text_kind_of(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\n");
  if (first == std::string_view::npos) return FileKind::unknown;
  const std::string_view begin = text.substr(first);
  if (begin.starts_with("QGC WPL")) return FileKind::waypoints;
  if (begin.starts_with("type octile")) return FileKind::moving_ai;
  if (begin.starts_with('{')) {
    if (text.find("\"fileType\"") != std::string_view::npos) return FileKind::qgc_plan;
    const bool geojson = text.find("\"coordinates\"") != std::string_view::npos ||
                         text.find("\"FeatureCollection\"") != std::string_view::npos;
    return geojson ? FileKind::geojson : FileKind::unknown;
  }
  if (has_line(text, "[map]") && has_line(text, "[mission]")) return FileKind::scenario;
  if (has_line(text, "image:") && has_line(text, "resolution:")) return FileKind::ros_map;
  return FileKind::unknown;
}

const char* name_of(FileKind kind) {
  switch (kind) {
    case FileKind::scenario:
      return "a scenario";
    case FileKind::plan:
      return "a plan";
    case FileKind::certificate:
      return "a certificate";
    case FileKind::contract_certificate:
      return "a contract certificate";
    case FileKind::bitmap:
      return "a bitmap";
    case FileKind::ros_map:
      return "a ROS map";
    case FileKind::moving_ai:
      return "a MovingAI map";
    case FileKind::qgc_plan:
      return "a QGroundControl plan";
    case FileKind::geojson:
      return "GeoJSON";
    case FileKind::waypoints:
      return "a waypoint file";
    case FileKind::image:
      return "an image";
    case FileKind::unknown:
      break;
  }
  return "a map";
}

}  // namespace

FileKind kind_of_bytes(std::span<const std::byte> bytes) {
  constexpr std::size_t most = std::size_t{1} << 20;  // of text: maps may be long
  const std::string_view whole(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (is_image(whole)) return FileKind::image;
  try {
    return product_kind_of(bytes);
  } catch (const InputError&) {
    // Not a safetensors file; perhaps it is text.
  }
  try {
    return text_kind_of(plain_text(whole.substr(0, most), ""));
  } catch (const InputError&) {
    return FileKind::unknown;
  }
}

std::string other_kind_words(FileKind found, FileKind wanted) {
  if (found == FileKind::unknown || found == wanted) return {};
  const std::string is = std::string("is ") + name_of(found);
  switch (found) {
    case FileKind::scenario:
      return is + ": `fairway plan` makes a plan from it";
    case FileKind::plan:
      if (wanted == FileKind::certificate) return is + ": `fairway verify` makes its certificate";
      if (wanted == FileKind::bitmap) {
        return is + ": `fairway verify --method bitmap` draws its bitmap";
      }
      return is + ", expected " + name_of(wanted) + ": use it with `fairway simulate`";
    case FileKind::certificate:
    case FileKind::contract_certificate:
      return is + ", expected " + name_of(wanted) + ": use it with `fairway query`";
    case FileKind::bitmap:
      if (wanted == FileKind::certificate) {
        return is +
               ", a picture drawn from samples, not a proof: `fairway verify` without "
               "--method bitmap makes a certificate";
      }
      return is + ", expected " + name_of(wanted) + ": use it with `fairway query`";
    default:
      return is + ": name it in a scenario, as map.file";
  }
}

void refuse_other_kind(std::span<const std::byte> bytes, FileKind wanted,
                       const std::string& where) {
  const std::string words = other_kind_words(kind_of_bytes(bytes), wanted);
  if (!words.empty()) throw InputError(where, words);
}

}  // namespace fairway
