// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <string>

#include <httplib.h>

namespace vantage::batch {

/// A connection whose requests have an end: each may have so many bytes and take so long, and all
/// waiting ends with the server.
class HttpConnection final : public httplib::Stream {
 public:
  /// \param ended set when the server ends; outlives this. The socket is closed with this.
  HttpConnection(int socket, const std::atomic<bool>& ended);

  HttpConnection(const HttpConnection&) = delete;
  HttpConnection& operator=(const HttpConnection&) = delete;
  ~HttpConnection() override;

  /// Waits for the next request. \return false if none comes.
  bool wait_for_request();

  /// Reads away what is left of the last request, so that its answer is not lost with it.
  void drain();

  bool is_readable() const override { return at_ < held_; }

  bool is_writable() const override { return !ended_; }

  ssize_t read(char* bytes, std::size_t size) override;
  ssize_t write(const char* bytes, std::size_t size) override;
  void get_remote_ip_and_port(std::string& ip, int& port) const override;
  void get_local_ip_and_port(std::string& ip, int& port) const override;

  socket_t socket() const override { return socket_; }

 private:
  using Clock = std::chrono::steady_clock;

  bool wait(short event, Clock::time_point end) const;
  bool fill();

  int socket_;
  const std::atomic<bool>& ended_;
  std::array<char, 4096> buffer_{};
  std::size_t at_ = 0;
  std::size_t held_ = 0;
  std::size_t taken_ = 0;  ///< Bytes of this request.
  Clock::time_point end_{};
  std::chrono::seconds patience_;  ///< Until the next request begins.
};

}  // namespace vantage::batch
