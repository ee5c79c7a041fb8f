// fairway export: a plan, the verdicts of a certificate (of either kind) or the samples of a
// bitmap, as GeoTIFF.
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "fairway/app/argument_checks.hpp"
#include "fairway/app/command.hpp"
#include "fairway/app/places.hpp"
#include "fairway/base/error.hpp"
#include "fairway/base/share_text.hpp"
#include "fairway/bitmap/bitmap_file.hpp"
#include "fairway/certificate/certificate_file.hpp"
#include "fairway/certificate/contract_certificate_file.hpp"
#include "fairway/exchange/plan_rasters.hpp"
#include "fairway/plan/plan_file.hpp"
#include "fairway/run/ask_bitmap.hpp"
#include "fairway/run/ask_certificate.hpp"
#include "fairway/run/ask_contract.hpp"
#include "fairway/run/product_file.hpp"

namespace fairway {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct ExportArguments {
  fs::path product;
  fs::path output;
  std::vector<std::string> headings;
};

State heading_as_state(const std::string& text) { return state_of_argument("0,0," + text); }

CLI::Validator heading_argument() {
  const auto check = [](const std::string& text) -> std::string {
    try {
      static_cast<void>(heading_as_state(text));
      return text.find(',') == std::string::npos ? "" : "expected one heading";
    } catch (const InputError&) {
      return "expected radians, or degrees with the suffix deg, found " + text;
    }
  };
  return {check, "", "heading"};
}

std::string place_words(const Frame& frame) {
  if (frame.projected_crs) return "in the map's projected reference system";
  if (frame.geo) {
    return fmt::format("in the tangent plane about latitude {}, longitude {}",
                       frame.geo->latitude_deg, frame.geo->longitude_deg);
  }
  return "in map metres (the map is not georeferenced)";
}

/// What was written, for the message, and its frame.
struct Exported {
  const char* of = "plan";
  std::string words = "heading, cost and region of the plan";
  Frame frame;
};

std::string layers_words(const char* what, std::size_t count) {
  return fmt::format("{} at {} heading{}", what, count, count == 1 ? "" : "s");
}

Exported export_product(const ExportArguments& a, const std::vector<Heading>& headings,
                        ProductKind kind, Existing existing) {
  if (kind == ProductKind::certificate) {
    const Certificate certificate = read_certificate(a.product);
    const Frame frame = certificate.frame.value_or(Frame{});
    write_verdict_raster(certificate.grid, frame, verdict_layers(certificate, headings), a.output,
                         existing);
    const char* what = certificate.further_modes() > 0 ? "the verdicts and modes" : "the verdicts";
    return {"verdicts", layers_words(what, headings.size()), frame};
  }
  if (kind == ProductKind::contract_certificate) {
    const ContractCertificate certificate = read_contract_certificate(a.product);
    const Frame frame = certificate.frame.value_or(Frame{});
    write_contract_raster(certificate.grid, frame, contract_layers(certificate, headings), a.output,
                          existing);
    return {"contract verdicts", layers_words("the verdicts under the contract", headings.size()),
            frame};
  }
  if (kind == ProductKind::bitmap) {
    const Bitmap bitmap = read_bitmap(a.product);
    const Frame frame = bitmap.frame.value_or(Frame{});
    write_sampled_raster(bitmap.grid(), frame, sampled_layers(bitmap, headings), a.output,
                         existing);
    return {"samples",
            layers_words("what the samples show (a picture, not a proof)", headings.size()), frame};
  }
  const Plan plan = read_plan(a.product);
  write_plan_raster(plan, a.output, existing);
  Exported of_plan;
  of_plan.frame = frame_in(plan.record);
  if (plan.further_modes() > 0) {
    of_plan.words = fmt::format("heading, cost and region of the plan, and the headings of {}",
                                plural(plan.further_modes(), "further mode"));
  }
  return of_plan;
}

int export_command(const ExportArguments& a, const Session& session) {
  require_places({a.output}, {a.product}, session.existing());
  const ProductKind kind = product_kind(a.product);
  std::vector<Heading> headings;
  if (kind != ProductKind::plan) {
    for (const std::string& text : a.headings) headings.push_back(heading_as_state(text).heading);
    if (headings.empty()) headings = even_headings(8);
  } else if (!a.headings.empty()) {
    throw InputError(a.product.string(),
                     "is a plan: --heading applies to a certificate or a bitmap");
  }
  const Exported made = export_product(a, headings, kind, session.existing());
  json list = json::array();
  for (const Heading heading : headings) list.push_back(heading.rad());
  session.tell(
      {{"raster", a.output.string()},
       {"of", made.of},
       {"headings_rad", kind != ProductKind::plan ? list : json()},
       {"on_earth", made.frame.is_on_earth()}},
      fmt::format("{} has {} {}.", a.output.string(), made.words, place_words(made.frame)));
  return exit_done;
}

/// "0 undecided, 1 reach, ...".
std::string verdict_codes() {
  std::string codes;
  for (int v = 0; v < verdict_count; ++v) {
    codes += fmt::format("{}{} {}", v == 0 ? "" : ", ", v, name_of(static_cast<Verdict>(v)));
  }
  return codes;
}

}  // namespace

Action declare_export(CLI::App& options) {
  auto arguments = std::make_shared<ExportArguments>();
  ExportArguments& a = *arguments;
  options.add_option("product", a.product, "a plan, a certificate or a bitmap")
      ->required()
      ->type_name("PLAN|CERT|BITMAP");
  options.add_option("-o,--output", a.output, "the GeoTIFF to write")
      ->required()
      ->check(CLI::Validator(
          [](const std::string& file) {
            const std::string ending = CLI::detail::to_lower(fs::path(file).extension().string());
            return ending == ".tif" || ending == ".tiff"
                       ? std::string()
                       : file + ": a GeoTIFF; expected a name that ends in .tif or .tiff";
          },
          ""))
      ->type_name("FILE.tif");
  options
      .add_option(
          "--heading", a.headings,
          "certificates and bitmaps: heading of a band, radians, or degrees with the suffix deg; "
          "may be repeated (default: eight headings, evenly spaced)")
      ->type_name("H")
      ->check(heading_argument())
      ->allow_extra_args(false);
  options.footer(fmt::format(
      "A plan becomes the bands heading_rad, cost_m and region, and one for the commands of each\n"
      "further mode; a certificate, one band of verdicts for each heading:\n"
      "{},\n"
      "and, if the plan has further modes, as many bands of the mode that serves each place;\n"
      "a contract certificate has {} at_risk, too (some milliseconds a cell that is undecided);\n"
      "a bitmap, one band of sampled answers for each heading: 0 undecided, 1 sampled_reach,\n"
      "2 sampled_other. QGIS shows them all at the map's place.\n"
      "Example: fairway export out/demo/plan.safetensors -o demo.tif",
      verdict_codes(), at_risk_code));
  return [arguments](const Session& session) { return export_command(*arguments, session); };
}

}  // namespace fairway
