// SPDX-License-Identifier: MIT
// replay_inputs TARGET FOLDER: gives every file of a folder to a fuzz target, once; a target aborts
// where it is not content.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "replay_table.h"

int main(int count, char** words) {
  namespace fs = std::filesystem;
  const std::string_view name = count == 3 ? words[1] : "";
  const auto* const target =
      std::find_if(std::begin(kReplayTargets), std::end(kReplayTargets),
                   [&](const ReplayTarget& one) { return one.name == name; });
  if (target == std::end(kReplayTargets)) {
    std::fputs("usage: replay_inputs TARGET FOLDER\n", stderr);
    return 2;
  }
  std::vector<fs::path> files;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(words[2], error)) {
    files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  for (const fs::path& file : files) {
    std::ifstream stream(file, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
    std::printf("%s\n", file.filename().c_str());  // the last one is the one that broke it
    std::fflush(stdout);
    target->run(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
  }
  return files.empty() ? 1 : 0;
}
