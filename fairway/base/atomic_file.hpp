// Products appear whole or not at all: written beside their place, then renamed into it.
//
// Properties that always hold:
//   1. A reader of `path` sees the old content or the new, never a part, even when the process is
//      killed or the disk is full.
//   2. Existing::keep never replaces anything: the check at the start spares the work, and the
//      rename itself refuses when somebody else put a file there meanwhile.
//   3. An object destroyed before commit() leaves nothing behind. A process killed outright leaves
//      at most a hidden `.NAME.partial-PID-N`, which the next to write NAME removes once its
//      process is gone; one that ends on a signal calls remove_unfinished().
//
// Every failure throws InputError naming the path: a place that cannot be written is bad input.
#pragma once

#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace fairway {

/// What to do with a product that is already there.
enum class Existing { keep, replace };

/// Throws InputError naming the file and --force when `path` exists and `existing` is keep, and
/// when its folder does not exist. For a check before long work; AtomicFile checks again.
void require_writable_place(const std::filesystem::path& path, Existing existing);

/// Throws InputError when `path` is the same file as one of `inputs`, whatever the names: what is
/// made of an input must not take its place.
void require_no_input(const std::filesystem::path& path,
                      std::span<const std::filesystem::path> inputs);

class AtomicFile {
 public:
  AtomicFile(std::filesystem::path path, Existing existing);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void write(std::span<const std::byte> bytes);
  void write(std::string_view text) { write(std::as_bytes(std::span(text.data(), text.size()))); }

  /// Where the bytes are until commit(), for libraries that want to write to a path of their own.
  const std::filesystem::path& temporary_path() const { return temporary_; }

  /// Flushes to the disk (fsync) and renames; nothing may be written afterwards.
  void commit();

 private:
  std::filesystem::path path_;
  std::filesystem::path temporary_;
  Existing existing_;
  std::FILE* file_ = nullptr;
};

/// The whole of a small product in one call.
void write_whole(const std::filesystem::path& path, Existing existing, std::string_view text);

/// A folder of products. With commit() a folder that did not exist appears in one rename. Into one
/// that exists (empty, or Existing::replace) the products move one by one, each whole, `last` at
/// the end after an old `last` was removed first: a folder with `last` in it is complete. Files of
/// other names are left alone. Before the first move everything is looked at: with Existing::keep a
/// folder that is not empty any more, with Existing::replace a folder in the place of a product,
/// throws and nothing was changed. Of several at once the last leaves its whole set.
class AtomicFolder {
 public:
  /// `products`: every name that may be written. Of these, what an earlier run left and this one
  /// does not write is removed. Throws when `path` is a file, or a folder that is not empty and
  /// `existing` is keep.
  AtomicFolder(std::filesystem::path path, Existing existing, std::string last,
               std::vector<std::string> products);
  ~AtomicFolder();
  AtomicFolder(const AtomicFolder&) = delete;
  AtomicFolder& operator=(const AtomicFolder&) = delete;

  /// The folder to write products in until commit().
  const std::filesystem::path& temporary_path() const { return temporary_; }
  void commit();

 private:
  void require_room(const std::vector<std::string>& names) const;
  void move_products();

  std::filesystem::path path_;
  std::filesystem::path temporary_;
  Existing existing_;
  int lock_ = -1;  ///< on the temporary folder, while the process lives
  std::string last_;
  std::vector<std::string> products_;
};

/// Removes what unfinished AtomicFiles and AtomicFolders have on disk; for a thread that is about
/// to end the process on a signal. Objects that live on must not be used any more.
void remove_unfinished() noexcept;

}  // namespace fairway
