// fairway draw: a plan or verdicts as a picture.
#include <filesystem>
#include <memory>

#include <fmt/format.h>

#include "fairway/app/argument_checks.hpp"
#include "fairway/app/command.hpp"
#include "fairway/app/places.hpp"
#include "fairway/run/product_picture.hpp"

namespace fairway {
namespace {

namespace fs = std::filesystem;

struct DrawArguments {
  fs::path product;
  fs::path output;
};

int draw_command(const DrawArguments& a, const Session& session) {
  require_places({a.output}, {a.product}, session.existing());
  const ProductPicture drawn = picture_of_product(a.product);
  write_picture(drawn.picture, a.output, session.existing());
  session.tell({{"picture", a.output.string()}, {"of", drawn.of}},
               fmt::format("{} shows the {}.", a.output.string(), drawn.of));
  return exit_done;
}

}  // namespace

Action declare_draw(CLI::App& options) {
  auto arguments = std::make_shared<DrawArguments>();
  DrawArguments& a = *arguments;
  options.add_option("product", a.product, "a plan or a certificate")
      ->required()
      ->type_name("PLAN|CERT");
  options.add_option("-o,--output", a.output, "the picture to write, .svg or .png")
      ->required()
      ->check(picture_argument())
      ->type_name("FILE");
  options.footer(
      "Draws a plan's regions, cost to go, streamlines and goal or path, or a certificate's\n"
      "verdicts at eight headings.\n"
      "Example: fairway draw out/demo/plan.safetensors -o demo.png");
  return [arguments](const Session& session) { return draw_command(*arguments, session); };
}

}  // namespace fairway
