// SPDX-License-Identifier: MIT
#include "batch/results_store.h"

#include <filesystem>

#include "vantage/core/error.h"

#include "batch/json_text.h"
#include "batch/shard_log.h"

namespace vantage::batch {
namespace {

constexpr std::int64_t kSchema = 2;
// From here on records name the files beside a model.
constexpr std::int64_t kSchemaWithBeside = 2;

constexpr const char* kTables = R"sql(
CREATE TABLE IF NOT EXISTS models(
  key TEXT PRIMARY KEY, position INTEGER NOT NULL, size_bytes INTEGER NOT NULL,
  modified_ns INTEGER NOT NULL, inode INTEGER NOT NULL, content TEXT NOT NULL,
  options TEXT NOT NULL, version TEXT NOT NULL, status TEXT NOT NULL, reason TEXT NOT NULL,
  error TEXT NOT NULL, folder TEXT NOT NULL, duplicate_of TEXT NOT NULL, name TEXT NOT NULL,
  result TEXT NOT NULL, beside TEXT NOT NULL DEFAULT '') WITHOUT ROWID;
CREATE INDEX IF NOT EXISTS models_content ON models(content, options, version, position)
  WHERE content <> '' AND duplicate_of = '' AND reason <> 'name';
CREATE INDEX IF NOT EXISTS models_folder ON models(folder) WHERE folder <> '';
CREATE TABLE IF NOT EXISTS timings(
  key TEXT PRIMARY KEY, seconds REAL NOT NULL, peak_bytes INTEGER NOT NULL,
  attempts INTEGER NOT NULL, finished_ms INTEGER NOT NULL) WITHOUT ROWID;
)sql";

// Older stores get these, too: older programs pass over them. The overview shows the records as they were after
// so many changes.
constexpr const char* kAdditions = R"sql(
CREATE INDEX IF NOT EXISTS models_duplicates ON models(content, options, version, position)
  WHERE duplicate_of <> '' AND status = 'done';
CREATE TABLE IF NOT EXISTS overview(
  id INTEGER PRIMARY KEY, changes INTEGER NOT NULL, shown INTEGER NOT NULL);
)sql";

constexpr const char* kNoteChange =
    "INSERT INTO overview VALUES(1, 1, -1) ON CONFLICT(id) DO UPDATE SET changes = changes + 1";

// Models with the same content stand for one: the first by position that was run, done before failed. The view answers
// for all of them with its results, so that it does not matter who ran them, or in how many shards.
constexpr const char* kView = R"sql(VIEW results AS
SELECT m.key AS key, m.name AS name, c.status AS status,
  CASE WHEN c.key = m.key THEN '' ELSE c.key END AS duplicate_of,
  c.reason AS reason,
  CASE WHEN m.reason = c.reason AND m.error <> '' THEN m.error ELSE c.error END AS error,
  m.content AS content, m.options AS options,
  m.version AS version, c.folder AS folder,
  json_extract(c.result, '$.format') AS format, json_extract(c.result, '$.vertices') AS vertices,
  json_extract(c.result, '$.faces') AS faces, json_extract(c.result, '$.components') AS components,
  json_extract(c.result, '$.closed') AS closed, json_extract(c.result, '$.genus') AS genus,
  json_extract(c.result, '$.total') AS total,
  json_extract(c.result, '$.best.score') AS best_score,
  json_extract(c.result, '$.best.score_fraction') AS best_fraction,
  json_extract(c.result, '$.best.direction[0]') AS best_dx,
  json_extract(c.result, '$.best.direction[1]') AS best_dy,
  json_extract(c.result, '$.best.direction[2]') AS best_dz,
  json_extract(c.result, '$.best.model_viewer."camera-orbit"') AS best_camera_orbit,
  json_extract(c.result, '$.best.model_viewer."camera-target"') AS best_camera_target,
  json_extract(c.result, '$.best.model_viewer."field-of-view"') AS best_field_of_view,
  json_extract(c.result, '$.worst.score') AS worst_score,
  json_extract(c.result, '$.worst.score_fraction') AS worst_fraction,
  json_extract(c.result, '$.worst.direction[0]') AS worst_dx,
  json_extract(c.result, '$.worst.direction[1]') AS worst_dy,
  json_extract(c.result, '$.worst.direction[2]') AS worst_dz,
  json_array_length(c.result, '$.doubts') AS doubts,
  c.result AS result,
  t.seconds AS seconds, t.peak_bytes AS peak_bytes, t.attempts AS attempts,
  t.finished_ms AS finished_ms
