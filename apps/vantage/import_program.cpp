// SPDX-License-Identifier: MIT
#include "import_program.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string_view>
#include <thread>
#include <utility>

#include <fcntl.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include "vantage/core/error.h"
#include "vantage/io/import_stream.h"
#include "vantage/io/model.h"

#include "batch/descriptor.h"
#include "batch/program_call.h"
#include "batch/worker_process.h"

namespace vantage::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kProgramName = "vantage-import";
/// Data of the process where --max-memory says nothing and there is so much, bytes, and so much may be sent. [ours]
constexpr std::uint64_t kUsualMemory = 8'000'000'000;
/// Address space beyond that for the libraries themselves, bytes. [ours]
constexpr std::uint64_t kLibraries = 1'000'000'000;
/// Seconds of processor time where --timeout says nothing. [ours]
constexpr double kUsualSeconds = 300.0;
constexpr double kWallFactor = 1.5;  ///< Wall time allowed, of processor time. [ours]
constexpr rlim_t kMostDescriptors = 32;
constexpr int kPollMs = 50;
constexpr int kCannotStart = 127;

struct Limits {
  std::uint64_t memory_bytes = std::min(kUsualMemory, usable_memory_bytes());
  double seconds = kUsualSeconds;
  std::string faces{};  ///< A number, for its command line.
};

void limit(int resource, rlim_t soft, rlim_t hard) {
  rlimit now{};
  // glibc declares the first parameter as an enumeration in C++.
  ::getrlimit(static_cast<__rlimit_resource>(resource), &now);
  const rlimit both{std::min(soft, now.rlim_max), std::min(hard, now.rlim_max)};
  ::setrlimit(static_cast<__rlimit_resource>(resource), &both);
}

/// Between fork and exec: nothing but system calls is allowed.
void become_importer(const char* program, const char* extension, int input, int output,
                     const Limits& limits, pid_t parent) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) {  // the parent died before it could be watched
    ::_exit(1);
  }
  ::setpgid(0, 0);  // Ctrl-C is the parent's to answer
  const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  ::dup2(input, STDIN_FILENO);
  ::dup2(output, STDOUT_FILENO);
  ::dup2(nowhere, STDERR_FILENO);
  ::syscall(SYS_close_range, 3U, ~0U, 0U);
  static_cast<void>(::chdir("/") == 0);
#if !defined(__SANITIZE_ADDRESS__)  // its shadow memory alone is terabytes of address space
  limit(RLIMIT_DATA, limits.memory_bytes, limits.memory_bytes);
  limit(RLIMIT_AS, limits.memory_bytes + kLibraries, limits.memory_bytes + kLibraries);
#endif
  const auto seconds = static_cast<rlim_t>(std::ceil(limits.seconds));
  limit(RLIMIT_CPU, seconds, seconds + 1);
  limit(RLIMIT_FSIZE, 0, 0);
  limit(RLIMIT_CORE, 0, 0);
  limit(RLIMIT_NOFILE, kMostDescriptors, kMostDescriptors);
  sigset_t none;
  sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  std::array<char*, 4> words{const_cast<char*>(kProgramName),          // NOLINT(*-const-cast)
                             const_cast<char*>(extension),             // NOLINT(*-const-cast)
                             const_cast<char*>(limits.faces.c_str()),  // NOLINT(*-const-cast)
                             nullptr};
  char locale[] = "LC_ALL=C";
  std::array<char*, 2> environment{locale, nullptr};
  ::execve(program, words.data(), environment.data());
  ::_exit(kCannotStart);
}

/// A file without a name that holds the bytes.
batch::Descriptor file_of(std::string_view bytes, std::string_view name) {
  batch::Descriptor file(::memfd_create("model", MFD_CLOEXEC));
  if (file.number() < 0 || batch::write_all(file.number(), bytes) != 0 ||
      ::lseek(file.number(), 0, SEEK_SET) != 0) {
    throw IoError(name, "cannot be handed to vantage-import", errno);
  }
  return file;
}

