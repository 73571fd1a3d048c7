// SPDX-License-Identifier: MIT
// Preloaded into the program by faults.py: one of its calls that make, write, name or remove a file does
// not come back, or fails as on a disk that is full, over quota, read-only or broken.
//
//   FAULT_AT       number of the call that fails, from 1, counted in each process; 0: none
//   FAULT_ERROR    ENOSPC, EDQUOT, EROFS, EIO, or KILL
//   FAULT_IN       "worker": only in the workers of a batch; "parent": everywhere else
//   FAULT_STAYS    if set, all calls from that one on fail too: the disk stays full
//   FAULT_MARK     file that is made when the fault comes; where it is there, none comes any more
//   FAULT_COUNT    file to which each process appends its number at each call
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <unistd.h>

namespace {

std::atomic<long> calls{0};

const char* setting(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

int raw_open(const char* path, int flags) {
  return static_cast<int>(::syscall(SYS_openat, AT_FDCWD, path, flags, 0666));
}

/// Whether faults are meant for this process.
bool is_meant() {
  static const bool kMeant = [] {
    char words[4096] = {};
    const int file = raw_open("/proc/self/cmdline", O_RDONLY | O_CLOEXEC);
    const long size = ::read(file, words, sizeof words - 1);
    ::close(file);
    const bool is_worker = size > 0 && ::memmem(words, static_cast<std::size_t>(size),
                                                "\0batch-worker", 14) != nullptr;
    const char* in = setting("FAULT_IN");
    return *in == '\0' || (std::strcmp(in, "worker") == 0) == is_worker;
  }();
  return kMeant;
}

int error_number() {
  const char* name = setting("FAULT_ERROR");
  return std::strcmp(name, "ENOSPC") == 0   ? ENOSPC
         : std::strcmp(name, "EDQUOT") == 0 ? EDQUOT
         : std::strcmp(name, "EROFS") == 0  ? EROFS
                                            : EIO;
}

/// Counts a call. \return whether it is to fail; errno says how.
bool fails() {
  static const long kAt = std::atol(setting("FAULT_AT"));
  static const bool kStays = *setting("FAULT_STAYS") != '\0';
  if (!is_meant()) {
    return false;
  }
  const long call = ++calls;
  if (const char* count = setting("FAULT_COUNT"); *count != '\0') {
    char line[32];
    const int size = std::snprintf(line, sizeof line, "%d\n", static_cast<int>(::getpid()));
    const int file = raw_open(count, O_CREAT | O_APPEND | O_WRONLY | O_CLOEXEC);
    static_cast<void>(::syscall(SYS_write, file, line, static_cast<std::size_t>(size)) < 0);
    ::close(file);
  }
  if (kAt == 0 || call < kAt || (call > kAt && !kStays)) {
    return false;
  }
  if (const char* mark = setting("FAULT_MARK"); *mark != '\0' && call == kAt) {
    const int made = raw_open(mark, O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC);
    if (made < 0) {
      calls = -1'000'000'000;  // it has come to another process
      return false;
    }
    ::close(made);
  }
  if (std::strcmp(setting("FAULT_ERROR"), "KILL") == 0) {
    ::kill(::getpid(), SIGKILL);
  }
  errno = error_number();
  return true;
}

bool is_file(int descriptor) {
  struct stat status {};

  return ::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode);
}

bool makes(int flags) {
  return (flags & O_CREAT) != 0 || (flags & O_TMPFILE) == O_TMPFILE;
}

bool writes(int flags) {
  return (flags & O_ACCMODE) != O_RDONLY || makes(flags);
}

template <class Function>
Function* real(const char* name) {
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

mode_t mode_of(int flags, std::va_list& rest) {
  return makes(flags) ? va_arg(rest, mode_t) : 0;
}

}  // namespace

#define VANTAGE_OPEN(NAME)                                                                        \
  int NAME(const char* path, int flags, ...) {                                                    \
    std::va_list rest;                                                                            \
    va_start(rest, flags);                                                                        \
    const mode_t mode = mode_of(flags, rest);                                                     \
    va_end(rest);                                                                                 \
    return writes(flags) && fails() ? -1                                                          \
                                    : real<int(const char*, int, ...)>(#NAME)(path, flags, mode); \
  }
#define VANTAGE_OPENAT(NAME)                                                              \
  int NAME(int folder, const char* path, int flags, ...) {                                \
    std::va_list rest;                                                                    \
    va_start(rest, flags);                                                                \
    const mode_t mode = mode_of(flags, rest);                                             \
    va_end(rest);                                                                         \
    return writes(flags) && fails()                                                       \
               ? -1                                                                       \
               : real<int(int, const char*, int, ...)>(#NAME)(folder, path, flags, mode); \
  }

extern "C" {

VANTAGE_OPEN(open)
VANTAGE_OPEN(open64)
VANTAGE_OPENAT(openat)
VANTAGE_OPENAT(openat64)

ssize_t write(int file, const void* bytes, size_t size) {
  return is_file(file) && fails()
             ? -1
             : real<ssize_t(int, const void*, size_t)>("write")(file, bytes, size);
}

ssize_t writev(int file, const iovec* parts, int count) {
  return is_file(file) && fails()
             ? -1
             : real<ssize_t(int, const iovec*, int)>("writev")(file, parts, count);
}

ssize_t pwrite(int file, const void* bytes, size_t size, off_t at) {
  return is_file(file) && fails()
             ? -1
             : real<ssize_t(int, const void*, size_t, off_t)>("pwrite")(file, bytes, size, at);
}

ssize_t pwrite64(int file, const void* bytes, size_t size, off64_t at) {
  return is_file(file) && fails()
             ? -1
             : real<ssize_t(int, const void*, size_t, off64_t)>("pwrite64")(file, bytes, size, at);
}

int ftruncate(int file, off_t size) noexcept {
  return fails() ? -1 : real<int(int, off_t)>("ftruncate")(file, size);
}

int ftruncate64(int file, off64_t size) noexcept {
  return fails() ? -1 : real<int(int, off64_t)>("ftruncate64")(file, size);
}

int fsync(int file) {
  return fails() ? -1 : real<int(int)>("fsync")(file);
}

int fdatasync(int file) {
  return fails() ? -1 : real<int(int)>("fdatasync")(file);
}

int linkat(int from_folder, const char* from, int to_folder, const char* to, int flags) noexcept {
  return fails() ? -1
                 : real<int(int, const char*, int, const char*, int)>("linkat")(
                       from_folder, from, to_folder, to, flags);
}

int rename(const char* from, const char* to) noexcept {
  return fails() ? -1 : real<int(const char*, const char*)>("rename")(from, to);
}

int renameat(int from_folder, const char* from, int to_folder, const char* to) noexcept {
  return fails() ? -1
                 : real<int(int, const char*, int, const char*)>("renameat")(from_folder, from,
                                                                             to_folder, to);
}

int renameat2(int from_folder, const char* from, int to_folder, const char* to,
              unsigned flags) noexcept {
  return fails() ? -1
                 : real<int(int, const char*, int, const char*, unsigned)>("renameat2")(
                       from_folder, from, to_folder, to, flags);
}

int unlink(const char* path) noexcept {
  return fails() ? -1 : real<int(const char*)>("unlink")(path);
}

int unlinkat(int folder, const char* path, int flags) noexcept {
  return fails() ? -1 : real<int(int, const char*, int)>("unlinkat")(folder, path, flags);
}

int remove(const char* path) noexcept {
  return fails() ? -1 : real<int(const char*)>("remove")(path);
}

int mkdir(const char* path, mode_t mode) noexcept {
  return fails() ? -1 : real<int(const char*, mode_t)>("mkdir")(path, mode);
}

int mkdirat(int folder, const char* path, mode_t mode) noexcept {
  return fails() ? -1 : real<int(int, const char*, mode_t)>("mkdirat")(folder, path, mode);
}
}
