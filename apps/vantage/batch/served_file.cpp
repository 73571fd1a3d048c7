// SPDX-License-Identifier: MIT
#include "batch/served_file.h"

#include <iterator>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace vantage::batch {

std::shared_ptr<const ServedFile> ServedFile::open(const std::filesystem::path& root,
                                                   const std::filesystem::path& path) {
  int at = ::open(root.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC);
  for (auto part = path.begin(); at >= 0 && part != path.end(); ++part) {
    const bool is_last = std::next(part) == path.end();
    const int how = is_last ? O_RDONLY | O_NONBLOCK : O_PATH | O_DIRECTORY;
    const int next = *part == ".." ? -1 : ::openat(at, part->c_str(), how | O_NOFOLLOW | O_CLOEXEC);
    ::close(at);
    at = next;
  }
  if (at < 0) {
    return nullptr;
  }

  struct stat status {};

  if (::fstat(at, &status) != 0 || !S_ISREG(status.st_mode)) {
    ::close(at);
    return nullptr;
  }
  return std::shared_ptr<const ServedFile>(
      new ServedFile(at, static_cast<std::size_t>(status.st_size)));
}

ServedFile::~ServedFile() {
  ::close(file_);
}

std::size_t ServedFile::read(std::size_t offset, char* bytes, std::size_t size) const {
  const ssize_t got = ::pread(file_, bytes, size, static_cast<off_t>(offset));
  return got > 0 ? static_cast<std::size_t>(got) : 0;
}

}  // namespace vantage::batch
