// SPDX-License-Identifier: MIT
#include "batch/result_heirs.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "batch/result_folders.h"

namespace vantage::batch {
namespace {

/// Whether models that share the results of `former` have equal ones in those of `now`.
bool has_its_answer(const ModelRecord& now, const ModelRecord& former) {
  return now.status == "done" && !now.folder.empty() && have_one_answer(now, former);
}

}  // namespace

ResultHeirs::ResultHeirs(ResultBook& book, const ConfinedFolder& root)
    : ResultHeirs(book, root, Options{}) {}

ResultHeirs::ResultHeirs(ResultBook& book, const ConfinedFolder& root, Options options)
    : book_(book), root_(root), options_(std::move(options)) {
  if (!options_.is_there) {
    options_.is_there = [this](const std::string& folder) {
      return root_.is_folder(model_folder(folder));
    };
  }
  if (!options_.move) {
    options_.move = [this](const std::string& from, const std::string& folder) {
      root_.move(from, model_folder(folder));
    };
  }
}

void ResultHeirs::bring(const std::string& staging, const ModelRecord& record) {
  const std::optional<ModelRecord> former = book_.find(record.key);
  if (former && former->folder == record.folder && !has_its_answer(record, *former)) {
    pass_on(*former, /*replaced=*/true);
  }
  for (std::string key; !(key = book_.owner_of(record.folder)).empty();) {
    ModelRecord owner = *book_.find(key);
    owner.folder.clear();
    book_.put(owner);
  }
  options_.move(staging, record.folder);
}

std::string ResultHeirs::replace(const ModelRecord& record) {
  const std::optional<ModelRecord> former = book_.find(record.key);
  const bool leaves = former && !former->folder.empty() && former->folder != record.folder;
  if (leaves && !has_its_answer(record, *former)) {
    pass_on(*former);
  }
  book_.put(record);
  return leaves ? former->folder : "";
}

void ResultHeirs::remove_unowned(const std::string& folder) {
  if (!folder.empty() && book_.owner_of(folder).empty() && holds_results(root_, folder)) {
    root_.remove(model_folder(folder));
  }
}

void ResultHeirs::pass_on(const ModelRecord& former, bool replaced) {
  const bool has_results =
      former.status == "done" && !former.folder.empty() && options_.is_there(former.folder);
  std::optional<ModelRecord> heir = has_results ? book_.find_duplicate(former) : std::nullopt;
  if (!heir) {
    return;
  }
  const std::string wanted = options_.own_folder ? options_.own_folder(*heir) : former.folder;
  const bool stays = wanted == former.folder && !replaced;
  heir->duplicate_of.clear();
  heir->folder = stays ? wanted : free_folder(wanted);
  heir->result = former.result;
  const std::int64_t finished_ms =
      std::max(heir->timings.finished_ms, former.timings.finished_ms);  // so that a merge takes it
  heir->timings = former.timings;
  heir->timings.finished_ms = finished_ms;
  // A run that is killed in between misses this folder, and makes it anew.
  book_.put(*heir);
  if (!stays) {
    options_.move(model_folder(former.folder), heir->folder);
  }
}

void ResultHeirs::make_equal(const ModelRecord& former, const ModelRecord& now) {
  for (ModelRecord& equal : book_.find_equals(former)) {
    if (equal.key != now.key && equal.status == "done") {
      equal.folder.clear();
      equal.result.clear();
      equal.options = now.options;
      equal.version = now.version;
      equal.duplicate_of = now.key;
      book_.put(equal);
    }
  }
}

std::string ResultHeirs::free_folder(const std::string& wanted) {
  const auto is_taken = [&](const std::string& folder) {
    return root_.exists(model_folder(folder)) || !book_.owner_of(folder).empty() ||
           (options_.is_claimed && options_.is_claimed(folder));
  };
  std::string folder = wanted;
  for (int number = 2; is_taken(folder); ++number) {
    folder = wanted + "-" + std::to_string(number);
  }
  return folder;
}

}  // namespace vantage::batch
