// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cerrno>
#include <clocale>
#include <cstring>
#include <iostream>
#include <memory>
#include <unordered_map>

#include <archive.h>
#include <archive_entry.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "batch/archive_reader.h"
#include "batch/content_hash.h"
#include "batch/descriptor.h"
#include "batch/json_text.h"
#include "batch/naming.h"

namespace vantage::batch {
namespace {

constexpr std::size_t kBlock = 1U << 16U;
// Deflate, which .zip has, packs at most 1 032 to one; what the others pack denser is no model.
constexpr std::uint64_t kBytesForEachPacked = 1000;
constexpr std::uint64_t kAlwaysAllowed = 256'000'000;

struct CloseArchive {
  void operator()(archive* a) const { archive_read_free(a); }
};

void say(int answers, const Json& json) {
  if (!write_json_line(answers, json)) {
    ::_exit(1);
  }
}

std::string reason_of(archive* a) {
  const char* text = archive_error_string(a);
  return text == nullptr ? "it is damaged" : text;
}

/// How an entry was unpacked; empty: well.
struct Failure {
  std::string problem{};
  std::string reason = "input";  ///< As in ModelRecord, or "disk".
};

Failure cannot_write(int error) {
  return {std::string("cannot be unpacked: ") + std::strerror(error),
          error == ENOSPC || error == EDQUOT ? "disk" : "input"};
}

/// What may be unpacked of one entry.
struct Allowance {
  std::uint64_t bytes = 0;
  bool of_memory = false;  ///< It is a worker's memory, not the archive's size, that ends it.
};

Failure too_large(const Allowance& most) {
  const std::string limit = std::to_string(most.bytes / 1'000'000) + " MB when unpacked, ";
  return {"is larger than " + limit +
          (most.of_memory
               ? "the memory limit of a worker (--memory, --max-memory)"
               : "a thousand times the archive it is in; unpack it if that is meant to be")};
}

int write_block(int out, const char* bytes, std::size_t count, off_t at) {
  while (count > 0) {
    const ssize_t done = ::pwrite(out, bytes, count, at);
    if (done < 0 && errno != EINTR) {
      return errno;
    }
    const auto step = static_cast<std::size_t>(std::max<ssize_t>(done, 0));
    bytes += step;
    count -= step;
    at += static_cast<off_t>(step);
  }
  return 0;
}

/// Unpacks the entry at hand; what is a hole in it stays one.
Failure unpack(archive* a, archive_entry* entry, const std::string& file, const Allowance& most) {
  const auto allowed = [&](la_int64_t bytes) {
    return bytes >= 0 && static_cast<std::uint64_t>(bytes) <= most.bytes;
  };
  if (archive_entry_size_is_set(entry) != 0 && !allowed(archive_entry_size(entry))) {
    return too_large(most);
  }
  const Descriptor out(::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600));
  if (out.number() < 0) {
    return cannot_write(errno);
  }
  la_int64_t end = 0;
  while (true) {
    const void* block = nullptr;
    std::size_t count = 0;
    la_int64_t at = 0;
    const int code = archive_read_data_block(a, &block, &count, &at);
    if (code == ARCHIVE_EOF) {
      end = std::max(end, at);  // what ends in a hole
      break;
    }
    if (code != ARCHIVE_OK && code != ARCHIVE_WARN) {
      return {"cannot be unpacked: " + reason_of(a)};
    }
    if (!allowed(at) || count > most.bytes - static_cast<std::uint64_t>(at)) {
      return too_large(most);
    }
    if (const int error = write_block(out.number(), static_cast<const char*>(block), count, at)) {
      return cannot_write(error);
    }
    end = std::max(end, at + static_cast<la_int64_t>(count));
  }
  if (!allowed(end)) {
    return too_large(most);
  }
  return ::ftruncate(out.number(), end) == 0 ? Failure{} : cannot_write(errno);
}

/// Why an entry is no file that can be unpacked; empty if it is one.
std::string problem_of(archive_entry* entry, const char* name) {
  if (name == nullptr) {
    return "the name of this entry of the archive cannot be read; unpack it and name it anew";
  }
  if (archive_entry_hardlink(entry) != nullptr || archive_entry_filetype(entry) == AE_IFLNK) {
    return "is a link in an archive, which is not followed; unpack the archive";
  }
  return archive_entry_filetype(entry) == AE_IFREG ? "" : "is no file but a device or a pipe";
}

/// Names with the mark of UTF-8 are given out only in a locale that can hold them. Numbers keep
/// their own. This process does nothing but unpack.
void allow_every_name() {
  for (const char* locale : {"C.UTF-8", "C.utf8", "en_US.UTF-8"}) {
    if (std::setlocale(LC_CTYPE, locale) != nullptr) {
      return;
    }
  }
}

/// Opens the archive; it must be a regular file: a pipe or a device might never end.
Descriptor opened(const std::string& path, std::string& problem, std::uint64_t& bytes) {
  Descriptor file(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));

