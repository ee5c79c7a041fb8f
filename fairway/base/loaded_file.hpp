// A file's bytes, read into memory once. Unlike a mapping's they never change, whatever happens to
// the file: if a mapped file is truncated, the next access ends the process (SIGBUS).
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>

namespace fairway {

class LoadedFile {
 public:
  /// Throws InputError naming the path when it is not a regular file that can be read to its end.
  explicit LoadedFile(const std::filesystem::path& path);

  /// Aligned to 8 bytes.
  std::span<const std::byte> bytes() const {
    return {reinterpret_cast<const std::byte*>(words_.get()), size_};
  }

 private:
  std::unique_ptr<std::uint64_t[]> words_;
  std::size_t size_ = 0;
};

}  // namespace fairway