FROM models m
JOIN models c ON c.key = CASE WHEN m.content = '' OR m.reason IN ('name', 'changed')
  THEN m.key ELSE COALESCE(
  (SELECT f.key FROM models f
   WHERE f.content <> '' AND f.duplicate_of = '' AND f.reason <> 'name' AND f.reason <> 'changed'
     AND f.content = m.content AND f.options = m.options AND f.version = m.version
   ORDER BY f.status <> 'done', f.position, f.key LIMIT 1), m.key) END
LEFT JOIN timings t ON t.key = m.key;
)sql";

/// What record_of() reads.
std::string columns_of_record(bool has_beside) {
  return std::string(
             "m.key, m.position, m.size_bytes, m.modified_ns, m.inode, m.content, m.options, "
             "m.version, m.status, m.reason, m.error, m.folder, m.duplicate_of, m.name, m.result, "
             "COALESCE(t.seconds, 0), COALESCE(t.peak_bytes, 0), COALESCE(t.attempts, 0), "
             "COALESCE(t.finished_ms, 0), ") +
         (has_beside ? "m.beside" : "''") + " FROM models m LEFT JOIN timings t ON t.key = m.key ";
}

ModelRecord record_of(const Statement& row) {
  ModelRecord record;
  record.key = row.text(0);
  record.position = row.integer(1);
  record.stamp = {row.integer(2), row.integer(3), static_cast<std::uint64_t>(row.integer(4))};
  std::string ModelRecord::*const texts[] = {&ModelRecord::content, &ModelRecord::options,
                                             &ModelRecord::version, &ModelRecord::status,
                                             &ModelRecord::reason,  &ModelRecord::error,
                                             &ModelRecord::folder,  &ModelRecord::duplicate_of,
                                             &ModelRecord::name,    &ModelRecord::result};
  int column = 5;
  for (const auto member : texts) {
    record.*member = row.text(column++);
  }
  record.result = record.result == "{}" ? "" : record.result;  // nothing is known of a failure
  record.timings = {row.number(15), row.integer(16), static_cast<int>(row.integer(17)),
                    row.integer(18)};
  record.beside = beside_of(parsed_json(row.text(19)));
  return record;
}

// Things in a database that no store has: anything but its own, where it is not finished yet;
// else what runs when a record is put, or is read in the place of one.
constexpr const char* kForeign =
    "SELECT COUNT(*) FROM sqlite_schema WHERE name NOT IN ('models', 'timings', 'results', "
    "'models_content', 'models_folder', 'models_duplicates') AND name NOT LIKE 'sqlite%'";
constexpr const char* kOdd =
    "SELECT COUNT(*) + (SELECT 2 - COUNT(*) FROM sqlite_schema WHERE type = 'table' AND "
    "name IN ('models', 'timings')) FROM sqlite_schema WHERE type = 'trigger' OR "
    "sql LIKE 'CREATE VIRTUAL%'";

std::int64_t number_of(Database& database, const std::string& question) {
  Statement answer(database, question);
  answer.step();
  return answer.integer(0);
}

std::string store_path(const std::string& folder, Database::Mode mode) {
  const auto path = std::filesystem::path(folder) / ResultsStore::kFileName;
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::symlink_status(path, error);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
    throw IoError(path.string(), "is not a regular file but a link or a folder; move it away");
  }
  if (mode == Database::Mode::Read && !std::filesystem::exists(status)) {
    const bool has_shards = std::filesystem::exists(path.parent_path() / kShardFolder, error);
    throw IoError(folder, has_shards
                              ? "holds shards that are not merged yet; vantage results merge " +
                                    folder + " does that"
                              : "holds no results of a batch: " +
                                    std::string(ResultsStore::kFileName) + " is not there");
  }
  return path.string();
}

}  // namespace

struct ResultsStore::Statements {
  Statements(Database& database, Database::Mode mode, const std::string& columns, bool has_beside)
      : find(database, "SELECT " + columns + "WHERE m.key = ?1"),
        find_content(database,
                     "SELECT " + columns +
                         "WHERE m.content <> '' AND m.duplicate_of = '' AND m.reason <> 'name' AND "
                         "m.reason <> 'changed' AND m.content = ?1 AND m.options = ?2 AND "
                         "m.version = ?3 ORDER BY m.status <> 'done', m.position, m.key LIMIT 1"),
        owner(database, "SELECT key FROM models WHERE folder <> '' AND folder = ?1 LIMIT 1"),
        put(database,
            "INSERT OR REPLACE INTO models "
            "VALUES(?1,?2,?3,?4,?5,?6,?7,?8,?9,?10,?11,?12,?13,?14,?15" +
                std::string(has_beside ? ",?16)" : ")")),
        put_timings(database, "INSERT OR REPLACE INTO timings VALUES(?1,?2,?3,?4,?5)"),
        savepoint(database, "SAVEPOINT one"),
        release(database, "RELEASE one") {
    if (mode == Database::Mode::Create) {  // what is only read may have no such table
      note_change.emplace(database, kNoteChange);
    }
  }

