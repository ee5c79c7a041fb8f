#include "fairway/base/atomic_file.hpp"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <mutex>
#include <string>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

#include "fairway/base/error.hpp"

namespace fairway {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& path, const char* what, int error) {
  throw InputError(path.string(), std::string(what) + ": " + std::strerror(error));
}

[[noreturn]] void refuse_existing(const fs::path& path) {
  throw InputError(path.string(), "exists already and is kept; --force replaces it");
}

struct Unfinished {
  std::mutex mutex;
  std::vector<fs::path> paths;
};
Unfinished& unfinished() {
  static Unfinished places;
  return places;
}

/// A hidden name in the same folder, hence on the same file system: rename is then atomic.
fs::path register_temporary(const fs::path& path) {
  static std::atomic<unsigned> count{0};
  const std::string name = "." + path.filename().string() + ".partial-" +
                           std::to_string(::getpid()) + "-" + std::to_string(count++);
  const fs::path temporary = path.parent_path() / name;
  const std::scoped_lock lock(unfinished().mutex);
  unfinished().paths.push_back(temporary);
  return temporary;
}

void forget(const fs::path& temporary) {
  const std::scoped_lock lock(unfinished().mutex);
  std::erase(unfinished().paths, temporary);
}

void discard(const fs::path& temporary) noexcept {
  std::error_code ignored;
  fs::remove_all(temporary, ignored);
  forget(temporary);
}

void flush_to_disk(const fs::path& path) {  // best effort: some file systems refuse
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

fs::path folder_of(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

void move_into_place(const fs::path& from, const fs::path& to, Existing existing) {
  if (existing == Existing::replace) {
    if (::rename(from.c_str(), to.c_str()) != 0) fail(to, "cannot be written", errno);
    return;
  }
  if (::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) == 0) return;
  if (errno == EEXIST) refuse_existing(to);
  if (errno != EINVAL && errno != ENOSYS) fail(to, "cannot be written", errno);
  // A file system without RENAME_NOREPLACE (NFS): look, then rename.
  if (fs::exists(fs::symlink_status(to))) refuse_existing(to);
  if (::rename(from.c_str(), to.c_str()) != 0) fail(to, "cannot be written", errno);
}

/// Through a symbolic link the file it names is replaced, not the link.
fs::path resolved(fs::path path) {
  while (path.has_relative_path() && !path.has_filename()) path = path.parent_path();  // "dir/"
  std::error_code error;
  if (!fs::is_symlink(path, error)) return path;
  fs::path target = fs::weakly_canonical(path, error);
  return error ? path : target;
}

}  // namespace

void require_writable_place(const fs::path& path, Existing existing) {
  if (!path.has_filename()) throw InputError(path.string(), "is not the name of a file");
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (fs::is_directory(status)) throw InputError(path.string(), "is a folder, expected a file");
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    throw InputError(path.string(), "is not a regular file, so it cannot be replaced by one");
  }
  if (fs::exists(status) && existing == Existing::keep) refuse_existing(path);
  const fs::path folder = folder_of(path);
  if (!fs::is_directory(folder, error)) {
    throw InputError(path.string(), "cannot be written: there is no folder " + folder.string());
  }
}

AtomicFile::AtomicFile(fs::path path, Existing existing)
    : path_(resolved(std::move(path))), existing_(existing) {
  require_writable_place(path_, existing_);
  temporary_ = register_temporary(path_);
  file_ = std::fopen(temporary_.c_str(), "wbxe");
  if (file_ == nullptr) {
    const int error = errno;
    forget(temporary_);
    fail(path_, "cannot be written", error);
  }
}

AtomicFile::~AtomicFile() {
  if (file_ != nullptr) std::fclose(file_);
  if (!temporary_.empty()) discard(temporary_);
}

void AtomicFile::write(std::span<const std::byte> bytes) {
  require(file_ != nullptr, "AtomicFile is written before commit()");
  if (bytes.empty()) return;
  if (std::fwrite(bytes.data(), 1, bytes.size(), file_) != bytes.size()) {
    fail(path_, "cannot be written", errno);
  }
}

void AtomicFile::commit() {
  require(file_ != nullptr, "AtomicFile is committed once");
  const bool flushed =
      std::fflush(file_) == 0 && (::fsync(::fileno(file_)) == 0 || errno == EINVAL);
  const int error = errno;
  const bool closed = std::fclose(std::exchange(file_, nullptr)) == 0;
  if (!flushed || !closed) fail(path_, "cannot be written", flushed ? errno : error);
  move_into_place(temporary_, path_, existing_);
  forget(temporary_);
  temporary_.clear();
  flush_to_disk(folder_of(path_));
}

void write_whole(const fs::path& path, Existing existing, std::string_view text) {
  AtomicFile file(path, existing);
  file.write(text);
  file.commit();
}

AtomicFolder::AtomicFolder(fs::path path, Existing existing, std::string last,
                           std::vector<std::string> products)
    : path_(resolved(std::move(path))),
      existing_(existing),
      last_(std::move(last)),
      products_(std::move(products)) {
  std::error_code error;
  if (!path_.has_filename() || path_.filename() == "." || path_.filename() == "..") {
    path_ = fs::weakly_canonical(path_, error);  // "-o ." and "-o ..": a real name is needed
  }
  const fs::file_status status = fs::status(path_, error);
  if (fs::exists(status) && !fs::is_directory(status)) {
    throw InputError(path_.string(), "is a file, expected a folder for the products");
  }
  if (existing_ == Existing::keep && fs::exists(status) && !fs::is_empty(path_, error)) {
    throw InputError(path_.string(),
                     "is a folder with files in it, and they are kept; --force replaces the "
                     "products of an earlier run");
  }
  fs::create_directories(folder_of(path_), error);
  if (error) fail(path_, "cannot be created", error.value());
  temporary_ = register_temporary(path_);
  if (!fs::create_directory(temporary_, error)) {
    forget(temporary_);
    fail(path_, "cannot be created", error.value());
  }
}

AtomicFolder::~AtomicFolder() {
  if (!temporary_.empty()) discard(temporary_);
}

void AtomicFolder::commit() {
  require(!temporary_.empty(), "AtomicFolder is committed once");
  std::error_code error;
  if (!fs::exists(path_, error)) {
    move_into_place(temporary_, path_, Existing::keep);
  } else {
    std::vector<fs::path> names;
    for (const auto& entry : fs::directory_iterator(temporary_)) {
      names.push_back(entry.path().filename());
    }
    std::sort(names.begin(), names.end());
    std::stable_partition(names.begin(), names.end(),
                          [&](const fs::path& n) { return n != last_; });
    fs::remove(path_ / last_, error);
    for (const std::string& product : products_) {
      if (!fs::exists(temporary_ / product)) fs::remove(path_ / product, error);
    }
    for (const fs::path& name : names) {
      move_into_place(temporary_ / name, path_ / name, existing_);
    }
    fs::remove(temporary_, error);
  }
  forget(temporary_);
  temporary_.clear();
  flush_to_disk(folder_of(path_));
}

void remove_unfinished() noexcept {
  const std::scoped_lock lock(unfinished().mutex);
  std::error_code ignored;
  for (const fs::path& path : unfinished().paths) fs::remove_all(path, ignored);
}

}  // namespace fairway
