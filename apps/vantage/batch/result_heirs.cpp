// SPDX-License-Identifier: MIT
#include "batch/result_heirs.h"

#include <algorithm>
#include <utility>

#include "batch/result_folders.h"

namespace vantage::batch {

std::optional<ModelRecord> heir_of(ResultBook& book, const ConfinedFolder& root,
                                   const ModelRecord& former) {
  const bool has_results = former.status == "done" && !former.folder.empty() &&
                           root.is_folder(model_folder(former.folder));
  return has_results ? book.find_duplicate(former) : std::nullopt;
}

std::string free_folder(const ConfinedFolder& root, const std::string& wanted,
                        const std::function<bool(const std::string&)>& is_claimed) {
  std::string folder = wanted;
  for (int number = 2; root.exists(model_folder(folder)) || is_claimed(folder); ++number) {
    folder = wanted + "-" + std::to_string(number);
  }
  return folder;
}

void hand_over(ResultBook& book, const ConfinedFolder& root, ModelRecord heir,
               const ModelRecord& former, const std::string& folder) {
  heir.duplicate_of.clear();
  heir.folder = folder;
  heir.result = former.result;
  const std::int64_t finished_ms =
      std::max(heir.timings.finished_ms, former.timings.finished_ms);  // so that a merge takes it
  heir.timings = former.timings;
  heir.timings.finished_ms = finished_ms;
  // A run that is killed in between misses this folder, and makes it anew.
  book.put(heir);
  if (folder != former.folder) {
    root.move(model_folder(former.folder), model_folder(folder));
  }
}

void make_equal(ResultBook& book, const ModelRecord& former, const ModelRecord& now) {
  for (ModelRecord& equal : book.find_equals(former)) {
    if (equal.key != now.key && equal.status == "done") {
      equal.folder.clear();
      equal.result.clear();
      equal.options = now.options;
      equal.version = now.version;
      equal.duplicate_of = now.key;
      book.put(equal);
    }
  }
}

}  // namespace vantage::batch
