// SPDX-License-Identifier: MIT
#include "batch/folder_lock.h"

#include <cerrno>
#include <filesystem>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include "vantage/core/error.h"

#include "batch/runner.h"

namespace vantage::batch {

FolderLock::FolderLock(const std::string& folder, const std::string& work_name) {
  const std::string work = work_folder(folder, "");
  std::error_code error;
  std::filesystem::create_directories(work, error);
  const std::string path = (std::filesystem::path(work) / (work_name + ".lock")).string();
  file_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (file_ < 0) {
    throw IoError(path, "cannot be created", errno);
  }
  if (::flock(file_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    ::close(file_);
    throw IoError(folder, "is in use by another batch; wait for it, or choose another folder");
  }
}

FolderLock::~FolderLock() {
  ::close(file_);
}

}  // namespace vantage::batch
