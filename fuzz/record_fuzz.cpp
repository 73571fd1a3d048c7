// SPDX-License-Identifier: MIT
// Any lines as those of a shard's file and of a journal: a record that reads back as it was written,
// or none. Torn lines are what a killed run leaves.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <sstream>
#include <string>

#include <nlohmann/json.hpp>

#include "vantage/core/error.h"
#include "vantage/report/evaluation.h"

#include "batch/model_record.h"
#include "scratch_folder.h"

namespace {

std::string line_of(const vantage::batch::ModelRecord& record) {
  return vantage::batch::to_json(record).dump(-1, ' ', false,
                                              nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const auto record = vantage::batch::record_from_line(line);
    if (!record) {
      continue;
    }
    const std::string written = line_of(*record);
    const auto again = vantage::batch::record_from_line(written);
    if (!again || line_of(*again) != written || vantage::batch::supersedes(*record, *record)) {
      std::abort();
    }
  }
  static const ScratchFolder folder;
  try {
    const vantage::EvaluationJournal journal(folder.write("rows.jsonl", text));
    static_cast<void>(journal.find("k"));
  } catch (const vantage::Error&) {
    return 0;
  }
  return 0;
}
