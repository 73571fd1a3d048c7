// SPDX-License-Identifier: MIT
// Any bytes as an archive of models: what is taken out of it goes into the file that was asked for,
// whatever the names in it say, and is no larger than allowed.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <iterator>
#include <sstream>
#include <string>

#include <fcntl.h>
#include <unistd.h>

#include "batch/archive_reader.h"
#include "memory_file.h"
#include "scratch_folder.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  namespace fs = std::filesystem;
  constexpr std::uint64_t kMost = 1 << 20;
  static const ScratchFolder folder;
  static const int nobody = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  const fs::path taken = folder.path() / "taken";
  fs::remove(taken);
  // The second entry is passed over, the third cannot be taken: its file is there already.
  std::istringstream orders("take \"" + taken.string() + "\"\nskip\ntake \"" + taken.string() +
                            "\"\n");
  std::streambuf* const before = std::cin.rdbuf(orders.rdbuf());
  std::cin.clear();
  const MemoryFile archive(data, size);
  vantage::batch::unpack_archive(archive.path(), {.entry_bytes = kMost}, nobody);
  std::cin.rdbuf(before);
  for (const fs::directory_entry& entry : fs::directory_iterator(folder.path())) {
    constexpr std::uint64_t kBlock = 1 << 16;
    if (entry.path() != taken || fs::file_size(taken) > kMost + kBlock) {
      std::abort();
    }
  }
  return 0;
}
