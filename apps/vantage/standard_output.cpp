// SPDX-License-Identifier: MIT
#include "standard_output.h"

#include <cerrno>
#include <csignal>
#include <cstdio>

#include <poll.h>
#include <pthread.h>
#include <unistd.h>

#include "vantage/core/error.h"

namespace vantage::cli {

void write_standard_output(const std::string& text) {
  errno = 0;
  if (std::fputs(text.c_str(), stdout) < 0) {  // of a long text the first part is flushed here
    throw IoError("standard output", "cannot be written", errno);
  }
}

void finish_standard_output() {
  errno = 0;
  const bool flushed = std::fflush(stdout) == 0;
  if (!flushed || std::ferror(stdout) != 0) {
    throw IoError("standard output", "cannot be written", flushed ? EIO : errno);
  }
}

bool reader_has_gone() {
  pollfd output{STDOUT_FILENO, POLLOUT, 0};
  return ::poll(&output, 1, 0) > 0 && (output.revents & POLLERR) != 0;
}

void end_by_closed_pipe() {
  constexpr int kAsShellsSayIt = 128 + SIGPIPE;
  std::signal(SIGPIPE, SIG_DFL);
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGPIPE);
  pthread_sigmask(SIG_UNBLOCK, &set, nullptr);
  std::raise(SIGPIPE);
  _exit(kAsShellsSayIt);
}

}  // namespace vantage::cli
