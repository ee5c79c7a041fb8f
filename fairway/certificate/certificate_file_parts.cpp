#include "fairway/certificate/certificate_file_parts.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace fairway {

using nlohmann::json;

std::string text_of_record(const json& record) {
  return record.dump(-1, ' ', true, json::error_handler_t::replace);
}

void write_certificate_file(const std::filesystem::path& path, Existing existing,
                            const CertificateFormat& format, json record,
                            const RegionOfInterest& region, const std::vector<Tensor>& tensors) {
  AtomicFile file(path, existing);
  record["format"] = format.name;
  record["format_version"] = certificate_format_version;
  record["method"] = format.method;
  record["region_of_interest"] = json_of(region);
  record["sha256"] = digests_of(tensors);
  write_safetensors(file, {{{"fairway", text_of_record(record)}}, tensors});
  file.commit();
}

json record_of_file(const Safetensors& file, const CertificateFormat& format,
                    const std::string& where) {
  const auto text = file.metadata.find("fairway");
  if (text == file.metadata.end()) {
    throw InputError(where, "is not a certificate: __metadata__ has no string \"fairway\"");
  }
  const std::string place = where + ": fairway";
  json record = parse_strict_json(text->second, place);
  if (!record.is_object() || record.value("format", json()) != json(format.name)) {
    throw InputError(place + ".format",
                     fmt::format("is not \"{}\": not a {}", format.name, format.noun));
  }
  if (record.value("format_version", json()) != json(certificate_format_version)) {
    throw InputError(place + ".format_version",
                     fmt::format("expected {}", certificate_format_version));
  }
  return record;
}

bool leaves_are_in_order(const std::vector<std::uint32_t>& first,
                         const std::vector<std::uint32_t>& begin) {
  if (first.front() != 0 || first.back() != begin.size()) return false;
  if (!std::is_sorted(first.begin(), first.end())) return false;
  for (std::size_t i = 0; i + 1 < first.size(); ++i) {
    if (first[i] < first[i + 1] && begin[first[i]] != 0) return false;
    for (std::size_t k = first[i] + 1; k < first[i + 1]; ++k) {
      if (begin[k - 1] >= begin[k]) return false;
    }
  }
  return true;
}

std::string digest_of_modes(const nlohmann::json& record) {
  const auto digests = record.find("sha256");
  const bool has_modes = digests != record.end() && digests->contains("mode_heading_rad") &&
                         (*digests)["mode_heading_rad"].is_string();
  return has_modes ? (*digests)["mode_heading_rad"].get<std::string>() : "";
}

}  // namespace fairway
