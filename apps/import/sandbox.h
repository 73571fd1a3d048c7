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

  /// "Landlock 7, seccomp", or that limits of memory and time are all there is.
  [[nodiscard]] std::string text() const;
};

/// From then on no file is opened by its name (Landlock; without it, none for writing), nor made, written or
/// run; nothing is read from or sent to any network; no other process is started, traced or signalled. What
/// is open stays open. Where the kernel lacks one of the two the other still holds.
Confinement confine();

}  // namespace vantage::importing
