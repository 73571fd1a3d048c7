// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <stop_token>
#include <string>

namespace vantage::batch {

/// The bytes of a file, a pipe or standard input. Waiting for them ends when a stop is requested.
class StoppableBytes {
 public:
  /// \param path "-" is standard input. \throw IoError if it cannot be opened.
  StoppableBytes(const std::string& path, std::stop_token stop);
  StoppableBytes(const StoppableBytes&) = delete;
  StoppableBytes& operator=(const StoppableBytes&) = delete;
  ~StoppableBytes();

  /// The next byte; nothing at the end. \throw IoError, Cancelled
  std::optional<char> next() {
    return at_ < held_.size() || fill() ? std::optional(held_[at_++]) : std::nullopt;
  }

  /// Whether next() has something to return, the end included, without waiting.
  [[nodiscard]] bool is_there() const;

 private:
  /// \return false at the end.
  bool fill();
  void wait() const;

  std::string path_;
  std::stop_token stop_;
  int file_ = -1;
  std::string held_{};
  std::size_t at_ = 0;
};

}  // namespace vantage::batch
