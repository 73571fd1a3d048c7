// SPDX-License-Identifier: MIT
#include "batch/folder_lock.h"

#include <cerrno>
#include <chrono>
#include <thread>

#include <fcntl.h>
#include <sys/file.h>

#include "vantage/core/error.h"

namespace vantage::batch {
namespace {

Descriptor opened(const ConfinedFolder& folder, const std::string& work_name) {
  folder.make_folders(".work");
  const std::string name = ".work/" + work_name + ".lock";
  Descriptor file(folder.open_file(name, O_RDWR | O_CREAT));
  if (file.number() < 0) {
    throw IoError(folder.path_of(name), "cannot be created", errno);
  }
  return file;
}

/// Whether nobody else holds it. Locks that a file system does not have are held by nobody.
bool is_taken(const Descriptor& file) {
  return ::flock(file.number(), LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;
}

}  // namespace

FolderLock::FolderLock(const ConfinedFolder& folder, const std::string& work_name)
    : file_(opened(folder, work_name)) {
  if (!is_taken(file_)) {
    throw IoError(folder.path(),
                  "is in use by another batch; wait for it, or choose another folder");
  }
}

FolderLock::FolderLock(const ConfinedFolder& folder, const std::string& work_name,
                       const RunContext& run)
    : file_(opened(folder, work_name)) {
  constexpr std::chrono::milliseconds kPause(50);
  while (!is_taken(file_)) {
    run.check();
    std::this_thread::sleep_for(kPause);
  }
}

}  // namespace vantage::batch
