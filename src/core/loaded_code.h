// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

/// \file
/// Which program is running, by its bytes: versions stay the same while a program is worked on.

namespace vantage {

/// FNV-1a, 64 bit, of the code and constants of the program or shared library that holds `address`,
/// as they lie in memory: what is written to, and what the loader moves, is left out. The same for
/// every run of the same file; 0 if nothing holds the address.
std::uint64_t loaded_code(const void* address);

/// Of the program or library that holds this library's code.
std::uint64_t loaded_code();

}  // namespace vantage
