// Products appear whole or not at all: written next to their destination, then renamed to it.
//
// Properties that always hold:
//   1. A reader of `path` sees the old content or the new, never a part, even when the process is
//      killed or the disk is full.
//   2. Existing::keep never replaces anything: the check at the start saves the work, and the
//      rename itself fails if a file has appeared there in the meantime.
//   3. An object destroyed before commit() leaves nothing behind. A process killed outright leaves
//      at most a hidden `.NAME.partial-PID-N`, which the next writer of NAME removes once that
//      process is gone; a process that ends on a signal calls remove_unfinished().
//
// Every failure throws InputError naming the path: an unwritable destination is bad input.
#pragma once

#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace fairway {

/// What to do with a product that already exists.
enum class Existing { keep, replace };

/// Throws InputError naming the file and --force when `path` exists and `existing` is keep, and
/// when its folder does not exist. For checks before long work; AtomicFile checks again.
void require_writable_place(const std::filesystem::path& path, Existing existing);

/// Throws InputError when `path` is the same file as one of `inputs`, under any name: an output
/// must not replace an input.
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

  /// Where the bytes are until commit(), for libraries that write to a path themselves.
  const std::filesystem::path& temporary_path() const { return temporary_; }

  /// Flushes to the disk (fsync) and renames; nothing may be written afterwards.
  void commit();

 private:
  std::filesystem::path path_;
  std::filesystem::path temporary_;
  Existing existing_;
  std::FILE* file_ = nullptr;
};

/// Writes a small product in one call.
void write_whole(const std::filesystem::path& path, Existing existing, std::string_view text);

/// A folder of products. If the folder did not exist, commit() makes it appear in one rename. If it
/// exists (empty, or Existing::replace), the products move one by one, each whole: an old `last` is
/// removed first and the new one moves at the end, so a folder with `last` in it is complete. Files
/// of other names are left alone. Everything is checked before the first move: with Existing::keep
/// a folder that is no longer empty, with Existing::replace a folder where a product belongs,
/// throws and nothing has changed. Of several simultaneous commits, the last leaves its whole set.
class AtomicFolder {
 public:
  /// `products`: every name that may be written. Of these, files left by an earlier run that this
  /// one does not write are removed. Throws when `path` is a file, or a folder that is not empty
  /// and `existing` is keep.
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

/// Removes what unfinished AtomicFiles and AtomicFolders have on disk, for a thread that is about
/// to end the process on a signal. Objects still alive must not be used afterwards.
void remove_unfinished() noexcept;

}  // namespace fairway
