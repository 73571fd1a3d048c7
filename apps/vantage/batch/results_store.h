// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "batch/model_record.h"
#include "batch/result_book.h"
#include "batch/sqlite.h"

namespace vantage::batch {

/// How many models ended how.
struct StatusCounts {
  std::int64_t done = 0;        ///< Run, with results.
  std::int64_t failed = 0;      ///< Without results, duplicates of failed ones included.
  std::int64_t duplicates = 0;  ///< Of models that are done.
};

/// The results of a batch: DIR/results.sqlite, in write-ahead mode, so that a process killed at any
/// moment leaves every record that was put and nothing else.
class ResultsStore : public ResultBook {
 public:
  /// File name inside the batch's folder.
  static constexpr const char* kFileName = "results.sqlite";

  /// Opens the store of a folder, making it if `mode` says so.
  /// \throw IoError if there is none, or it was written by a newer version.
  ResultsStore(const std::string& folder, Database::Mode mode);
  ~ResultsStore() override;

  std::optional<ModelRecord> find(const std::string& key) override;
  std::optional<ModelRecord> find_content(const ModelRecord& like) override;
  std::vector<ModelRecord> find_equals(const ModelRecord& like) override;
  std::optional<ModelRecord> find_duplicate(const ModelRecord& like) override;
  std::string owner_of(const std::string& folder) override;
  std::int64_t latest_ms() override;
  void put(const ModelRecord& record) override;

  /// Puts a record unless one that is to be kept is there. \return whether it was put.
  bool merge(const ModelRecord& record);

  /// Removes the record of that key.
  void forget(const std::string& key);

  /// How often records were put or removed, in all.
  std::int64_t changes();

  /// Notes that the folder's overview shows the records after so many changes.
  void note_overview(std::int64_t changes);

  /// Whether it shows them as they are, whatever ended the program since.
  bool has_overview();

  /// Makes the puts until commit() one transaction.
  void begin() { database_.run("BEGIN IMMEDIATE"); }

  void commit() { database_.run("COMMIT"); }

  /// Every record as it was put, by key.
  void for_each_record(const std::function<void(const ModelRecord&)>& take);

  /// Rows of the view `results` (docs/batch.md lists its columns), as a statement to step.
  /// \param where conditions with ?1, ?2, …; may be empty. \param order columns, may be empty.
  Statement select(const std::string& columns, const std::string& where, const std::string& order);

  /// Counts over the view `results`.
  StatusCounts counts();

  /// Models whose answers should not be trusted, each content once.
  std::int64_t count_doubted();

  /// Lets SQLite check the database. \throw IoError if it finds damage.
  void check_integrity();

 private:
  struct Statements;

  Database database_;
  std::string columns_{};  // of a record
  std::unique_ptr<Statements> statements_;
};

/// Columns of the view `results` in the order of exports; the last ones, which differ between equal
/// runs, are those of the timings.
const std::vector<std::string>& result_columns();
const std::vector<std::string>& timing_columns();

}  // namespace vantage::batch
