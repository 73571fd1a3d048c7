// SPDX-License-Identifier: MIT
#include "batch/file_stamp.h"

#include <algorithm>
#include <filesystem>

#include <sys/stat.h>

#include "batch/naming.h"

namespace vantage::batch {
namespace {

FileStamp stamp_from(const struct stat& status) {
  return {status.st_size, status.st_mtim.tv_sec * 1'000'000'000LL + status.st_mtim.tv_nsec,
          status.st_ino};
}

}  // namespace

std::uint64_t bytes_on_disk(const std::string& path) {
  constexpr std::uint64_t kBytesPerBlock = 512;

  struct stat status {};

  return ::stat(path.c_str(), &status) == 0
             ? static_cast<std::uint64_t>(status.st_blocks) * kBytesPerBlock
             : 0;
}

FileStamp stamp_of(const std::string& path) {
  struct stat status {};

  return !path.empty() && ::stat(path.c_str(), &status) == 0 ? stamp_from(status) : FileStamp{};
}

FileStamp stamp_of(const Descriptor& file) {
  struct stat status {};

  return ::fstat(file.number(), &status) == 0 ? stamp_from(status) : FileStamp{};
}

bool are_as_they_were(const std::vector<StampBeside>& beside, const std::string& model_path) {
  const std::filesystem::path folder = std::filesystem::path(model_path).parent_path();
  return std::all_of(beside.begin(), beside.end(), [&](const StampBeside& file) {
    return stamp_of((folder / path_of_key(file.name)).string()) == file.stamp;
  });
}

}  // namespace vantage::batch
