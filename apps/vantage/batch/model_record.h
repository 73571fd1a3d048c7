// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

/// \file
/// What a batch knows about one model: the row of the results store and the line of a shard file.

namespace vantage::batch {

/// What a file looked like when it was read; trusted to notice a change without reading it again.
struct FileStamp {
  std::int64_t size_bytes = -1;  ///< −1: unknown.
  std::int64_t modified_ns = 0;  ///< Since 1970, nanoseconds.
  std::uint64_t inode = 0;       ///< Of the file, or of the archive that holds it.
  bool operator==(const FileStamp&) const = default;
};

/// A file that a model names, as it was when the model was read.
struct StampBeside {
  std::string name{};  ///< Relative to the model's folder, UTF-8, see key_of_path().
  FileStamp stamp{};
  bool operator==(const StampBeside&) const = default;
};

/// What differs between two runs over the same inputs; kept apart from everything else.
struct Timings {
  double seconds = 0.0;          ///< Wall clock of the last attempt.
  std::int64_t peak_bytes = 0;   ///< Resident memory of the worker during it.
  int attempts = 0;              ///< 0 for duplicates: nothing was run.
  std::int64_t finished_ms = 0;  ///< Or found to be what it was; since 1970, milliseconds.
};

/// One model and how it ended.
struct ModelRecord {
  std::string key{};          ///< Identity within a run: UTF-8, see key_of_path().
  std::int64_t position = 0;  ///< Place in the input; the first of equal models is the one done.
  FileStamp stamp{};          ///< Of the input.
  std::vector<StampBeside> beside{};  ///< Of the files that it consists of besides.
  std::string content{};       ///< SHA-256 of the model's bytes, hexadecimal; empty if unreadable.
  std::string options{};       ///< Sixteen hexadecimal digits.
  std::string version{};       ///< Of the program.
  std::string status{};        ///< "done" or "failed".
  std::string reason{};        ///< Of a failure: input, changed, crash, timeout, memory, output,
                               ///< name, work.
  std::string error{};         ///< Of a failure: one sentence.
  std::string folder{};        ///< Of the results, relative to the batch's folder; empty if none.
  std::string duplicate_of{};  ///< Key of the model with the same content whose results count.
  std::string name{};          ///< As in view.json.
  std::string result{};        ///< JSON: numbers and cameras of best and worst; empty if failed.
  Timings timings{};           ///< Not part of the result.
};

/// Reasons that may vanish when tried again; the others are the model's or the user's.
bool may_pass_next_time(const std::string& reason);

/// Whether a reason, or none, is that of a model's content; else it is one of its file or its name, and says
/// nothing of equal models.
bool is_of_content(const std::string& reason);

/// Whether its answer should not be trusted, for a reason that its view.json has.
bool is_doubted(const ModelRecord& record);

/// Whether two records answer, or ask, for the same thing of a model.
bool same_question(const ModelRecord& a, const ModelRecord& b);

/// Whether the results of one count for the other.
bool have_one_answer(const ModelRecord& a, const ModelRecord& b);

/// What equal models have in common.
std::string content_key(const ModelRecord& record);

/// A record as one JSON object, keys in a fixed order.
nlohmann::ordered_json to_json(const ModelRecord& record);

/// Such files as JSON, and back; of text that is none of ours nothing. A file whose stamp is unknown was
/// not there.
nlohmann::ordered_json to_json(const std::vector<StampBeside>& beside);
std::vector<StampBeside> beside_of(const nlohmann::ordered_json& json);

/// Whether a record can be one of ours, whoever wrote it: a folder that is a ConfinedFolder's name, a
/// status that there is, a result that is a JSON object of sound depth.
bool is_sound(const ModelRecord& record);

/// Reads to_json(). Empty if the text is not a sound record (a torn last line, for instance).
std::optional<ModelRecord> record_from_line(const std::string& line);

/// Whether `a` is to be kept where two shards or runs recorded the same model: of equal content, options
/// and version done before failed; else the one finished later, then by text.
bool supersedes(const ModelRecord& a, const ModelRecord& b);

}  // namespace vantage::batch
