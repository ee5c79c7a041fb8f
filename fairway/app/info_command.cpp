// fairway info: describes a map, before there is a mission, or a product.
#include <filesystem>
#include <memory>

#include "fairway/app/argument_checks.hpp"
#include "fairway/app/command.hpp"
#include "fairway/app/map_arguments.hpp"
#include "fairway/app/places.hpp"
#include "fairway/base/error.hpp"
#include "fairway/base/file_kind.hpp"
#include "fairway/base/mapped_file.hpp"
#include "fairway/run/map_survey.hpp"
#include "fairway/run/product_info.hpp"
#include "fairway/run/product_picture.hpp"

namespace fairway {
namespace {

namespace fs = std::filesystem;

struct InfoArguments {
  MapArguments map;
  fs::path picture;
};

bool is_product(const fs::path& file) {
  if (!fs::is_regular_file(file)) return false;
  const MappedFile mapped(file);
  const FileKind kind = kind_of_bytes(mapped.bytes());
  return kind == FileKind::plan || kind == FileKind::certificate ||
         kind == FileKind::contract_certificate || kind == FileKind::bitmap;
}

void describe_product_to(const InfoArguments& a, const Session& session) {
  const MapArguments& m = a.map;
  if (m.cell_m || m.resolution_m || m.altitude_m || m.turn_radius_m || !m.inclusion.empty()) {
    throw InputError(m.file.string(),
                     "is no map: of the options only --output goes with a plan or a certificate");
  }
  if (!a.picture.empty()) {
    write_picture(picture_of_product(m.file).picture, a.picture, session.existing());
  }
  const ProductInfo info = describe_product(m.file, product_kind(m.file));
  session.tell(info.report, info.words);
}

int info_command(const InfoArguments& a, const Session& session) {
  require_places({a.picture}, {a.map.file}, session.existing());
  if (is_product(a.map.file)) {
    describe_product_to(a, session);
    return exit_done;
  }
  MapRequest request = a.map.request();
  constexpr int cells_across = 500;
  if (!a.map.cell_m) request.cell_m = sensible_cell_m(request, cells_across);
  const MapSurvey survey = survey_map(request, a.map.turn_radius_m);
  for (const std::string& warning : survey.map.warnings) session.warn(warning);
  if (!a.picture.empty()) {
    const Picture picture = survey_picture(survey, a.map.file.filename().string());
    write_picture(picture, a.picture, session.existing());
  }
  nlohmann::json report = survey_json(survey);
  report["map"] = a.map.file.string();
  session.tell(report, survey_words(survey, a.map.file.string()));
  return exit_done;
}

}  // namespace

Action declare_info(CLI::App& options) {
  auto arguments = std::make_shared<InfoArguments>();
  InfoArguments& a = *arguments;
  declare_map(options, a.map);
  options
      .add_option("-o,--output", a.picture, "draw the map, the plan or the verdicts, .svg or .png")
      ->check(picture_argument())
      ->type_name("PICTURE");
  options.footer(
      "Of a plan, a certificate (of either kind) or a bitmap it tells size, vehicle, contract,\n"
      "region and the shares stored.\n"
      "With --turn-radius, cells in the buffer of such a vehicle do not count as free.\n"
      "Example: fairway info demo/basin.yaml -o basin.png");
  return [arguments](const Session& session) { return info_command(*arguments, session); };
}

}  // namespace fairway
