// For tests: a temporary folder, files in it, and errors caught as text.
#pragma once

#include <unistd.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "fairway/base/error.hpp"

namespace fairway {

class ScratchFolder {
 public:
  ScratchFolder() {
    static std::atomic<int> count{0};
    path_ = std::filesystem::temp_directory_path() /
            ("fairway-map-" + std::to_string(::getpid()) + "-" + std::to_string(count++));
    std::filesystem::create_directories(path_);
  }
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  std::filesystem::path file(const std::string& name) const { return path_ / name; }

  std::filesystem::path write(const std::string& name, std::string_view bytes) const {
    std::ofstream(file(name), std::ios::binary) << bytes;
    return file(name);
  }

 private:
  std::filesystem::path path_;
};

/// The message of the InputError that `act` throws, without the folder's path; else "no error".
template <typename Act>
std::string input_error_of(const Act& act) {
  try {
    act();
  } catch (const InputError& error) {
    std::string text = error.what();
    const std::string folder = std::filesystem::temp_directory_path().string() + "/fairway-map-";
    for (auto at = text.find(folder); at != text.npos; at = text.find(folder, at)) {
      const auto end = text.find_first_of("/:", at + folder.size());
      if (end == text.npos) break;
      text.erase(at, end + (text[end] == '/' ? 1 : 0) - at);
    }
    return text;
  }
  return "no error";
}

}  // namespace fairway
