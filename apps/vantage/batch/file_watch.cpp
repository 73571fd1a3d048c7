// SPDX-License-Identifier: MIT
#include "batch/file_watch.h"

#include <utility>

#include <fcntl.h>

#include "batch/file_stamp.h"

namespace vantage::batch {

FileWatch::FileWatch(std::string path)
    : path_(std::move(path)),
      held_(::open(path_.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC)),
      before_(stamp_of(held_)) {}

bool FileWatch::is_unchanged() const {
  return stamp_of(path_) == before_;
}

}  // namespace vantage::batch
