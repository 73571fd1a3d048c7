// SPDX-License-Identifier: MIT
#include "io/files.h"

#include <cerrno>
#include <filesystem>
#include <new>
#include <string_view>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "vantage/core/error.h"
#include "vantage/io/write.h"

namespace vantage {
namespace {

/// A file descriptor that closes itself.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}

  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  ~Descriptor() {
    if (number_ >= 0) {
      ::close(number_);
    }
  }

  [[nodiscard]] int number() const { return number_; }

  /// Closes now. \return 0 or errno.
  int close() { return ::close(std::exchange(number_, -1)) == 0 ? 0 : errno; }

 private:
  int number_;
};

/// Reads to the end. \param expected size to make room for at once.
std::string read_all(int descriptor, const std::string& path, std::size_t expected) {
  constexpr std::size_t kLeastChunk = 1 << 16;
  std::string bytes;
  std::size_t held = 0;
  try {
    bytes.resize(expected + 1);  // one more, to see the end without growing
    while (true) {
      if (held == bytes.size()) {
        bytes.resize(bytes.size() * 2 + kLeastChunk);
      }
      const ssize_t got = ::read(descriptor, bytes.data() + held, bytes.size() - held);
      if (got == 0) {
        break;
      }
      if (got < 0 && errno != EINTR) {
        throw IoError(path, "cannot be read", errno);
      }
      held += got > 0 ? static_cast<std::size_t>(got) : 0;
    }
    bytes.resize(held);
  } catch (const std::bad_alloc&) {
    throw IoError(path, "does not fit into memory", ENOMEM);
  }
  return bytes;
}

/// 0 or errno.
int write_all(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t done = ::write(descriptor, bytes.data(), bytes.size());
    if (done < 0 && errno != EINTR) {
      return errno;
    }
    bytes.remove_prefix(done > 0 ? static_cast<std::size_t>(done) : 0);
  }
  return 0;
}

/// "folder/.name.part.123" for "folder/name" in process 123.
std::string temporary_path(const std::string& path) {
  const std::size_t name = path.find_last_of('/') + 1;
  return path.substr(0, name) + "." + path.substr(name) + ".part." + std::to_string(::getpid());
}

void write_in_place(const std::string& path, std::string_view bytes) {
  const Descriptor device(::open(path.c_str(), O_WRONLY | O_CLOEXEC));
  const int error = device.number() < 0 ? errno : write_all(device.number(), bytes);
  if (error != 0) {
    throw IoError(path, "cannot be written", error);
  }
}

/// Some file systems cannot flush and say so; that is no failure.
int flush(int descriptor) {
  return ::fsync(descriptor) == 0 || errno == EINVAL || errno == ENOTSUP ? 0 : errno;
}

/// A new file for writing, or -1 and errno. What bears its name already is a dead process's, or a
/// link that somebody laid in a shared folder: it goes, and is never written through.
int create_alone(const std::string& path) {
  constexpr int kFlags = O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC;
  const int first = ::open(path.c_str(), kFlags, 0666);
  if (first >= 0 || errno != EEXIST || ::unlink(path.c_str()) != 0) {
    return first;
  }
  return ::open(path.c_str(), kFlags, 0666);
}

/// \param path name for messages. \param target the file behind it, links followed.
void replace_file(const std::string& path, const std::string& target, std::string_view bytes) {
  const std::string temporary = temporary_path(target);
  Descriptor file(create_alone(temporary));
  if (file.number() < 0) {
    throw IoError(path, "cannot be created", errno);
  }
  int error = write_all(file.number(), bytes);
  error = error == 0 ? flush(file.number()) : error;
  const int close_error = file.close();
  error = error == 0 ? close_error : error;
  if (error == 0 && ::rename(temporary.c_str(), target.c_str()) != 0) {
    error = errno;
  }
  if (error != 0) {
    ::unlink(temporary.c_str());
    throw IoError(path, "cannot be written", error);
  }
}

}  // namespace

std::string read_file(const std::string& path) {
  if (path == "-") {
    return read_all(STDIN_FILENO, "standard input", 0);
  }
  // Not blocking: opening a pipe that nobody writes to would wait for ever.
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
  if (file.number() < 0) {
    throw IoError(path, "cannot be opened", errno);
  }

  struct stat status {};

  if (::fstat(file.number(), &status) != 0) {
    throw IoError(path, "cannot be examined", errno);
  }
  if (S_ISDIR(status.st_mode)) {
    throw IoError(path, "is a folder, not a file");
  }
  if (!S_ISREG(status.st_mode)) {
    throw IoError(path, "is not a regular file; use - to read from a pipe");
  }
  return read_all(file.number(), path, static_cast<std::size_t>(status.st_size));
}

void write_file(const std::string& path, std::string_view bytes) {
  if (path == "-") {
    if (const int error = write_all(STDOUT_FILENO, bytes); error != 0) {
      throw IoError("standard output", "cannot be written", error);
    }
    return;
  }

  struct stat status {};

  if (::stat(path.c_str(), &status) == 0) {
    if (S_ISDIR(status.st_mode)) {
      throw IoError(path, "is a folder, not a file");
    }
    if (!S_ISREG(status.st_mode)) {  // a device or a pipe must not be replaced by a file
      write_in_place(path, bytes);
      return;
    }
  }
  std::error_code no_such_file;
  const std::filesystem::path target = std::filesystem::canonical(path, no_such_file);
  replace_file(path, no_such_file ? path : target.string(), bytes);
}

}  // namespace vantage