/// One run of the program.
class ImportProcess {
 public:
  ImportProcess(const std::string& program, const ImportRequest& request, const Limits& limits)
      : request_(request), limits_(limits), input_(file_of(request.bytes, request.name)) {
    std::array<int, 2> ends{-1, -1};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) {
      throw IoError(request.name, "cannot be read by vantage-import: no pipe", errno);
    }
    from_ = batch::Descriptor(ends[0]);
    const batch::Descriptor to(ends[1]);
    const std::string extension(request.format.extension);
    const pid_t parent = ::getpid();
    pid_ = ::fork();
    if (pid_ == 0) {
      become_importer(program.c_str(), extension.c_str(), input_.number(), to.number(), limits_,
                      parent);
    }
    if (pid_ < 0) {
      throw IoError(request.name, "cannot be read by vantage-import: no process", errno);
    }
  }

  ImportProcess(const ImportProcess&) = delete;
  ImportProcess& operator=(const ImportProcess&) = delete;

  ~ImportProcess() { end(); }

  /// Everything that it sends. \throw FormatError, Cancelled
  std::string stream(const RunContext& run) {
    const auto deadline = std::chrono::steady_clock::now() +
                          std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                              std::chrono::duration<double>(kWallFactor * limits_.seconds));
    while (receive()) {
      run.check();
      if (std::chrono::steady_clock::now() > deadline) {
        fail_for_time();
      }
      if (received_.size() > limits_.memory_bytes) {
        fail("grows beyond " + std::to_string(limits_.memory_bytes / 1'000'000) +
             " MB when it is read as " + title());
      }
    }
    check_end(await_end());
    return std::move(received_);
  }

 private:
  [[nodiscard]] std::string title() const { return std::string(request_.format.title); }

  [[noreturn]] void fail(const std::string& problem) const {
    throw FormatError(request_.name, "", problem);
  }

  [[noreturn]] void fail_for_time() const {
    fail("takes more than " + batch::seconds_text(limits_.seconds) + " s to be read as " + title() +
         "; --timeout allows more");
  }

  /// \return false once there is nothing more to come.
  bool receive() {
    pollfd file{from_.number(), POLLIN, 0};
    if (::poll(&file, 1, kPollMs) <= 0) {
      return true;
    }
    const ssize_t got = ::read(from_.number(), block_.data(), block_.size());
    if (got > 0) {
      received_.append(block_.data(), static_cast<std::size_t>(got));
    }
    return got > 0 || (got < 0 && errno == EINTR);
  }

  /// Its status, once its output has ended. One that stays all the same is killed.
  int await_end() {
    constexpr int kPatienceMs = 5000;
    int status = 0;
    for (int waited_ms = 0; waited_ms < kPatienceMs; ++waited_ms) {
      if (::waitpid(pid_, &status, WNOHANG) == pid_) {
        pid_ = -1;
        return status;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    ::kill(pid_, SIGKILL);
    return wait();
  }

  int wait() {
    int status = 0;
    while (::waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
    }
    pid_ = -1;
    return status;
  }

  void end() {
    if (pid_ > 0) {
      ::kill(pid_, SIGKILL);
      wait();
    }
  }

  void check_end(int status) const {
    constexpr int kWrongUsage = 2;
    constexpr int kUnreadable = 3;
    if (WIFEXITED(status) && (WEXITSTATUS(status) == 0 || WEXITSTATUS(status) == kUnreadable)) {
      return;  // the stream itself says what came of it
    }
    if (WIFEXITED(status) && WEXITSTATUS(status) == kWrongUsage) {
      fail("vantage-import is of another version than this program; install both anew");
    }
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU) {
      fail_for_time();
    }
    if (WIFEXITED(status) && WEXITSTATUS(status) == kCannotStart) {
      fail("cannot be read as " + title() +
           ": vantage-import does not start; allow more memory, or install it anew");
    }
    fail("cannot be read as " + title() + ": the reader broke down on it (" +
         batch::how_it_ended(status) +
         "), because of a fault of its own, or because the file is damaged or needs more memory "
         "than is allowed; " +
         std::string(import_advice(request_.format)));
  }

  const ImportRequest& request_;
  Limits limits_;
  batch::Descriptor input_;
  batch::Descriptor from_{-1};
  pid_t pid_ = -1;
  std::string received_{};
  std::array<char, std::size_t{1} << 16U> block_{};
};

bool is_program(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error) && ::access(path.c_str(), X_OK) == 0;
}

/// What to do without it.
[[noreturn]] void refuse(const ImportRequest& request) {
  const std::string title(request.format.title);
  throw FormatError(request.name, "",
                    "is a " + title + " file; install vantage-import to read " + title + ", or " +
                        std::string(import_advice(request.format)));
}

}  // namespace

std::string import_program() {
  std::error_code error;
  const fs::path folder = fs::read_symlink("/proc/self/exe", error).parent_path();
  for (const fs::path& place :
       {folder / kProgramName, folder.parent_path() / "libexec" / "vantage" / kProgramName}) {
    if (!error && is_program(place)) {
      return place.string();
    }
  }
  const char* const search = std::getenv("PATH");
  std::string_view rest = search == nullptr ? "" : search;
  while (!rest.empty()) {
    const std::string_view one = rest.substr(0, rest.find(':'));
    rest.remove_prefix(std::min(rest.size(), one.size() + 1));
    // A relative entry would mean another program in every folder.
    if (one.starts_with('/') && is_program(fs::path(one) / kProgramName)) {
      return (fs::path(one) / kProgramName).string();
    }
  }
  return {};
}

std::string import_program_version() {
  const std::string program = import_program();
  if (program.empty()) {
    return "vantage-import: not installed; STEP, IGES, FBX, COLLADA and others need it";
  }
  std::string text = batch::call_program({program, "--version"}).output;
  text.resize(std::min(text.find('\n'), text.size()));
  return "vantage-import: " + (text.empty() ? "does not start; install it anew" : text);
}

ModelImporter model_importer(const RunLimits& limits) {
  Limits own;
  own.memory_bytes = limits.memory_bytes > 0 ? limits.memory_bytes : own.memory_bytes;
  own.faces = std::to_string(face_limit(limits));
  own.seconds = limits.seconds > 0.0 ? limits.seconds : own.seconds;
  return [own](const ImportRequest& request, const RunContext& run) {
    const std::string program = import_program();
    if (program.empty()) {
      refuse(request);
    }
    return ImportProcess(program, request, own).stream(run);
  };
}

}  // namespace vantage::cli
