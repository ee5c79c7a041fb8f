#include "fairway/run/product_file.hpp"

#include <string>

#include "fairway/base/error.hpp"
#include "fairway/base/file_kind.hpp"
#include "fairway/base/mapped_file.hpp"
#include "fairway/base/safetensors.hpp"
#include "fairway/base/strict_json.hpp"

namespace fairway {

namespace {

ProductKind kind_of_product(const MappedFile& mapped, const std::string& where) {
  const Safetensors content = parse_safetensors(mapped.bytes(), where);
  const auto text = content.metadata.find("fairway");
  if (text == content.metadata.end()) {
    throw InputError(where, "is neither a plan nor a certificate");
  }
  const nlohmann::json record = parse_strict_json(text->second, where + ": fairway");
  if (!record.is_object() || !record.contains("format")) return ProductKind::plan;
  if (record["format"] == "fairway-certificate") return ProductKind::certificate;
  if (record["format"] == "fairway-contract-certificate") {
    return ProductKind::contract_certificate;
  }
  if (record["format"] == "fairway-bitmap") return ProductKind::bitmap;
  throw InputError(where, "is " + shown(record["format"]) + ", expected a plan or a certificate");
}

}  // namespace

ProductKind product_kind(const std::filesystem::path& file) {
  const MappedFile mapped(file);
  try {
    return kind_of_product(mapped, file.string());
  } catch (const InputError&) {
    refuse_other_kind(mapped.bytes(), FileKind::plan, file.string());
    throw;
  }
}

}  // namespace fairway
