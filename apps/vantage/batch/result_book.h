// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "batch/model_record.h"

namespace vantage::batch {

/// Where a batch writes down how its models ended, and looks up what is done already.
class ResultBook {
 public:
  ResultBook() = default;
  ResultBook(const ResultBook&) = delete;
  ResultBook& operator=(const ResultBook&) = delete;
  virtual ~ResultBook() = default;

  /// The record of a model. \throw IoError
  virtual std::optional<ModelRecord> find(const std::string& key) = 0;

  /// The first model by position that was really run on this content with these options and
  /// version, and is done; if none is, the first that failed by its content. \throw IoError
  virtual std::optional<ModelRecord> find_content(const ModelRecord& like) = 0;

  /// All models of this content, these options and this version. \throw IoError
  virtual std::vector<ModelRecord> find_equals(const ModelRecord& like) = 0;

  /// The first model by position of this content, these options and this version that is done and has
  /// the results of another. \throw IoError
  virtual std::optional<ModelRecord> find_duplicate(const ModelRecord& like) = 0;

  /// Key of the model whose results are in this folder; empty if there is none. \throw IoError
  virtual std::string owner_of(const std::string& folder) = 0;

  /// When the last record was finished, ms since 1970; 0 if there is none. \throw IoError
  virtual std::int64_t latest_ms() = 0;

  /// Adds or replaces a record. It outlives the process; the last ones may be lost with the power, and
  /// their models are done again. \throw IoError
  virtual void put(const ModelRecord& record) = 0;

  /// Puts everything in its final place. \throw IoError
  virtual void finish() {}
};

}  // namespace vantage::batch
