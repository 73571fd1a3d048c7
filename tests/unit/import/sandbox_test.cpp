// SPDX-License-Identifier: MIT
// What a confined process can still do, asked of the kernel, in a child for each question.
#include "sandbox.h"

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include <arpa/inet.h>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

namespace vantage::importing {
namespace {

constexpr int kRefused = 0;
constexpr int kAllowed = 1;
constexpr int kNotConfined = 77;

/// Exit code of a confined child that tries something. \param needs_landlock else seccomp
template <class Attempt>
int confined(bool needs_landlock, const Attempt& attempt) {
  const pid_t child = ::fork();
  if (child == 0) {
    const Confinement held = confine();
    if (needs_landlock ? held.landlock == 0 : !held.seccomp) {
      ::_exit(kNotConfined);
    }
    ::_exit(attempt() ? kAllowed : kRefused);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

void expect_refused(int code) {
  if (code == kNotConfined) {
    GTEST_SKIP() << "NOTHING WAS TESTED: this kernel cannot confine a process (Landlock, seccomp)";
  }
  EXPECT_EQ(code, kRefused);
}

TEST(Sandbox, OpensNoFileByItsName) {
  expect_refused(confined(true, [] { return ::open("/etc/passwd", O_RDONLY) >= 0; }));
}

TEST(Sandbox, MakesNoFile) {
  expect_refused(confined(true, [] { return ::open("/tmp", O_TMPFILE | O_WRONLY, 0600) >= 0; }));
  expect_refused(confined(false, [] { return ::open("/dev/null", O_WRONLY) >= 0; }));
}

TEST(Sandbox, HasNoNetwork) {
  expect_refused(confined(false, [] { return ::socket(AF_INET, SOCK_STREAM, 0) >= 0; }));
  expect_refused(confined(false, [] { return ::socket(AF_UNIX, SOCK_DGRAM, 0) >= 0; }));
}

TEST(Sandbox, StartsAndStopsNoProcess) {
  expect_refused(confined(false, [] { return ::fork() >= 0; }));
  expect_refused(confined(false, [] { return ::kill(::getppid(), 0) == 0; }));
  expect_refused(confined(false, [] { return ::execl("/bin/true", "true", nullptr) == 0; }));
}

TEST(Sandbox, StillComputesAndReadsWhatIsOpen) {
  const int file = ::memfd_create("open", 0);
  ASSERT_EQ(::write(file, "abc", 3), 3);
  ASSERT_EQ(::lseek(file, 0, SEEK_SET), 0);
  const int code = confined(false, [&] {
    char text[4] = {};
    void* const room = std::malloc(std::size_t{64} << 20U);
    const bool whole =
        room != nullptr && ::read(file, text, 3) == 3 && std::strcmp(text, "abc") == 0;
    std::free(room);
    // A file without a name is opened by way of its descriptor: it is no place of the file system.
    const std::string self = "/proc/self/fd/" + std::to_string(file);
    return whole && ::open(self.c_str(), O_RDONLY) >= 0;
  });
  if (code != kNotConfined) {
    EXPECT_EQ(code, kAllowed);
  }
  ::close(file);
}

TEST(Sandbox, SaysWhatHolds) {
  EXPECT_EQ((Confinement{.landlock = 7, .seccomp = true}.text()), "Landlock 7, seccomp");
  EXPECT_EQ((Confinement{.landlock = 0, .seccomp = true}.text()), "seccomp");
  EXPECT_NE((Confinement{}.text()).find("neither"), std::string::npos);
}

}  // namespace
}  // namespace vantage::importing