  Statement find, find_content, owner, put, put_timings, savepoint, release;
  std::optional<Statement> note_change{};
};

ResultsStore::ResultsStore(const std::string& folder, Database::Mode mode)
    : database_(store_path(folder, mode), mode) {
  // What somebody else wrote into the schema is not run.
  database_.run("PRAGMA trusted_schema = OFF; PRAGMA cell_size_check = ON;");
  const std::int64_t schema = number_of(database_, "PRAGMA user_version");
  if (schema > kSchema) {
    throw IoError(database_.path(), "was written by a newer version of vantage; use that one");
  }
  if (number_of(database_, schema == 0 ? kForeign : kOdd) > 0) {
    throw IoError(database_.path(),
                  "is a database, but not of results of a batch; choose another folder");
  }
  database_.run("PRAGMA journal_mode = WAL; PRAGMA synchronous = NORMAL;");
  const bool is_old = schema > 0 && schema < kSchemaWithBeside;
  if (schema < kSchema && mode == Database::Mode::Create) {
    const char* const added =
        is_old ? "ALTER TABLE models ADD COLUMN beside TEXT NOT NULL DEFAULT '';" : "";
    database_.run(std::string("BEGIN IMMEDIATE;") + kTables + added +
                  "DROP VIEW IF EXISTS results; CREATE " + kView +
                  "PRAGMA user_version = " + std::to_string(kSchema) + "; COMMIT;");
  }
  if (mode == Database::Mode::Create) {
    database_.run(kAdditions);
  }
  // Before the view of that name in the file, which may say anything.
  database_.run(std::string("CREATE TEMP ") + kView);
  const bool has_beside = !is_old || mode == Database::Mode::Create;
  columns_ = columns_of_record(has_beside);
  statements_ = std::make_unique<Statements>(database_, mode, columns_, has_beside);
}

ResultsStore::~ResultsStore() = default;

std::optional<ModelRecord> ResultsStore::find(const std::string& key) {
  Statement& find = statements_->find;
  find.bind(1, key);
  std::optional<ModelRecord> record;
  if (find.step()) {
    record = record_of(find);
  }
  find.reset();
  return record;
}

std::optional<ModelRecord> ResultsStore::find_content(const ModelRecord& like) {
  Statement& find = statements_->find_content;
  find.bind(1, like.content).bind(2, like.options).bind(3, like.version);
  std::optional<ModelRecord> record;
  if (find.step()) {
    record = record_of(find);
  }
  find.reset();
  return record;
}

std::vector<ModelRecord> ResultsStore::find_equals(const ModelRecord& like) {
  Statement equals(database_, "SELECT " + columns_ +
                                  "WHERE m.content <> '' AND m.content = ?1 AND m.options = ?2 AND "
                                  "m.version = ?3 ORDER BY m.key");
  equals.bind(1, like.content).bind(2, like.options).bind(3, like.version);
  std::vector<ModelRecord> records;
  while (equals.step()) {
    records.push_back(record_of(equals));
  }
  return records;
}

std::optional<ModelRecord> ResultsStore::find_duplicate(const ModelRecord& like) {
  Statement duplicate(database_,
                      "SELECT " + columns_ +
                          "WHERE m.duplicate_of <> '' AND m.status = 'done' AND m.content = ?1 AND "
                          "m.options = ?2 AND m.version = ?3 ORDER BY m.position, m.key LIMIT 1");
  duplicate.bind(1, like.content).bind(2, like.options).bind(3, like.version);
  return duplicate.step() ? std::optional(record_of(duplicate)) : std::nullopt;
}

std::string ResultsStore::owner_of(const std::string& folder) {
  Statement& owner = statements_->owner;
  owner.bind(1, folder);
  std::string key = owner.step() ? owner.text(0) : std::string();
  owner.reset();
  return key;
}

std::int64_t ResultsStore::latest_ms() {
  Statement latest(database_, "SELECT COALESCE(MAX(finished_ms), 0) FROM timings");
  latest.step();
  return latest.integer(0);
}

