#include "fairway/map/world_file.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include <fmt/format.h>

#include "fairway/base/error.hpp"
#include "fairway/map/source_text.hpp"

namespace fairway {

namespace {

/// The possible names of the world file of `image`, in lower case.
std::vector<std::string> candidates(const std::filesystem::path& image) {
  const std::string extension = image.extension().string();  // with its dot
  std::vector<std::string> endings;
  if (extension.size() >= 3)
    endings.push_back(std::string(".") + extension[1] + extension.back() + 'w');
  if (!extension.empty()) endings.push_back(extension + 'w');
  endings.emplace_back(".wld");
  std::vector<std::string> names;
  for (const std::string& ending : endings) {
    std::filesystem::path file = image.filename();
    names.push_back(lower(file.replace_extension(ending).string()));
  }
  return names;
}

WorldFile read_world_file(const std::filesystem::path& file) {
  const SourceText source = read_source(file, 1 << 16);
  double values[6];
  std::size_t count = 0;
  for (const Line& line : lines_of(source.text)) {
    const std::string_view text = trimmed(line.text);
    if (text.empty()) continue;
    const auto number = parse_number(text);
    if (!number || !std::isfinite(*number))
      throw InputError(at_line(file, line.number),
                       fmt::format("{} is not a finite number", shown(text)));
    if (count == 6)
      throw InputError(at_line(file, line.number), "has more than the six numbers of a world file");
    values[count++] = *number;
  }
  if (count != 6)
    throw InputError(file.string(),
                     fmt::format("has {} numbers, expected six in a world file", count));
  // Lines are A, D, B, E, C, F; C and F name the centre of the upper-left pixel.
  const auto [a, d, b, e, c, f] = values;
  return {{c - 0.5 * a - 0.5 * b, a, b, f - 0.5 * d - 0.5 * e, d, e}, source.input};
}

}  // namespace

std::optional<WorldFile> find_world_file(const std::filesystem::path& image) {
  // Systems differ in the case of names; of several files, the one in the image's own case wins.
  const std::vector<std::string> names = candidates(image);
  const std::filesystem::path folder = image.has_parent_path() ? image.parent_path() : ".";
  const std::string stem = image.stem().string();
  std::error_code ignored;
  std::optional<std::tuple<std::size_t, bool, std::filesystem::path>> best;
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
    const std::filesystem::path name = entry.path().filename();
    const auto at = std::find(names.begin(), names.end(), lower(name.string()));
    if (at == names.end()) continue;
    std::tuple found(static_cast<std::size_t>(at - names.begin()), name.stem().string() != stem,
                     image.parent_path() / name);
    if (!best || found < *best) best = std::move(found);
  }
  if (!best) return std::nullopt;
  return read_world_file(std::get<2>(*best));
}

}  // namespace fairway
