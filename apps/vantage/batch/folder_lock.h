// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "vantage/core/run_context.h"

#include "batch/confined_folder.h"
#include "batch/descriptor.h"

namespace vantage::batch {

/// Keeps a second batch out of the same folder, or the same shard, while this one runs; gone with
/// the process however it ends.
class FolderLock {
 public:
  /// \throw IoError if another process holds it.
  FolderLock(const ConfinedFolder& folder, const std::string& work_name);

  /// Waits until nobody else holds it. \throw IoError, Cancelled
  FolderLock(const ConfinedFolder& folder, const std::string& work_name, const RunContext& run);

 private:
  Descriptor file_;
};

}  // namespace vantage::batch
