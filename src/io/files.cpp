// SPDX-License-Identifier: MIT
#include "io/files.h"

#include <algorithm>
#include <cctype>
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

  /// Hands the descriptor over.
  int release() { return std::exchange(number_, -1); }

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

/// "folder/.name.part.123" for "folder/name" in process 123; a name too long for that is cut.
std::string temporary_path(const std::string& path) {
  constexpr std::size_t kLongestName = 255;
  const std::size_t name = path.find_last_of('/') + 1;
  const std::string end = ".part." + std::to_string(::getpid());
  return path.substr(0, name) + "." + path.substr(name, kLongestName - 1 - end.size()) + end;
}

/// "https://…" and the like.
bool is_url(std::string_view path) {
  const std::size_t scheme = path.find("://");
  return scheme != std::string_view::npos && scheme >= 2 &&
         std::all_of(path.begin(), path.begin() + static_cast<std::ptrdiff_t>(scheme),
                     [](unsigned char c) { return std::isalnum(c) != 0 || c == '+' || c == '.'; });
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

/// Writes to an open file and on to the disk. \return 0 or errno
int write_whole(int descriptor, std::string_view bytes) {
  const int error = write_all(descriptor, bytes);
  return error == 0 ? flush(descriptor) : error;
}

/// Gives a file without a name this one, in place of what has it. \return 0 or errno
int name_file(int descriptor, const std::string& path) {
  const std::string self = "/proc/self/fd/" + std::to_string(descriptor);
  const auto link_as = [&](const std::string& name) {
    const int failed = ::linkat(AT_FDCWD, self.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW);
    return failed == 0 ? 0 : errno;
  };
  if (const int error = link_as(path); error != EEXIST) {
    return error;
  }
  const std::string temporary = temporary_path(path);
  ::unlink(temporary.c_str());  // a dead process's, or a link that somebody laid there
  if (const int error = link_as(temporary); error != 0) {
    return error;
  }
  if (::rename(temporary.c_str(), path.c_str()) == 0) {
    return 0;
  }
  const int error = errno;
  ::unlink(temporary.c_str());
  return error;
}

/// Whether a file without a name could be given one.
bool can_be_named(int descriptor) {
  return ::access(("/proc/self/fd/" + std::to_string(descriptor)).c_str(), F_OK) == 0;
}

}  // namespace

StagedFile::StagedFile(std::string path, std::string_view bytes) : path_(std::move(path)) {
  if (!write_nameless(bytes)) {
    write_temporary(bytes);
  }
}

StagedFile::~StagedFile() {
  drop();
}

StagedFile::StagedFile(StagedFile&& other) noexcept
    : path_(std::move(other.path_)),
      temporary_(std::exchange(other.temporary_, {})),
      descriptor_(std::exchange(other.descriptor_, -1)) {}

StagedFile& StagedFile::operator=(StagedFile&& other) noexcept {
  if (this != &other) {
    drop();
    path_ = std::move(other.path_);
    temporary_ = std::exchange(other.temporary_, {});
    descriptor_ = std::exchange(other.descriptor_, -1);
  }
  return *this;
}

bool StagedFile::write_nameless(std::string_view bytes) {
  const std::size_t name = path_.find_last_of('/') + 1;
  const std::string folder = name == 0 ? "." : path_.substr(0, name);
  Descriptor file(::open(folder.c_str(), O_WRONLY | O_TMPFILE | O_CLOEXEC, 0666));
  // A set of many views would otherwise use up the process's descriptors.
  constexpr int kMostOpen = 256;
  if (file.number() < 0 || file.number() > kMostOpen || !can_be_named(file.number())) {
    return false;
  }
  if (const int error = write_whole(file.number(), bytes); error != 0) {
    throw IoError(path_, "cannot be written", error);
  }
  descriptor_ = file.release();
  return true;
}

void StagedFile::write_temporary(std::string_view bytes) {
  const std::string temporary = temporary_path(path_);
  Descriptor file(create_alone(temporary));
  if (file.number() < 0) {
    throw IoError(path_, "cannot be created", errno);
  }
  temporary_ = temporary;
  int error = write_whole(file.number(), bytes);
  const int close_error = file.close();
  error = error == 0 ? close_error : error;
  if (error != 0) {
    drop();
    throw IoError(path_, "cannot be written", error);
  }
}

void StagedFile::place() {
  int error = 0;
  if (descriptor_ >= 0) {
    error = name_file(descriptor_, path_);
  } else if (::rename(temporary_.c_str(), path_.c_str()) == 0) {
    temporary_.clear();
  } else {
    error = errno;
  }
  drop();
  if (error != 0) {
    throw IoError(path_, "cannot be written", error);
  }
}

void StagedFile::drop() noexcept {
  if (descriptor_ >= 0) {
    ::close(std::exchange(descriptor_, -1));
  }
  if (!temporary_.empty()) {
    ::unlink(temporary_.c_str());
    temporary_.clear();
  }
}

std::string read_file(const std::string& path) {
  if (path == "-") {
    return read_all(STDIN_FILENO, "standard input", 0);
  }
  // Not blocking: opening a pipe that nobody writes to would wait for ever.
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
  if (file.number() < 0) {
    if (errno == ENOENT && is_url(path)) {
      throw IoError(path, "is a web address, and only files are read; download it first");
    }
    throw IoError(path, "cannot be opened", errno);
  }

  struct stat status {};

  if (::fstat(file.number(), &status) != 0) {
    throw IoError(path, "cannot be examined", errno);
  }
  if (S_ISDIR(status.st_mode)) {
    throw IoError(path, "is a folder, not a file; vantage batch takes folders of models");
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

  if (::lstat(path.c_str(), &status) == 0) {
    if (S_ISDIR(status.st_mode)) {
      throw IoError(path, "is a folder, not a file");
    }
    if (S_ISCHR(status.st_mode) || S_ISBLK(status.st_mode)) {  // not to be replaced by a file
      write_in_place(path, bytes);
      return;
    }
  }
  StagedFile(path, bytes).place();
}

void write_named_file(const std::string& path, std::string_view bytes) {
  struct stat status {};

  if (path != "-" && ::stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode) &&
      !S_ISDIR(status.st_mode)) {
    write_in_place(path, bytes);  // a pipe has a reader, who waits
    return;
  }
  std::error_code error;
  const bool is_link = path != "-" && std::filesystem::is_symlink(path, error);
  const std::filesystem::path target =
      is_link ? std::filesystem::canonical(path, error) : std::filesystem::path(path);
  write_file(error ? path : target.string(), bytes);
}

}  // namespace vantage
