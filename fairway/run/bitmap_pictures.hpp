// The pictures of a bitmap: paper 2's reachability map by heading, and the share of headings that
// reach, place by place.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "fairway/bitmap/bitmap.hpp"

namespace fairway {

/// Every file that write_bitmap_pictures writes.
[[nodiscard]] std::vector<std::string> bitmap_picture_files();

/// Writes NAME.svg and NAME.png into `folder` for both.
void write_bitmap_pictures(const Bitmap& bitmap, const std::string& title,
                           const std::filesystem::path& folder);

}  // namespace fairway
