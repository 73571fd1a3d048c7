// SPDX-License-Identifier: MIT
#pragma once

namespace vantage::cli {

/// Writes what is still held back for standard output. \throw IoError if any of what was printed so
/// far could not be written.
void finish_standard_output();

}  // namespace vantage::cli
