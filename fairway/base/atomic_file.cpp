#include "fairway/base/atomic_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <optional>
#include <string>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include "fairway/base/error.hpp"
#include "fairway/base/unfinished.hpp"

namespace fairway {
namespace {

namespace fs = std::filesystem;
using unfinished::discard;
using unfinished::forget;
using unfinished::Lock;
using unfinished::register_temporary;

[[noreturn]] void fail(const fs::path& path, const char* what, int error) {
  throw InputError(path.string(), std::string(what) + ": " + std::strerror(error));
}

[[noreturn]] void refuse_existing(const fs::path& path) {
  throw InputError(path.string(), "already exists; use --force to overwrite it");
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
    throw InputError(path.string(), "cannot be written: no such folder: " + folder.string());
  }
}

void require_no_input(const fs::path& path, std::span<const fs::path> inputs) {
  for (const fs::path& input : inputs) {
    std::error_code error;
    if (!fs::equivalent(path, input, error) || error) continue;
    const std::string also = path == input ? "" : ", under the name " + input.string();
    throw InputError(path.string(), "is an input" + also + "; write the output to another file");
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
  static_cast<void>(::flock(::fileno(file_), LOCK_EX | LOCK_NB));  // for sweep() elsewhere
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
    path_ = fs::weakly_canonical(path_, error);  // "-o ." and "-o ..": need a real name
  }
  const fs::file_status status = fs::status(path_, error);
  if (fs::exists(status) && !fs::is_directory(status)) {
    throw InputError(path_.string(), "is a file, expected a folder for the products");
  }
  if (fs::exists(status)) require_room(products_);
  fs::create_directories(folder_of(path_), error);
  if (error) fail(path_, "cannot be created", error.value());
  temporary_ = register_temporary(path_);
  if (!fs::create_directory(temporary_, error)) {
    forget(temporary_);
    fail(path_, "cannot be created", error ? error.value() : EEXIST);
  }
  lock_ = Lock(temporary_, false).release();
}

AtomicFolder::~AtomicFolder() {
  if (!temporary_.empty()) discard(temporary_);
  if (lock_ >= 0) ::close(lock_);
}

/// Throws unless products of these names can be moved into the existing folder.
void AtomicFolder::require_room(const std::vector<std::string>& names) const {
  std::error_code error;
  if (existing_ == Existing::keep) {
    if (fs::is_empty(path_, error) && !error) return;
    if (error) fail(path_, "cannot be read", error.value());
    throw InputError(path_.string(),
                     "is a folder that is not empty; use --force to replace the "
                     "products of an earlier run");
  }
  for (const std::string& name : names) {
    if (fs::is_directory(fs::symlink_status(path_ / name, error))) {
      throw InputError((path_ / name).string(),
                       "is a folder where a product belongs; nothing was replaced");
    }
  }
}

void AtomicFolder::commit() {
  require(!temporary_.empty(), "AtomicFolder is committed once");
  std::error_code error;
  const auto is_there = [&] { return fs::exists(fs::symlink_status(path_, error)); };
  bool moved = false;
  if (!is_there()) {
    try {
      move_into_place(temporary_, path_, Existing::keep);
      moved = true;
    } catch (const InputError&) {
      if (!is_there()) throw;  // else it appeared meanwhile: it is checked like any other
    }
  }
  if (!moved) move_products();
  forget(temporary_);
  temporary_.clear();
  ::close(std::exchange(lock_, -1));  // by now it may lock the folder at its destination
  flush_to_disk(folder_of(path_));
}

/// One by one, into an existing folder. Simultaneous runs commit one after another, each whole;
/// the check and the renames notice writers that do not take the lock.
void AtomicFolder::move_products() {
  if (!fs::is_directory(path_)) {
    throw InputError(path_.string(), "is now a file, expected a folder for the products");
  }
  const Lock one_at_a_time(path_, true);
  std::error_code error;
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(temporary_)) {
    names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  std::stable_partition(names.begin(), names.end(),
                        [&](const std::string& n) { return n != last_; });
  std::vector<std::string> all = products_;
  all.insert(all.end(), names.begin(), names.end());
  require_room(all);
  if (existing_ == Existing::replace) {
    fs::remove(path_ / last_, error);
    for (const std::string& product : products_) {
      if (!fs::exists(temporary_ / product)) fs::remove(path_ / product, error);
    }
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    try {
      move_into_place(temporary_ / names[i], path_ / names[i], existing_);
    } catch (const InputError&) {
      // Nothing was to be replaced in an empty folder: remove what we moved there.
      for (std::size_t back = 0; back < i && existing_ == Existing::keep; ++back) {
        fs::rename(path_ / names[back], temporary_ / names[back], error);
      }
      throw;
    }
  }
  fs::remove(temporary_, error);
}

}  // namespace fairway
