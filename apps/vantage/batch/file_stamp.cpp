// SPDX-License-Identifier: MIT
#include "batch/file_stamp.h"

#include <sys/stat.h>

namespace vantage::batch {

std::uint64_t bytes_on_disk(const std::string& path) {
  constexpr std::uint64_t kBytesPerBlock = 512;

  struct stat status {};

  return ::stat(path.c_str(), &status) == 0
             ? static_cast<std::uint64_t>(status.st_blocks) * kBytesPerBlock
             : 0;
}

FileStamp stamp_of(const std::string& path) {
  struct stat status {};

  if (path.empty() || ::stat(path.c_str(), &status) != 0) {
    return {};
  }
  return {status.st_size, status.st_mtim.tv_sec * 1'000'000'000LL + status.st_mtim.tv_nsec,
          status.st_ino};
}

}  // namespace vantage::batch
