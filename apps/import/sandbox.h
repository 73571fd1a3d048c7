// SPDX-License-Identifier: MIT
#pragma once

#include <string>

/// \file
/// Before a file of a stranger is looked at, the process gives away what reading it does not need.

namespace vantage::importing {

/// What holds the process from then on.
struct Confinement {
  int landlock = 0;      ///< Version of the kernel's interface; 0: the kernel has none.
  bool seccomp = false;  ///< Whether system calls are filtered.

  /// "Landlock 7, seccomp", or "nothing …".
  [[nodiscard]] std::string text() const;
};

/// No file is opened any more by its name, nor made, written, listed or run; nothing is heard of or said
/// to any network; no other process is started, traced or signalled. What is open stays open. Where the
/// kernel lacks a means the others still hold.
Confinement confine();

}  // namespace vantage::importing
