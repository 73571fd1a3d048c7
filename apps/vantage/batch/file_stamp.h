// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

#include "batch/model_record.h"

namespace vantage::batch {

/// What a file takes on the disk, bytes; 0 if there is none.
std::uint64_t bytes_on_disk(const std::string& path);

/// By what a file is known to be the one that it was; of nothing if there is none.
FileStamp stamp_of(const std::string& path);

}  // namespace vantage::batch
