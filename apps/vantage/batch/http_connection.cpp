// SPDX-License-Identifier: MIT
#include "batch/http_connection.h"

#include <algorithm>

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

namespace vantage::batch {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t kLargestRequest = 1U << 16U;  ///< Bytes; requests carry no body.
constexpr auto kFirstRequest = 1s;  ///< Begins within that time; browsers open some for later.
constexpr auto kBetweenRequests = 5s;
constexpr auto kOneRequest = 5s;
constexpr auto kOneWrite = 10s;  ///< Until the other side takes more.
constexpr int kPulse = 20;       ///< ms between two looks whether the server is to stop.

}  // namespace

HttpConnection::HttpConnection(int socket, const std::atomic<bool>& ended)
    : socket_(socket), ended_(ended), patience_(kFirstRequest) {}

HttpConnection::~HttpConnection() {
  ::shutdown(socket_, SHUT_RDWR);
  ::close(socket_);
}

bool HttpConnection::wait(short event, Clock::time_point end) const {
  pollfd ready{.fd = socket_, .events = event, .revents = 0};
  while (!ended_ && Clock::now() < end) {
    const int found = ::poll(&ready, 1, kPulse);
    if (found != 0) {
      return found > 0;
    }
  }
  return false;
}

bool HttpConnection::fill() {
  const ssize_t got = ::recv(socket_, buffer_.data(), buffer_.size(), 0);
  at_ = 0;
  held_ = got > 0 ? static_cast<std::size_t>(got) : 0;
  return got > 0;
}

bool HttpConnection::wait_for_request() {
  taken_ = 0;
  const bool comes = is_readable() || (wait(POLLIN, Clock::now() + patience_) && fill());
  patience_ = kBetweenRequests;
  end_ = Clock::now() + kOneRequest;
  return comes;
}

void HttpConnection::drain() {
  constexpr std::size_t kMost = 1U << 20U;
  ::shutdown(socket_, SHUT_WR);
  const Clock::time_point end = Clock::now() + 1s;
  for (std::size_t read = 0; read < kMost && wait(POLLIN, end) && fill();) {
    read += held_;
  }
}

ssize_t HttpConnection::read(char* bytes, std::size_t size) {
  if (taken_ >= kLargestRequest || (!is_readable() && !(wait(POLLIN, end_) && fill()))) {
    return -1;
  }
  const std::size_t count = std::min(size, held_ - at_);
  std::copy_n(buffer_.data() + at_, count, bytes);
  at_ += count;
  taken_ += count;
  return static_cast<ssize_t>(count);
}

ssize_t HttpConnection::write(const char* bytes, std::size_t size) {
  if (!wait(POLLOUT, Clock::now() + kOneWrite)) {
    return -1;
  }
  return ::send(socket_, bytes, size, MSG_NOSIGNAL | MSG_DONTWAIT);
}

void HttpConnection::get_remote_ip_and_port(std::string& ip, int& port) const {
  ip = "127.0.0.1";
  port = 0;
}

void HttpConnection::get_local_ip_and_port(std::string& ip, int& port) const {
  get_remote_ip_and_port(ip, port);
}

}  // namespace vantage::batch
