// SPDX-License-Identifier: MIT
#include <algorithm>
#include <charconv>
#include <fstream>
#include <limits>
#include <string>
#include <string_view>

#include <unistd.h>

#include "vantage/io/model.h"

namespace vantage {
namespace {

/// What a view takes at its peak: 520 bytes a face of closed models, 1 000 of loose sheets. What may
/// fit is not refused. [ours]
constexpr std::uint64_t kBytesPerFace = 500;
constexpr std::size_t kLeastFaces = 100'000;
constexpr std::uint64_t kNoLimit = std::numeric_limits<std::uint64_t>::max();

/// The number in a file of one number; no limit where there is none ("max", or no such file).
std::uint64_t number_in(const std::string& path) {
  std::ifstream file(path);
  std::string text;
  std::getline(file, text);
  std::uint64_t number = kNoLimit;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc{} && end != text.data() ? number : kNoLimit;
}

/// The least limit of the groups that hold this process, of either version of control groups.
std::uint64_t group_limit() {
  std::uint64_t least = std::min(number_in("/sys/fs/cgroup/memory.max"),
                                 number_in("/sys/fs/cgroup/memory/memory.limit_in_bytes"));
  std::ifstream groups("/proc/self/cgroup");
  for (std::string line; std::getline(groups, line);) {
    const std::size_t colon = line.rfind(':');
    const bool is_memory = line.starts_with("0::") || line.find(":memory:") != std::string::npos;
    if (colon == std::string::npos || !is_memory) {
      continue;
    }
    for (std::string path = line.substr(colon + 1); path.size() > 1;
         path.resize(std::min(path.rfind('/'), path.size() - 1))) {
      least = std::min({least, number_in("/sys/fs/cgroup" + path + "/memory.max"),
                        number_in("/sys/fs/cgroup/memory" + path + "/memory.limit_in_bytes")});
    }
  }
  return least;
}

}  // namespace

std::uint64_t usable_memory_bytes() {
  const auto machine = static_cast<std::uint64_t>(std::max(::sysconf(_SC_PHYS_PAGES), 0L)) *
                       static_cast<std::uint64_t>(std::max(::sysconf(_SC_PAGE_SIZE), 0L));
  return std::min(machine, group_limit());
}

std::size_t faces_that_fit(std::uint64_t memory_bytes) {
  const std::uint64_t faces = memory_bytes / kBytesPerFace;
  std::uint64_t power = 1;
  while (faces / power >= 100) {
    power *= 10;
  }
  return std::max<std::size_t>(faces / power * power, kLeastFaces);
}

}  // namespace vantage
