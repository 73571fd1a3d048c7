// SPDX-License-Identifier: MIT
// Preloaded into the program by test_folders.py and test_batch_kill.py: kills it before its call number KILL_AT
// that makes, names or removes a file, or after its call number KILL_AFTER_EXCHANGE that exchanges two, as a power
// cut or an impatient user would.
#include <csignal>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace {

void count_one() {
  static long calls = 0;
  const char* at = std::getenv("KILL_AT");
  if (at != nullptr && ++calls == std::atol(at)) {
    ::kill(::getpid(), SIGKILL);
  }
}

template <class Function>
Function* real(const char* name) {
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

}  // namespace

extern "C" {

int linkat(int from_folder, const char* from, int to_folder, const char* to, int flags) noexcept {
  count_one();
  return real<int(int, const char*, int, const char*, int)>("linkat")(from_folder, from, to_folder,
                                                                      to, flags);
}

int rename(const char* from, const char* to) noexcept {
  count_one();
  return real<int(const char*, const char*)>("rename")(from, to);
}

int renameat2(int from_folder, const char* from, int to_folder, const char* to,
              unsigned flags) noexcept {
  count_one();
  const int result = real<int(int, const char*, int, const char*, unsigned)>("renameat2")(
      from_folder, from, to_folder, to, flags);
  static long exchanges = 0;
  const char* after = std::getenv("KILL_AFTER_EXCHANGE");
  if (after != nullptr && result == 0 && (flags & RENAME_EXCHANGE) != 0 &&
      ++exchanges == std::atol(after)) {
    ::kill(::getpid(), SIGKILL);
  }
  return result;
}

int unlink(const char* path) noexcept {
  count_one();
  return real<int(const char*)>("unlink")(path);
}

int unlinkat(int folder, const char* path, int flags) noexcept {
  count_one();
  return real<int(int, const char*, int)>("unlinkat")(folder, path, flags);
}

int remove(const char* path) noexcept {
  count_one();
  return real<int(const char*)>("remove")(path);
}

int mkdir(const char* path, mode_t mode) noexcept {
  count_one();
  return real<int(const char*, mode_t)>("mkdir")(path, mode);
}

int fsync(int file) {
  count_one();
  return real<int(int)>("fsync")(file);
}
}
