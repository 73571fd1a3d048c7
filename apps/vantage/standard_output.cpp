// SPDX-License-Identifier: MIT
#include "standard_output.h"

#include <cerrno>
#include <cstdio>

#include "vantage/core/error.h"

namespace vantage::cli {

void finish_standard_output() {
  errno = 0;
  const bool flushed = std::fflush(stdout) == 0;
  if (!flushed || std::ferror(stdout) != 0) {
    throw IoError("standard output", "cannot be written", flushed ? EIO : errno);
  }
}

}  // namespace vantage::cli
