// SPDX-License-Identifier: MIT
// Any bytes as the manifest of a batch, and as that of an evaluation: entries, each with a path or a
// problem, or an error that says so.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <optional>

#include "vantage/core/error.h"

#include "batch/entry_source.h"
#include "memory_file.h"
#include "report/evaluation_manifest.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const MemoryFile file(data, size);
  try {
    const auto source = vantage::batch::entries_of_manifest(file.path());
    while (const std::optional<vantage::batch::Entry> entry = source->next()) {
      if (entry->path.empty() && entry->problem.empty() && entry->member.empty() &&
          entry->key.empty()) {
        std::abort();
      }
    }
  } catch (const vantage::Error&) {
  }
  try {
    static_cast<void>(vantage::read_manifest(file.path()));
  } catch (const vantage::Error&) {
  }
  try {
    static_cast<void>(vantage::read_gaze_values(file.path()));
  } catch (const vantage::Error&) {
  }
  return 0;
}
