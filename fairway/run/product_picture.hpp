// A plan's or a certificate's file as a picture.
#pragma once

#include <filesystem>
#include <string>

#include "fairway/base/atomic_file.hpp"
#include "fairway/plan/plan.hpp"
#include "fairway/report/picture.hpp"

namespace fairway {

/// Regions, cost to go, streamlines and the mission.
[[nodiscard]] Picture picture_of_plan(const Plan& plan, const std::string& title);

struct ProductPicture {
  Picture picture;
  std::string of;  ///< "plan" or "verdicts"
};

/// Of a plan as above; of a certificate the verdicts at eight headings. The file's name is the
/// title. Throws InputError when the file is neither.
[[nodiscard]] ProductPicture picture_of_product(const std::filesystem::path& file);

/// As PNG where the name ends in .png, else as SVG. Throws InputError.
void write_picture(const Picture& picture, const std::filesystem::path& file, Existing existing);

}  // namespace fairway
