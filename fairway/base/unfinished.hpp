// Products on their way: under hidden names beside their places until they are whole, known to the
// process so that it can remove them, and swept by the next to write there when it was killed.
// Private to atomic_file.cpp.
#pragma once

#include <filesystem>
#include <utility>

namespace fairway::unfinished {

/// A lock on a file or folder that goes with its process, however that ends; with `wait`, once
/// others have let go of it. Held while the object lives.
class Lock {
 public:
  Lock() = default;
  Lock(const std::filesystem::path& path, bool wait);
  ~Lock();
  Lock(const Lock&) = delete;
  Lock& operator=(const Lock&) = delete;

  bool held() const { return held_; }
  int release() { return std::exchange(descriptor_, -1); }  ///< the descriptor that keeps it

 private:
  int descriptor_ = -1;
  bool held_ = false;
};

/// A hidden name in the same folder, hence on the same file system: rename is then atomic. Sweeps
/// first what killed processes left there.
[[nodiscard]] std::filesystem::path register_temporary(const std::filesystem::path& path);

/// It is in its place now.
void forget(const std::filesystem::path& temporary);

/// Removes it.
void discard(const std::filesystem::path& temporary) noexcept;

}  // namespace fairway::unfinished
