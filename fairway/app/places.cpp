#include "fairway/app/places.hpp"

#include <cstddef>
#include <system_error>

#include "fairway/base/error.hpp"

namespace fairway {
namespace {

namespace fs = std::filesystem;

bool same_place(const fs::path& a, const fs::path& b) {
  std::error_code error;
  const auto whole = [&](const fs::path& path) {
    return fs::weakly_canonical(fs::absolute(path, error), error);
  };
  return fs::equivalent(a, b, error) || whole(a) == whole(b);
}

}  // namespace

Places files_of(Places places) {
  std::erase_if(places, [](const fs::path& path) { return path.empty() || path == "-"; });
  return places;
}

void require_places(const Places& outputs, const Places& inputs, Existing existing) {
  const Places to = files_of(outputs);
  const Places from = files_of(inputs);
  for (std::size_t i = 0; i < to.size(); ++i) {
    require_no_input(to[i], from);
    for (std::size_t j = 0; j < i; ++j) {
      if (same_place(to[i], to[j])) {
        throw InputError(to[i].string(),
                         "is given for two products, expected a different file for each");
      }
    }
    require_writable_place(to[i], existing);
  }
}

}  // namespace fairway