  struct stat status {};

  if (file.number() < 0 || ::fstat(file.number(), &status) != 0) {
    problem = std::string("it cannot be opened: ") + std::strerror(errno);
  } else if (!S_ISREG(status.st_mode)) {
    problem = "it is not a regular file";
  }
  bytes = static_cast<std::uint64_t>(status.st_size);
  return file;
}

Allowance allowance_of(std::uint64_t archive_bytes, std::uint64_t memory_bytes) {
  const std::uint64_t by_size =
      std::max(kAlwaysAllowed, archive_bytes > UINT64_MAX / kBytesForEachPacked
                                   ? UINT64_MAX
                                   : archive_bytes * kBytesForEachPacked);
  return memory_bytes != 0 && memory_bytes < by_size ? Allowance{memory_bytes, true}
                                                     : Allowance{by_size, false};
}

/// Offers what comes in the archive. \return what libarchive said last, or nothing once nobody asks.
int offer_entries(archive* a, const UnpackLimits& limits, const Allowance& most, int answers) {
  std::unordered_map<std::uint64_t, int> seen;  // how often a name has come already
  archive_entry* entry = nullptr;
  int code = ARCHIVE_OK;
  for (std::uint64_t number = 1;
       (code = archive_read_next_header(a, &entry)) == ARCHIVE_OK || code == ARCHIVE_WARN;
       ++number) {
    if (archive_entry_filetype(entry) == AE_IFDIR) {
      continue;
    }
    const char* name = archive_entry_pathname(entry);
    const std::string member = name == nullptr ? "" : key_of_path(name);
    const int repeat = member.empty() ? 0 : seen[stable_number(name)]++;
    if (number <= limits.passed) {
      continue;
    }
    Json offer = {{"number", number}, {"member", member}, {"repeat", repeat}};
    if (std::string problem = problem_of(entry, member.empty() ? nullptr : name);
        !problem.empty()) {
      offer["problem"] = std::move(problem);
    }
    say(answers, offer);
    std::string order;
    if (!std::getline(std::cin, order)) {
      return ARCHIVE_EOF;
    }
    if (order.starts_with("take ")) {
      const Json file = parsed_json(order.substr(5));
      const Failure failure =
          unpack(a, entry, path_of_key(file.is_string() ? file.get<std::string>() : ""), most);
      say(answers, {{"failed", failure.problem}, {"reason", failure.reason}});
    }
  }
  return code;
}

}  // namespace

void unpack_archive(const std::string& path, const UnpackLimits& limits, int answers) {
  allow_every_name();
  std::string problem;
  std::uint64_t bytes = 0;
  const Descriptor file = opened(path, problem, bytes);
  if (!problem.empty()) {
    say(answers, {{"problem", problem}});
    return;
  }
  const std::unique_ptr<archive, CloseArchive> reader(archive_read_new());
  archive* const a = reader.get();
  archive_read_support_format_zip(a);
  archive_read_support_format_tar(a);
  archive_read_support_filter_gzip(a);
  archive_read_support_filter_bzip2(a);
  archive_read_support_filter_xz(a);
  archive_read_support_filter_zstd(a);
  const int code = archive_read_open_fd(a, file.number(), kBlock) != ARCHIVE_OK
                       ? ARCHIVE_FATAL
                       : offer_entries(a, limits, allowance_of(bytes, limits.entry_bytes), answers);
  if (code == ARCHIVE_EOF) {
    say(answers, Json::object());
  } else {
    say(answers, {{"problem", reason_of(a)}});
  }
}

}  // namespace vantage::batch
