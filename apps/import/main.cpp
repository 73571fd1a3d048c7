// SPDX-License-Identifier: MIT
// vantage-import EXTENSION [FACES]: reads one file on standard input, which must be a regular file, by the
// libraries of others, and writes what it holds to standard output (vantage/io/import_stream.h), if that is no
// more than so many faces. `vantage` starts it; --version says what it is made of and what confines it.
#include <charconv>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <string_view>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include "vantage/io/import_stream.h"

#include "readers.h"
#include "sandbox.h"
#include "stream_writer.h"

namespace {

constexpr int kDone = 0;
constexpr int kUnreadable = 3;
constexpr int kWrongUsage = 2;

/// The file on standard input, as long as the process lives; empty if it is none.
std::string_view input_bytes() {
  struct stat status {};

  if (::fstat(STDIN_FILENO, &status) != 0 || !S_ISREG(status.st_mode) || status.st_size <= 0) {
    return {};
  }
  const auto size = static_cast<std::size_t>(status.st_size);
  void* const bytes = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, STDIN_FILENO, 0);
  return bytes == MAP_FAILED ? std::string_view()
                             : std::string_view(static_cast<const char*>(bytes), size);
}

/// Standard output as it was; whatever a library prints goes to standard error from now on.
int take_output() {
  const int output = ::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 3);
  ::dup2(STDERR_FILENO, STDOUT_FILENO);
  return output;
}

int import(const vantage::ImportFormat& format, std::uint64_t most_faces) {
  using namespace vantage::importing;
  const int output = take_output();
  confine();
  try {
    StreamWriter out(output, most_faces);
    try {
      const std::string_view bytes = input_bytes();
      if (bytes.empty()) {
        throw std::runtime_error("standard input is not a file with something in it");
      }
      format.solid ? read_solid(format.name, STDIN_FILENO, bytes, out)
                   : read_scene(format.extension, bytes, out);
      out.done();
      return kDone;
    } catch (const TooMany& problem) {
      out.fail(problem);
    } catch (const std::bad_alloc&) {
      out.fail("it needs more memory than is allowed; --max-memory allows more");
    } catch (const std::exception& error) {
      out.fail(error.what());
    }
  } catch (const std::exception&) {  // nobody listens
    return kUnreadable;
  }
  return kUnreadable;
}

}  // namespace

int main(int count, char** words) {
  const std::string_view word = count >= 2 ? words[1] : "";
  const std::string_view number = count == 3 ? words[2] : "0";
  std::uint64_t most_faces = 0;
  const auto [end, problem] =
      std::from_chars(number.data(), number.data() + number.size(), most_faces);
  const bool good = count <= 3 && problem == std::errc() && end == number.data() + number.size();
  if (word == "--version") {
    const std::string libraries =
        vantage::importing::scene_library() + ", " + vantage::importing::solid_library();
    std::printf("%s; confined by %s\n", libraries.c_str(),
                vantage::importing::confine().text().c_str());
    return kDone;
  }
  const vantage::ImportFormat* const format = vantage::import_format(word);
  if (format == nullptr || !good) {
    std::fputs("usage: vantage-import EXTENSION [FACES] < FILE\n", stderr);
    return kWrongUsage;
  }
  const int code = import(*format, most_faces);
  // Not by way of the libraries' own endings: after a damaged file they are not to be trusted.
  ::_exit(code);
}
