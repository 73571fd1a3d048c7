// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "batch/descriptor.h"
#include "batch/model_record.h"

namespace vantage::batch {

/// Tells whether a path names the file that it named before, unchanged: also where others were in its place meanwhile. It
/// keeps that file open, so that no other is given its inode.
class FileWatch {
 public:
  explicit FileWatch(std::string path);

  [[nodiscard]] bool is_unchanged() const;

 private:
  std::string path_;
  Descriptor held_;
  FileStamp before_;
};

}  // namespace vantage::batch
