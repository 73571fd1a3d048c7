// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <cstdio>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <tuple>

#include "batch/confined_folder.h"
#include "batch/result_book.h"

namespace vantage::batch {

/// One of `count` equal shares of the models.
struct Shard {
  std::uint32_t index = 0;  ///< In [0, count).
  std::uint32_t count = 1;  ///< At least 1.

  /// Whether a model belongs to it.
  [[nodiscard]] bool holds(const std::string& key) const { return of_key(key, count) == index; }

  /// The index of a model's shard: by a hash of its key, so that new models move no other one.
  static std::uint32_t of_key(const std::string& key, std::uint32_t count);
};

/// Parses "3/64". \throw InvalidInput
Shard parse_shard(const std::string& text);

/// The results of one shard: DIR/shards/shard-00003-of-00064.jsonl, one record a line, in the order
/// of keys. The file is always whole: it is replaced at checkpoints and at the end; between them
/// records are appended to a .log beside it, from which a killed shard resumes. Nothing is shared
/// between shards but the file system.
class ShardLog : public ResultBook {
 public:
  /// \throw IoError
  ShardLog(const std::string& folder, const Shard& shard);
  ~ShardLog() override;

  std::optional<ModelRecord> find(const std::string& key) override;
  std::optional<ModelRecord> find_content(const ModelRecord& like) override;
  std::vector<ModelRecord> find_equals(const ModelRecord& like) override;
  std::optional<ModelRecord> find_duplicate(const ModelRecord& like) override;
  std::string owner_of(const std::string& folder) override;
  std::int64_t latest_ms() override;
  void put(const ModelRecord& record) override;
  void finish() override;

 private:
  /// By content, options and version: whether they failed, positions and keys.
  using KeysOfContent =
      std::map<std::string, std::set<std::tuple<bool, std::int64_t, std::string>>>;

  void read(const std::string& name);
  std::optional<ModelRecord> first_of(const KeysOfContent& keys, const ModelRecord& like) const;
  void remember(const ModelRecord& record);
  void open_log();

  ConfinedFolder folder_;
  std::string name_;
  std::string log_name_;
  std::FILE* log_ = nullptr;
  std::size_t unsaved_ = 0;
  std::size_t saved_ = 0;  ///< Records in the file.
  std::map<std::string, ModelRecord> records_{};
  KeysOfContent runs_of_content_{};
  KeysOfContent duplicates_of_content_{};  ///< That are done.
  std::map<std::string, std::string> owner_of_folder_{};
};

/// Reads every record of a shard file or its log, which must be a regular file; lines that are torn
/// or hold no sound record are passed over. \return how many these were. \throw IoError
std::size_t read_shard_file(const std::string& path,
                            const std::function<void(const ModelRecord&)>& take);

/// Whether a name is that of a shard file or its log.
bool is_shard_file(std::string_view name);

/// Name, in a batch's folder, of the folder of the shard files.
inline constexpr const char* kShardFolder = "shards";

}  // namespace vantage::batch
