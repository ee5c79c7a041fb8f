#include "fairway/run/bitmap_pictures.hpp"

#include "fairway/base/atomic_file.hpp"
#include "fairway/bitmap/sample_bitmap.hpp"
#include "fairway/report/draw_reachability.hpp"
#include "fairway/report/picture.hpp"

namespace fairway {
namespace {

void write(const Picture& picture, const std::filesystem::path& folder, const std::string& name) {
  write_whole(folder / (name + ".svg"), Existing::keep, picture.svg);
  write_whole(folder / (name + ".png"), Existing::keep, picture.png);
}

std::string titled(const std::string& title, const char* what) {
  return title.empty() ? what : title + ": " + what;
}

}  // namespace

std::vector<std::string> bitmap_picture_files() {
  return {"slices.svg", "slices.png", "sampled.svg", "sampled.png"};
}

void write_bitmap_pictures(const Bitmap& bitmap, const std::string& title,
                           const std::filesystem::path& folder) {
  const ReachabilityMap map = reachability_map_of(bitmap, {});
  write(draw_reachability_slices(map, {.title = titled(title, "sampled near the cells' middles")}),
        folder, "slices");
  write(draw_reachability_shares(map, {.title = titled(title, "sampled over all headings")}),
        folder, "sampled");
}

}  // namespace fairway
