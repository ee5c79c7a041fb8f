// Unfinished products: under hidden names next to their destinations until they are whole. The
// process keeps track of them so that it can remove them; if it was killed, the next writer there
// does. Private to atomic_file.cpp.
#pragma once

#include <filesystem>
#include <utility>

namespace fairway::unfinished {

/// A lock on a file or folder that is released when its process ends, however that happens; with
/// `wait`, taken once others have released it. Held while the object lives.
class Lock {
 public:
  Lock() = default;
  Lock(const std::filesystem::path& path, bool wait);
  ~Lock();
  Lock(const Lock&) = delete;
  Lock& operator=(const Lock&) = delete;

  bool held() const { return held_; }
  int release() { return std::exchange(descriptor_, -1); }  ///< the descriptor that holds it

 private:
  int descriptor_ = -1;
  bool held_ = false;
};

/// A hidden name in the same folder, hence on the same file system, so that rename is atomic.
/// First removes what killed processes left there.
[[nodiscard]] std::filesystem::path register_temporary(const std::filesystem::path& path);

/// It has been moved to its destination.
void forget(const std::filesystem::path& temporary);

/// Removes it.
void discard(const std::filesystem::path& temporary) noexcept;

}  // namespace fairway::unfinished
