// SPDX-License-Identifier: MIT
#include <array>
#include <cerrno>
#include <cstring>
#include <iostream>
#include <memory>
#include <unordered_map>

#include <archive.h>
#include <archive_entry.h>
#include <fcntl.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "batch/archive_reader.h"
#include "batch/content_hash.h"
#include "batch/naming.h"

namespace vantage::batch {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kBlock = 1U << 16U;

struct CloseArchive {
  void operator()(archive* a) const { archive_read_free(a); }
};

void say(int answers, const Json& json) {
  const std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t count = ::write(answers, text.data() + done, text.size() - done);
    if (count < 0 && errno != EINTR) {
      ::_exit(1);  // nobody listens any more
    }
    done += count > 0 ? static_cast<std::size_t>(count) : 0;
  }
}

std::string reason_of(archive* a) {
  const char* text = archive_error_string(a);
  return text == nullptr ? "it is damaged" : text;
}

/// Unpacks the entry at hand. \return empty, or what is wrong.
std::string unpack(archive* a, const std::string& file, std::uint64_t most) {
  const int out = ::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  if (out < 0) {
    return std::string("cannot be unpacked: ") + std::strerror(errno);
  }
  std::string problem;
  std::array<char, kBlock> block{};
  std::uint64_t total = 0;
  while (problem.empty()) {
    const la_ssize_t got = archive_read_data(a, block.data(), block.size());
    if (got == 0) {
      break;
    }
    total += got > 0 ? static_cast<std::uint64_t>(got) : 0;
    if (got < 0) {
      problem = "cannot be unpacked: " + reason_of(a);
    } else if (most != 0 && total > most) {
      problem = "is larger than " + std::to_string(most / 1'000'000) +
                " MB when unpacked, the memory limit of a worker; see --memory";
    } else if (::write(out, block.data(), static_cast<std::size_t>(got)) != got) {
      problem = std::string("cannot be unpacked: ") + std::strerror(errno);
    }
  }
  ::close(out);
  return problem;
}

}  // namespace

void unpack_archive(const std::string& path, std::uint64_t entry_bytes, int answers) {
  const std::unique_ptr<archive, CloseArchive> reader(archive_read_new());
  archive* const a = reader.get();
  archive_read_support_format_zip(a);
  archive_read_support_format_tar(a);
  archive_read_support_filter_gzip(a);
  archive_read_support_filter_bzip2(a);
  archive_read_support_filter_xz(a);
  archive_read_support_filter_zstd(a);
  if (archive_read_open_filename(a, path.c_str(), kBlock) != ARCHIVE_OK) {
    say(answers, {{"problem", reason_of(a)}});
    return;
  }
  std::unordered_map<std::uint64_t, int> seen;  // how often a name has come already
  archive_entry* entry = nullptr;
  int code = ARCHIVE_OK;
  while ((code = archive_read_next_header(a, &entry)) == ARCHIVE_OK || code == ARCHIVE_WARN) {
    const char* name = archive_entry_pathname(entry);
    if (archive_entry_filetype(entry) != AE_IFREG || archive_entry_hardlink(entry) != nullptr ||
        name == nullptr) {
      continue;
    }
    say(answers, {{"member", key_of_path(name)}, {"repeat", seen[stable_number(name)]++}});
    std::string order;
    if (!std::getline(std::cin, order)) {
      return;
    }
    if (order.starts_with("take ")) {
      say(answers, {{"failed", unpack(a, path_of_key(order.substr(5)), entry_bytes)}});
    }
  }
  if (code == ARCHIVE_EOF) {
    say(answers, Json::object());
  } else {
    say(answers, {{"problem", reason_of(a)}});
  }
}

}  // namespace vantage::batch
