// SPDX-License-Identifier: MIT
#pragma once

namespace vantage::batch {

/// What is wrong with a store or a folder of results where the disk is full.
inline constexpr const char* kNoRoom = "cannot hold more results; make room and run it again";

}  // namespace vantage::batch