void ResultsStore::put(const ModelRecord& record) {
  statements_->savepoint.run();
  Statement& put = statements_->put;
  put.bind(1, record.key).bind(2, record.position).bind(3, record.stamp.size_bytes);
  put.bind(4, record.stamp.modified_ns).bind(5, static_cast<std::int64_t>(record.stamp.inode));
  put.bind(6, record.content).bind(7, record.options).bind(8, record.version);
  put.bind(9, record.status).bind(10, record.reason).bind(11, record.error);
  put.bind(12, record.folder).bind(13, record.duplicate_of).bind(14, record.name);
  put.bind(15, record.result.empty() ? std::string_view("{}") : record.result);
  const std::string beside = record.beside.empty() ? "" : json_text(to_json(record.beside));
  put.bind(16, std::string_view(beside));
  put.run();
  Statement& timings = statements_->put_timings;
  timings.bind(1, record.key).bind(2, record.timings.seconds).bind(3, record.timings.peak_bytes);
  timings.bind(4, std::int64_t{record.timings.attempts}).bind(5, record.timings.finished_ms);
  timings.run();
  statements_->note_change.value().run();
  statements_->release.run();
}

bool ResultsStore::merge(const ModelRecord& record) {
  const std::optional<ModelRecord> held = find(record.key);
  if (held && !supersedes(record, *held)) {
    return false;
  }
  put(record);
  return true;
}

void ResultsStore::forget(const std::string& key) {
  statements_->note_change.value().run();
  for (const char* const table : {"models", "timings"}) {
    Statement remove(database_, std::string("DELETE FROM ") + table + " WHERE key = ?1");
    remove.bind(1, key);
    remove.run();
  }
}

std::int64_t ResultsStore::changes() {
  return number_of(database_, "SELECT COALESCE(MAX(changes), 0) FROM overview");
}

void ResultsStore::note_overview(std::int64_t changes) {
  Statement note(database_,
                 "INSERT INTO overview VALUES(1, ?1, ?1) ON CONFLICT(id) DO UPDATE SET shown = ?1");
  note.bind(1, changes).run();
}

bool ResultsStore::has_overview() {
  return number_of(database_, "SELECT COUNT(*) FROM overview WHERE shown = changes") > 0;
}

void ResultsStore::for_each_record(const std::function<void(const ModelRecord&)>& take) {
  Statement rows(database_, "SELECT " + columns_ + "ORDER BY m.key");
  while (rows.step()) {
    take(record_of(rows));
  }
}

Statement ResultsStore::select(const std::string& columns, const std::string& where,
                               const std::string& order) {
  return {database_, "SELECT " + columns + " FROM results" +
                         (where.empty() ? "" : " WHERE " + where) + " ORDER BY " +
                         (order.empty() ? "" : order + ", ") + "key"};
}

StatusCounts ResultsStore::counts() {
  Statement row(database_,
                "SELECT COALESCE(SUM(status = 'done' AND duplicate_of = ''), 0), "
                "COALESCE(SUM(status <> 'done'), 0), "
                "COALESCE(SUM(status = 'done' AND duplicate_of <> ''), 0) FROM results");
  row.step();
  return {row.integer(0), row.integer(1), row.integer(2)};
}

std::int64_t ResultsStore::count_doubted() {
  return number_of(database_,
                   "SELECT COUNT(*) FROM results WHERE doubts > 0 AND duplicate_of = ''");
}

void ResultsStore::check_integrity() {
  Statement check(database_, "PRAGMA integrity_check");
  check.step();
  if (check.text(0) != "ok") {
    throw IoError(database_.path(), "is damaged: " + check.text(0));
  }
}

const std::vector<std::string>& result_columns() {
  static const std::vector<std::string> kNames{"key",
                                               "name",
                                               "status",
                                               "duplicate_of",
                                               "reason",
                                               "error",
                                               "content",
                                               "options",
                                               "version",
                                               "folder",
                                               "format",
                                               "vertices",
                                               "faces",
                                               "components",
                                               "closed",
                                               "genus",
                                               "total",
                                               "best_score",
                                               "best_fraction",
                                               "best_dx",
                                               "best_dy",
                                               "best_dz",
                                               "best_camera_orbit",
                                               "best_camera_target",
                                               "best_field_of_view",
                                               "worst_score",
                                               "worst_fraction",
                                               "worst_dx",
                                               "worst_dy",
                                               "worst_dz",
                                               "doubts"};
  return kNames;
}

const std::vector<std::string>& timing_columns() {
  static const std::vector<std::string> kNames{"seconds", "peak_bytes", "attempts", "finished_ms"};
  return kNames;
}

}  // namespace vantage::batch
