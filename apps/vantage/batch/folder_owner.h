// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace vantage::batch {

/// Refuses a folder with files that no batch has put there, and makes one that is missing. A folder
/// is a batch's own if it has a results store or a shard's records, or nothing but what a batch has
/// before its first record. \throw IoError
void prepare_folder(const std::string& folder);

}  // namespace vantage::batch
