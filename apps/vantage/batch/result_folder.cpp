// SPDX-License-Identifier: MIT
#include "batch/result_folder.h"

#include <cerrno>
#include <cstdio>
#include <filesystem>

#include <fcntl.h>

#include "vantage/core/error.h"

namespace vantage::batch {

void move_into_place(const std::string& finished, const std::string& place) {
  namespace fs = std::filesystem;
  std::error_code error;
  fs::create_directories(fs::path(place).parent_path(), error);
  if (error) {
    throw IoError(place, "cannot be created", error.value());
  }
  if (::rename(finished.c_str(), place.c_str()) == 0) {
    return;
  }
  // The place is taken by an earlier result. File systems without an exchange leave a moment in
  // which there is no result, never half of one.
  if (::renameat2(AT_FDCWD, finished.c_str(), AT_FDCWD, place.c_str(), RENAME_EXCHANGE) == 0) {
    fs::remove_all(finished, error);
    return;
  }
  fs::remove_all(place, error);
  if (::rename(finished.c_str(), place.c_str()) != 0) {
    throw IoError(place, "cannot be put in place", errno);
  }
}

}  // namespace vantage::batch
