// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

/// \file
/// How many faces a model may have where nobody says so: ReadOptions::max_faces.

namespace vantage {

/// Memory that this process may use, bytes: of the machine, or what its control groups leave it.
std::uint64_t usable_memory_bytes();

/// Faces that so much memory has room for, with all that a view computes of them: two digits and
/// zeros, so that like machines say the same; at least 100 000.
std::size_t faces_that_fit(std::uint64_t memory_bytes);

}  // namespace vantage
