#include "fairway/base/unfinished.hpp"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include "fairway/base/atomic_file.hpp"

namespace fairway {
namespace unfinished {
namespace {

namespace fs = std::filesystem;

struct Places {
  std::mutex mutex;
  std::vector<fs::path> paths;
};
Places& places() {
  static Places all;
  return all;
}

std::string partial_prefix(const fs::path& path) {
  return "." + path.filename().string() + ".partial-";
}

/// The process in a name PREFIX-PID-N.
std::optional<pid_t> owner_of(std::string_view name, std::string_view prefix) {
  if (!name.starts_with(prefix)) return std::nullopt;
  name.remove_prefix(prefix.size());
  pid_t owner = 0;
  unsigned number = 0;
  const char* const end = name.data() + name.size();
  const auto pid = std::from_chars(name.data(), end, owner);
  if (pid.ec != std::errc() || owner <= 0 || pid.ptr == end || *pid.ptr != '-') return std::nullopt;
  const auto count = std::from_chars(pid.ptr + 1, end, number);
  if (count.ec != std::errc() || count.ptr != end) return std::nullopt;
  return owner;
}

/// Removes what killed processes left next to `path` under its name. It is abandoned when the
/// process is gone and the lock is free: the process id alone would mislead where another machine
/// or container writes into the same folder.
void sweep(const fs::path& path) {
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  const std::string prefix = partial_prefix(path);
  std::error_code ignored;
  std::vector<fs::path> left;
  for (fs::directory_iterator it(folder, ignored), end; !ignored && it != end;
       it.increment(ignored)) {
    const std::string name = it->path().filename().string();
    const std::optional<pid_t> owner = owner_of(name, prefix);
    if (!owner) continue;
    if (*owner == ::getpid()) {  // ours, or from a process that had our id
      const std::scoped_lock lock(places().mutex);
      const auto& ours = places().paths;
      if (std::any_of(ours.begin(), ours.end(),
                      [&](const fs::path& p) { return p.filename() == name; })) {
        continue;
      }
    } else if (::kill(*owner, 0) == 0 || errno != ESRCH) {
      continue;
    }
    left.push_back(folder / name);
  }
  for (const fs::path& partial : left) {
    const Lock lock(partial, false);
    if (lock.held()) fs::remove_all(partial, ignored);
  }
}

}  // namespace

Lock::Lock(const fs::path& path, bool wait) {
  descriptor_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
  if (descriptor_ < 0) return;
  int done = 0;
  do done = ::flock(descriptor_, LOCK_EX | (wait ? 0 : LOCK_NB));
  while (done != 0 && errno == EINTR);
  held_ = done == 0;
}

Lock::~Lock() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

fs::path register_temporary(const fs::path& path) {
  static std::atomic<unsigned> count{0};
  sweep(path);
  const std::string name =
      partial_prefix(path) + std::to_string(::getpid()) + "-" + std::to_string(count++);
  const fs::path temporary = path.parent_path() / name;
  const std::scoped_lock lock(places().mutex);
  places().paths.push_back(temporary);
  return temporary;
}

void forget(const fs::path& temporary) {
  const std::scoped_lock lock(places().mutex);
  std::erase(places().paths, temporary);
}

void discard(const fs::path& temporary) noexcept {
  std::error_code ignored;
  fs::remove_all(temporary, ignored);
  forget(temporary);
}

}  // namespace unfinished

void remove_unfinished() noexcept {
  const std::scoped_lock lock(unfinished::places().mutex);
  std::error_code ignored;
  for (const auto& path : unfinished::places().paths) std::filesystem::remove_all(path, ignored);
}

}  // namespace fairway
