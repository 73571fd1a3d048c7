// SPDX-License-Identifier: MIT
#include "batch/worker_process.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "vantage/core/error.h"

#include "batch/descriptor.h"

namespace vantage::batch {
namespace {

void limit(int resource, std::uint64_t bytes) {
  if (bytes != 0) {
    const rlimit both{bytes, bytes};
    // glibc declares the first parameter as an enumeration in C++.
    ::setrlimit(static_cast<__rlimit_resource>(resource), &both);
  }
}

/// Between fork and exec: nothing but system calls is allowed.
void become_worker(char* const* arguments, const std::array<int, 2>& in,
                   const std::array<int, 2>& out, const WorkerLimits& limits, bool quiet,
                   pid_t parent) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) {  // the parent died before it could be watched
    ::_exit(1);
  }
  ::setpgid(0, 0);  // Ctrl-C is the parent's to answer
  ::dup2(in[0], STDIN_FILENO);
  ::dup2(out[1], STDOUT_FILENO);
  if (quiet) {
    const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
    ::dup2(nowhere, STDERR_FILENO);
  }
#if !defined(__SANITIZE_ADDRESS__)  // its shadow memory alone is terabytes of address space
  limit(RLIMIT_AS, limits.memory_bytes);
#endif
  limit(RLIMIT_FSIZE, limits.file_bytes);
  const rlimit none{0, 0};
  ::setrlimit(RLIMIT_CORE, &none);
  std::signal(SIGXFSZ, SIG_IGN);  // a file that grows too large is a failed write
  ::execv("/proc/self/exe", arguments);
  ::_exit(127);
}

}  // namespace

WorkerProcess::WorkerProcess(const std::vector<std::string>& arguments, const WorkerLimits& limits,
                             bool quiet) {
  std::vector<std::string> words = arguments;
  words.insert(words.begin(), "vantage");
  std::vector<char*> pointers;
  pointers.reserve(words.size() + 1);
  for (std::string& word : words) {
    pointers.push_back(word.data());
  }
  pointers.push_back(nullptr);
  std::array<int, 2> in{-1, -1};
  std::array<int, 2> out{-1, -1};
  if (::pipe2(in.data(), O_CLOEXEC) != 0) {
    throw IoError("worker", "no pipe can be made", errno);
  }
  if (::pipe2(out.data(), O_CLOEXEC) != 0) {
    const int error = errno;
    ::close(in[0]);
    ::close(in[1]);
    throw IoError("worker", "no pipe can be made", error);
  }
  const pid_t parent = ::getpid();
  pid_ = ::fork();
  if (pid_ == 0) {
    become_worker(pointers.data(), in, out, limits, quiet, parent);
  }
  const int error = errno;
  ::close(in[0]);
  ::close(out[1]);
  to_worker_ = in[1];
  from_worker_ = out[0];
  if (pid_ < 0) {
    ::close(to_worker_);
    ::close(from_worker_);
    throw IoError("worker", "no process can be started", error);
  }
}

WorkerProcess::~WorkerProcess() {
  end();
}

void WorkerProcess::send(const std::string& line) const {
  write_all(to_worker_, line + "\n");
}

bool WorkerProcess::receive() {
  std::array<char, 65536> block{};
  while (true) {
    const ssize_t got = ::read(from_worker_, block.data(), block.size());
    if (got > 0) {
      received_.append(block.data(), static_cast<std::size_t>(got));
      return true;
    }
    if (got == 0 || errno != EINTR) {
      closed_ = true;
      return false;
    }
  }
}

std::optional<std::string> WorkerProcess::line() {
  const std::size_t newline = received_.find('\n');
  if (newline == std::string::npos) {
    return std::nullopt;
  }
  std::string text = received_.substr(0, newline);
  received_.erase(0, newline + 1);
  return text;
}

std::optional<std::string> WorkerProcess::await_line(double timeout_s,
                                                     const std::stop_token& stop) {
  constexpr int kPollMs = 100;
  for (double waited_ms = 0.0; waited_ms < 1000.0 * timeout_s && !stop.stop_requested();) {
    if (std::optional<std::string> text = line()) {
      return text;
    }
    pollfd file{from_worker_, POLLIN, 0};
    const int ready = ::poll(&file, 1, kPollMs);
    if (ready > 0 && !receive()) {
      return line();
    }
    waited_ms += ready == 0 ? kPollMs : 0;
  }
  return std::nullopt;
}

int WorkerProcess::end() {
  if (pid_ > 0) {
    ::kill(pid_, SIGKILL);
    while (::waitpid(pid_, &status_, 0) < 0 && errno == EINTR) {
    }
    pid_ = -1;
    ::close(to_worker_);
    ::close(from_worker_);
  }
  return status_;
}

std::string seconds_text(double seconds) {
  std::string text = std::to_string(seconds);
  text.erase(text.find_last_not_of('0') + 1);
  return text.ends_with('.') ? text.substr(0, text.size() - 1) : text;
}

std::string how_it_ended(int wait_status) {
  if (WIFSIGNALED(wait_status)) {
    const int number = WTERMSIG(wait_status);
    return "signal " + std::to_string(number) + " (" + ::strsignal(number) + ")";
  }
  return "exit code " + std::to_string(WEXITSTATUS(wait_status));
}

}  // namespace vantage::batch
