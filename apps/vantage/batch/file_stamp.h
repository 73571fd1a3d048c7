// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "batch/descriptor.h"
#include "batch/model_record.h"

namespace vantage::batch {

/// What a file takes on the disk, bytes; 0 if there is none.
std::uint64_t bytes_on_disk(const std::string& path);

/// Size, time and inode, by which an unchanged file is known; empty if there is no file.
FileStamp stamp_of(const std::string& path);

/// The same of an open file.
FileStamp stamp_of(const Descriptor& file);

/// Whether the files beside a model look as they did when it was read.
bool are_as_they_were(const std::vector<StampBeside>& beside, const std::string& model_path);

}  // namespace vantage::batch
