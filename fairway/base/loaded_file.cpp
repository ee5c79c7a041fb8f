#include "fairway/base/loaded_file.hpp"

#include <cerrno>
#include <cstring>
#include <string>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "fairway/base/error.hpp"

namespace fairway {
namespace {

struct Descriptor {
  int number;
  ~Descriptor() {
    if (number >= 0) ::close(number);
  }
};

}  // namespace

LoadedFile::LoadedFile(const std::filesystem::path& path) {
  const Descriptor file{::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)};
  if (file.number < 0) {
    throw InputError(path.string(), std::string("cannot be opened: ") + std::strerror(errno));
  }
  struct stat status {};
  if (::fstat(file.number, &status) != 0 || !S_ISREG(status.st_mode)) {
    throw InputError(path.string(), "is not a regular file");
  }
  const auto size = static_cast<std::size_t>(status.st_size);
  words_ = std::make_unique_for_overwrite<std::uint64_t[]>((size + 7) / 8);
  auto* const to = reinterpret_cast<char*>(words_.get());
  while (size_ < size) {
    const ssize_t n = ::read(file.number, to + size_, size - size_);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) {
      throw InputError(path.string(), std::string("cannot be read: ") + std::strerror(errno));
    }
    if (n == 0) throw InputError(path.string(), "became shorter while it was read");
    size_ += static_cast<std::size_t>(n);
  }
}

}  // namespace fairway
