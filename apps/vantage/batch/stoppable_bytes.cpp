// SPDX-License-Identifier: MIT
#include "batch/stoppable_bytes.h"

#include <cerrno>
#include <utility>

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include "vantage/core/error.h"

namespace vantage::batch {
namespace {

constexpr std::size_t kChunk = 1U << 16U;
constexpr int kPulse = 20;  ///< ms between two looks whether to stop.

}  // namespace

// A pipe is opened without waiting for its writer: wait() does that.
StoppableBytes::StoppableBytes(const std::string& path, std::stop_token stop)
    : path_(path),
      stop_(std::move(stop)),
      file_(path == "-" ? STDIN_FILENO : ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC)) {
  if (file_ < 0) {
    throw IoError(path_, "cannot be read", errno);
  }
}

StoppableBytes::~StoppableBytes() {
  if (file_ != STDIN_FILENO) {
    ::close(file_);
  }
}

void StoppableBytes::wait() const {
  pollfd ready{.fd = file_, .events = POLLIN, .revents = 0};
  do {
    if (stop_.stop_requested()) {
      throw Cancelled();
    }
  } while (::poll(&ready, 1, kPulse) == 0);
}

bool StoppableBytes::is_there() const {
  pollfd ready{.fd = file_, .events = POLLIN, .revents = 0};
  return at_ < held_.size() || ::poll(&ready, 1, 0) != 0;
}

bool StoppableBytes::fill() {
  at_ = 0;
  for (;;) {
    wait();
    held_.resize(kChunk);
    const ssize_t got = ::read(file_, held_.data(), held_.size());
    if (got < 0 && errno != EINTR && errno != EAGAIN) {
      const int error = errno;
      held_.clear();
      throw IoError(path_, "cannot be read", error);
    }
    held_.resize(got < 0 ? 0 : static_cast<std::size_t>(got));
    if (got >= 0) {
      return got > 0;
    }
  }
}

}  // namespace vantage::batch
