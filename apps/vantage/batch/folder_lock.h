// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace vantage::batch {

/// Keeps a second batch out of the same folder, or the same shard, while this one runs; gone with
/// the process however it ends.
class FolderLock {
 public:
  /// \throw IoError if another process holds it.
  FolderLock(const std::string& folder, const std::string& work_name);
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;
  ~FolderLock();

 private:
  int file_ = -1;
};

}  // namespace vantage::batch
