// SPDX-License-Identifier: MIT
#include "sandbox.h"

#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdint>

#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#if defined(__x86_64__)
#define VANTAGE_AUDIT_ARCH AUDIT_ARCH_X86_64
#elif defined(__aarch64__)
#define VANTAGE_AUDIT_ARCH AUDIT_ARCH_AARCH64
#endif

namespace vantage::importing {
namespace {

// The numbers of Landlock's system calls are the same on every machine; headers of Debian 12 know less of
// them than kernels do.
constexpr long kCreateRuleset = 444;
constexpr long kRestrictSelf = 446;
constexpr unsigned kAskVersion = 1;

/// As the kernel lays it out; older ones take a shorter one.
struct Ruleset {
  std::uint64_t files = 0;
  std::uint64_t network = 0;
  std::uint64_t scopes = 0;
};

/// Everything that this version of Landlock can forbid, and no exception to it.
int forbid_by_landlock() {
  const long version = ::syscall(kCreateRuleset, nullptr, 0, kAskVersion);
  if (version < 1) {
    return 0;
  }
  // Rights on files that each version added; the last one ends a table that has no more.
  constexpr std::array<unsigned, 6> kFileRights{0, 13, 14, 15, 15, 16};
  Ruleset ruleset;
  const auto known = static_cast<std::size_t>(version < 5 ? version : 5);
  ruleset.files = (std::uint64_t{1} << kFileRights[known]) - 1;
  ruleset.network = version >= 4 ? 3 : 0;  // to bind and to connect
  ruleset.scopes = version >= 6 ? 3 : 0;   // abstract sockets and signals
  const std::size_t size = version >= 6   ? sizeof(Ruleset)
                           : version >= 4 ? offsetof(Ruleset, scopes)
                                          : offsetof(Ruleset, network);
  const long descriptor = ::syscall(kCreateRuleset, &ruleset, size, 0);
  if (descriptor < 0) {
    return 0;
  }
  const bool held = ::syscall(kRestrictSelf, descriptor, 0) == 0;
  ::close(static_cast<int>(descriptor));
  return held ? static_cast<int>(version) : 0;
}

#if defined(VANTAGE_AUDIT_ARCH)

/// All that reading and computing needs; the rest fails as if it were not permitted.
constexpr std::array kAllowed = {
    __NR_read,
    __NR_write,
    __NR_readv,
    __NR_writev,
    __NR_pread64,
    __NR_close,
    __NR_fstat,
    __NR_lseek,
    __NR_mmap,
    __NR_munmap,
    __NR_mremap,
    __NR_mprotect,
    __NR_madvise,
    __NR_brk,
    __NR_futex,
    __NR_newfstatat,
    __NR_statx,
    __NR_faccessat,
    __NR_readlinkat,
    __NR_getcwd,
    __NR_rt_sigaction,
    __NR_rt_sigprocmask,
    __NR_rt_sigreturn,
    __NR_sigaltstack,
    __NR_exit,
    __NR_exit_group,
    __NR_getpid,
    __NR_gettid,
    __NR_getuid,
    __NR_geteuid,
    __NR_getgid,
    __NR_getegid,
    __NR_getrandom,
    __NR_uname,
    __NR_sysinfo,
    __NR_sched_yield,
    __NR_getrusage,
    __NR_nanosleep,
    __NR_clock_gettime,
    __NR_clock_getres,
    __NR_clock_nanosleep,
    __NR_gettimeofday,
    __NR_times,
    __NR_restart_syscall,
    __NR_sched_getaffinity,
    __NR_set_robust_list,
#if defined(__NR_stat)
    __NR_stat,
    __NR_lstat,
    __NR_access,
    __NR_readlink,
    __NR_time,
#endif
};

/// Flags with which a file may be opened: none of those that write, make or cut.
constexpr std::uint32_t kWritingFlags = O_WRONLY | O_RDWR | O_CREAT | O_TRUNC | O_APPEND;

constexpr std::uint32_t kForbid = SECCOMP_RET_ERRNO | EPERM;

/// Builds the filter: the machine, one comparison for each allowed call, then those of two arguments.
class Filter {
 public:
  Filter() {
    load(offsetof(seccomp_data, arch));
    add(BPF_JMP | BPF_JEQ | BPF_K, VANTAGE_AUDIT_ARCH, 1, 0);
    answer(SECCOMP_RET_KILL_PROCESS);
    load(offsetof(seccomp_data, nr));
    for (const long number : kAllowed) {
      add(BPF_JMP | BPF_JEQ | BPF_K, static_cast<std::uint32_t>(number), 0, 1);
      answer(SECCOMP_RET_ALLOW);
    }
    // tgkill(process, thread, signal): abort() sends one to its own process. Landlock forbids others from
    // its version 6 on only.
    add(BPF_JMP | BPF_JEQ | BPF_K, __NR_tgkill, 0, 4);
    load_argument(0);
    add(BPF_JMP | BPF_JEQ | BPF_K, static_cast<std::uint32_t>(::getpid()), 0, 1);
    answer(SECCOMP_RET_ALLOW);
    answer(kForbid);
    // openat(folder, name, flags): the flags are the third argument.
    add(BPF_JMP | BPF_JEQ | BPF_K, __NR_openat, 0, 4);
    load_argument(2);
    add(BPF_JMP | BPF_JSET | BPF_K, kWritingFlags, 1, 0);
    answer(SECCOMP_RET_ALLOW);
    answer(kForbid);
    answer(kForbid);
  }

  [[nodiscard]] bool install() {
    const sock_fprog program{static_cast<unsigned short>(size_), steps_.data()};
    return ::syscall(SYS_seccomp, SECCOMP_SET_MODE_FILTER, 0, &program) == 0;
  }

 private:
  static constexpr std::uint32_t kLowHalf = __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__ ? 0 : 4;

  void add(unsigned code, std::uint32_t value, std::uint8_t if_true, std::uint8_t if_false) {
    steps_[size_++] = {static_cast<std::uint16_t>(code), if_true, if_false, value};
  }

  void load(std::size_t offset) {
    add(BPF_LD | BPF_W | BPF_ABS, static_cast<std::uint32_t>(offset), 0, 0);
  }

  /// The kernel takes no more than this half of an int.
  void load_argument(std::size_t index) {
    load(offsetof(seccomp_data, args) + index * sizeof(std::uint64_t) + kLowHalf);
  }

  void answer(std::uint32_t action) { add(BPF_RET | BPF_K, action, 0, 0); }

  std::array<sock_filter, 2 * kAllowed.size() + 17> steps_{};
  std::size_t size_ = 0;
};

bool filter_calls() {
  return Filter().install();
}

#else

bool filter_calls() {
  return false;
}

#endif

}  // namespace

std::string Confinement::text() const {
  std::string text = landlock > 0 ? "Landlock " + std::to_string(landlock) : "";
  text += seccomp ? (text.empty() ? "seccomp" : ", seccomp") : "";
  return text.empty()
             ? "limits of memory and time alone: this kernel has neither Landlock nor seccomp"
             : text;
}

Confinement confine() {
  Confinement confinement;
  if (::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0) {
    confinement.landlock = forbid_by_landlock();
    confinement.seccomp = filter_calls();
  }
  return confinement;
}

}  // namespace vantage::importing
