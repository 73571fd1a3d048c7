// SPDX-License-Identifier: MIT
// What a confined process can still do, asked of the kernel, in a child for each question.
#include "sandbox.h"

#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include <arpa/inet.h>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <linux/seccomp.h>
#include <netinet/in.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

namespace vantage::importing {
namespace {

constexpr int kRefused = 0;
constexpr int kAllowed = 1;
constexpr int kNotConfined = 77;

/// What confines a process.
enum class Means { Landlock, Seccomp };

/// Whether the kernel has it, by its own word: not by what confine() says.
bool is_offered(Means means) {
  constexpr long kCreateRuleset = 444;
  constexpr unsigned kAskVersion = 1;
  const std::uint32_t forbid = SECCOMP_RET_ERRNO;
  return means == Means::Landlock
             ? ::syscall(kCreateRuleset, nullptr, 0, kAskVersion) > 0
             : ::syscall(SYS_seccomp, SECCOMP_GET_ACTION_AVAIL, 0, &forbid) == 0;
}

/// Exit code of a confined child that tries something; kNotConfined if it is not confined by these
/// means.
template <class Attempt>
int confined(Means means, const Attempt& attempt) {
  const pid_t child = ::fork();
  if (child == 0) {
    const Confinement held = confine();
    if (means == Means::Landlock ? held.landlock == 0 : !held.seccomp) {
      ::_exit(kNotConfined);
    }
    ::_exit(attempt() ? kAllowed : kRefused);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

template <class Attempt>
void expect_refused(Means means, const Attempt& attempt) {
  if (!is_offered(means)) {
    GTEST_SKIP() << "NOTHING WAS TESTED: this kernel has no "
                 << (means == Means::Landlock ? "Landlock" : "seccomp");
  }
  EXPECT_EQ(confined(means, attempt), kRefused);
}

TEST(Sandbox, OpensNoFileByItsName) {
  expect_refused(Means::Landlock, [] { return ::open("/etc/passwd", O_RDONLY) >= 0; });
}

TEST(Sandbox, MakesNoFile) {
  expect_refused(Means::Landlock, [] { return ::open("/tmp", O_TMPFILE | O_WRONLY, 0600) >= 0; });
  expect_refused(Means::Seccomp, [] { return ::open("/dev/null", O_WRONLY) >= 0; });
}

TEST(Sandbox, HasNoNetwork) {
  expect_refused(Means::Seccomp, [] { return ::socket(AF_INET, SOCK_STREAM, 0) >= 0; });
  expect_refused(Means::Seccomp, [] { return ::socket(AF_UNIX, SOCK_DGRAM, 0) >= 0; });
}

TEST(Sandbox, StartsAndStopsNoProcess) {
  expect_refused(Means::Seccomp, [] { return ::fork() >= 0; });
  expect_refused(Means::Seccomp, [] { return ::kill(::getppid(), 0) == 0; });
  expect_refused(Means::Seccomp, [] { return ::execl("/bin/true", "true", nullptr) == 0; });
}

/// Landlock does not answer for a process that is not there: so the filter is seen on kernels, too, whose
/// Landlock forbids signals. It says EPERM, the kernel beyond it ESRCH.
TEST(Sandbox, SignalsItselfAlone) {
  constexpr pid_t kNobody = 0x7FFFFFFE;  // above any number that the kernel gives
  const auto may_signal = [](pid_t process) {
    return ::syscall(SYS_tgkill, process, process, 0) == 0 || errno != EPERM;
  };
  expect_refused(Means::Seccomp, [&] { return may_signal(::getppid()) || may_signal(kNobody); });
  expect_refused(Means::Seccomp, [&] { return !may_signal(::getpid()); });
  // A file that is written to would signal its owner.
  expect_refused(Means::Seccomp, [] { return ::fcntl(STDOUT_FILENO, F_SETOWN, ::getpid()) == 0; });
}

TEST(Sandbox, StillComputesAndReadsWhatIsOpen) {
  const int file = ::memfd_create("open", 0);
  ASSERT_EQ(::write(file, "abc", 3), 3);
  ASSERT_EQ(::lseek(file, 0, SEEK_SET), 0);
  if (!is_offered(Means::Seccomp)) {
    GTEST_SKIP() << "NOTHING WAS TESTED: this kernel has no seccomp";
  }
  const int code = confined(Means::Seccomp, [&] {
    char text[4] = {};
    void* const room = std::malloc(std::size_t{64} << 20U);
    const bool whole =
        room != nullptr && ::read(file, text, 3) == 3 && std::strcmp(text, "abc") == 0;
    std::free(room);
    // A file without a name is opened by way of its descriptor: it is no place of the file system.
    const std::string self = "/proc/self/fd/" + std::to_string(file);
    return whole && ::open(self.c_str(), O_RDONLY) >= 0;
  });
  EXPECT_EQ(code, kAllowed);
  ::close(file);
}

TEST(Sandbox, SaysWhatHolds) {
  EXPECT_EQ((Confinement{.landlock = 7, .seccomp = true}.text()), "Landlock 7, seccomp");
  EXPECT_EQ((Confinement{.landlock = 0, .seccomp = true}.text()), "seccomp");
  EXPECT_NE((Confinement{}.text()).find("neither"), std::string::npos);
}

}  // namespace
}  // namespace vantage::importing
