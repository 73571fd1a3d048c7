// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>

#include "batch/confined_folder.h"
#include "batch/model_record.h"
#include "batch/result_book.h"

namespace vantage::batch {

/// Puts records in the place of others. Equal models share one's results: when that model gets others, or
/// none, the first of them has the former results from then on.
class ResultHeirs {
 public:
  struct Options {
    /// The folder that a model's own results are to have. Null: they stay where they are, if they can.
    std::function<std::string(const ModelRecord& heir)> own_folder{};
    /// Whether results that no record names yet will come into a folder. Null: into none.
    std::function<bool(const std::string& folder)> is_claimed{};
    /// Whether there are results in a folder. Null: if it is there.
    std::function<bool(const std::string& folder)> is_there{};
    /// Moves results to a folder of that name. Null: at once.
    std::function<void(const std::string& from, const std::string& folder)> move{};
  };

  ResultHeirs(ResultBook& book, const ConfinedFolder& root);
  ResultHeirs(ResultBook& book, const ConfinedFolder& root, Options options);
  ResultHeirs(const ResultHeirs&) = delete;
  ResultHeirs& operator=(const ResultHeirs&) = delete;

  /// Puts results into the folder of a record that replace() is to put next. Until then no record names the
  /// folder: who is killed in between leaves none that has the results of another.
  /// \param staging name of the folder that holds them. \throw IoError
  void bring(const std::string& staging, const ModelRecord& record);

  /// Puts a record. \return the folder of results that it leaves; empty if there is none. \throw IoError
  [[nodiscard]] std::string replace(const ModelRecord& record);

  /// Removes results that are nobody's. \param folder may be empty.
  void remove_unowned(const std::string& folder);

  /// Gives the results of `former` to the first of the models that share them. \param replaced whether others
  /// come into their folder. \throw IoError
  void pass_on(const ModelRecord& former, bool replaced = false);

  /// Makes the models that have the results of `former` duplicates of `now`, whose results come into their
  /// place. \throw IoError
  void make_equal(const ModelRecord& former, const ModelRecord& now);

 private:
  /// \param wanted or that with a number behind it, where something is in its place.
  std::string free_folder(const std::string& wanted);

  ResultBook& book_;
  const ConfinedFolder& root_;
  Options options_;
};

}  // namespace vantage::batch
