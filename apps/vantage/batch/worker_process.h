// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include <sys/types.h>

namespace vantage::batch {

/// Limits of one worker process, set by the kernel.
struct WorkerLimits {
  std::uint64_t memory_bytes = 0;  ///< Address space; 0: unlimited.
  std::uint64_t file_bytes = 0;    ///< Largest file it may write; 0: unlimited.
};

/// A child process that runs this program again and speaks in lines over two pipes. It dies with
/// its parent, however that ends, and takes none of the parent's files with it.
class WorkerProcess {
 public:
  /// Starts `arguments` (the program is this one). \param quiet sends its messages nowhere.
  /// \throw IoError
  WorkerProcess(const std::vector<std::string>& arguments, const WorkerLimits& limits, bool quiet);
  WorkerProcess(const WorkerProcess&) = delete;
  WorkerProcess& operator=(const WorkerProcess&) = delete;
  /// Kills and awaits it.
  ~WorkerProcess();

  /// Descriptor that is readable when the worker has something to say or has ended.
  [[nodiscard]] int descriptor() const { return from_worker_; }

  /// Sends one line; a worker that has died is noticed when reading.
  void send(const std::string& line) const;

  /// Reads what is there. \return false once the worker has closed its end.
  bool receive();

  /// The next whole line received, if there is one.
  std::optional<std::string> line();

  /// Waits for a whole line; empty if the worker ends, the time is over or a stop is requested.
  std::optional<std::string> await_line(double timeout_s, const std::stop_token& stop);

  /// Whether it has closed its end, which it does by ending.
  [[nodiscard]] bool has_closed() const { return closed_; }

  /// Kills it and waits. \return how it ended, as waitpid() says.
  int end();

 private:
  pid_t pid_ = -1;
  int to_worker_ = -1;
  int from_worker_ = -1;
  int status_ = 0;
  bool closed_ = false;
  std::string received_{};
};

/// 300 → "300", 0.5 → "0.5".
std::string seconds_text(double seconds);

/// "signal 11 (Segmentation fault)", "exit code 3".
std::string how_it_ended(int wait_status);

}  // namespace vantage::batch
