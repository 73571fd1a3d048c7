// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "batch/entry_source.h"
#include "batch/model_record.h"
#include "batch/result_book.h"
#include "batch/worker_process.h"

namespace vantage::batch {

/// How a batch is run; none of it changes a result that ends as done.
struct RunnerOptions {
  std::string folder{};                          ///< Of the whole batch; exists.
  std::string work_name = "local";               ///< Of this process's corner of work_folder().
  std::string name_template = "{stem}-{hash8}";  ///< See folder_name().
  std::vector<std::string> worker_arguments{};   ///< Command line of a worker.
  WorkerLimits limits{};                         ///< Of each worker.
  int workers = 1;                               ///< At least 1.
  int threads = 1;                               ///< Of each worker, at least 1.
  int spare_threads = 1;                         ///< Shared by the last models, at least `threads`.
  double timeout_s = 300.0;                      ///< Of one attempt; > 0.
  int attempts = 2;                              ///< For crashes and limits; at least 1.
  bool retry_failed = false;                     ///< Do again what failed before.
  bool verify = false;                           ///< Read every input again, whatever its stamp.
  bool quiet_workers = true;                     ///< Their messages go nowhere.
  /// Options hash of a model, with what its entry and its sidecar say of it.
  std::function<std::string(const Entry& entry)> options_hash{};
};

/// What has happened so far.
struct RunnerCounts {
  std::int64_t done = 0;            ///< Results written in this run.
  std::int64_t failed = 0;          ///< Recorded as failed in this run.
  std::int64_t skipped = 0;         ///< Done before, unchanged.
  std::int64_t skipped_failed = 0;  ///< Of these, failed before.
  std::int64_t duplicates = 0;      ///< Same content as another model; not run.
  std::int64_t renamed = 0;         ///< Files that an earlier run stored under another name.
  std::int64_t repeated = 0;        ///< Entries passed over: one before has their key.
  std::string first_repeated{};     ///< The first such key.
  std::int64_t doubted = 0;         ///< Answers, of this run or before, that should not be trusted.
  std::vector<std::string> first_doubted{};  ///< Keys of the first three.

  void note_doubt(const std::optional<ModelRecord>& record) {
    if (record && is_doubted(*record) && ++doubted <= 3) {
      first_doubted.push_back(record->key);
    }
  }
};

/// Runs every model of `source` that `book` does not hold as done, each in a worker process under
/// limits, and records how it ended. Results appear under options.folder/models/ whole or not at
/// all. \param report is called after every model, with its record, or null when idle.
/// \throw Cancelled if a stop was requested: nothing half done is left, all records are kept.
/// \throw IoError if the disk is full, or the book cannot be written.
RunnerCounts run_batch(EntrySource& source, ResultBook& book, const RunnerOptions& options,
                       const std::stop_token& stop,
                       const std::function<void(const RunnerCounts&, const ModelRecord*)>& report);

}  // namespace vantage::batch
