// SPDX-License-Identifier: MIT
#include "batch/results_store.h"

#include <string>

#include <gtest/gtest.h>

#include "vantage/core/error.h"

#include "support/temporary_folder.h"
#include "unit/batch/first_of_equals.h"

namespace vantage::batch {
namespace {

ModelRecord record(const std::string& key, std::int64_t position, const std::string& content,
                   const std::string& status = "done") {
  ModelRecord made;
  made.key = key;
  made.position = position;
  made.content = content;
  made.status = status;
  made.folder = status == "done" ? "of-" + key : "";
  made.result = status == "done" ? R"({"total":)" + std::to_string(position) + "}" : "";
  return made;
}

std::string column(ResultsStore& store, const std::string& name) {
  Statement rows = store.select(name, "", "");
  std::string text;
  while (rows.step()) {
    text += rows.text(0) + ";";
  }
  return text;
}

TEST(ResultsStore, ARecordReadsBackAfterReopening) {
  const test::TemporaryFolder scratch;
  { ResultsStore(scratch.file(), Database::Mode::Create).put(record("k", 3, "c")); }
  ResultsStore store(scratch.file(), Database::Mode::Read);
  const auto read = store.find("k");
  ASSERT_TRUE(read);
  EXPECT_EQ(read->position, 3);
  EXPECT_EQ(read->result, R"({"total":3})");
  EXPECT_FALSE(store.find("other"));
}

TEST(ResultsStore, KeepsWhatFilesBesideAModelWereLike) {
  const test::TemporaryFolder scratch;
  ModelRecord made = record("k", 3, "c");
  made.beside = {{"a.mtl", {10, 20, 30}}, {"Bilder/ö.png", {}}};
  { ResultsStore(scratch.file(), Database::Mode::Create).put(made); }
  ResultsStore store(scratch.file(), Database::Mode::Read);
  EXPECT_EQ(store.find("k")->beside, made.beside);
}

TEST(ResultsStore, KnowsWhetherTheOverviewShowsItAsItIs) {
  const test::TemporaryFolder scratch;
  const auto open = [&] { return ResultsStore(scratch.file(), Database::Mode::Create); };
  EXPECT_FALSE(open().has_overview());
  ResultsStore store = open();
  store.note_overview(store.changes());  // as of a store that was made before this was noted
  EXPECT_TRUE(store.has_overview());
  store.put(record("k", 3, "c"));
  EXPECT_FALSE(store.has_overview());
  const std::int64_t before = store.changes();
  store.put(record("k", 3, "c"));
  store.note_overview(before);  // one that was begun before the last put
  EXPECT_FALSE(store.has_overview());
  store.note_overview(store.changes());
  EXPECT_TRUE(open().has_overview());
  store.forget("k");
  EXPECT_FALSE(open().has_overview());
}

TEST(ResultsStore, AStoreOfBeforeThatIsReadAndGoesOn) {
  const test::TemporaryFolder scratch;
  { ResultsStore(scratch.file(), Database::Mode::Create).put(record("k", 3, "c")); }
  {
    Database database(scratch.file() + "/" + ResultsStore::kFileName, Database::Mode::Create);
    database.run("ALTER TABLE models DROP COLUMN beside; PRAGMA user_version = 1");
  }
  {
    ResultsStore store(scratch.file(), Database::Mode::Read);
    EXPECT_EQ(store.find("k")->position, 3);
    EXPECT_TRUE(store.find("k")->beside.empty());
  }
  ResultsStore store(scratch.file(), Database::Mode::Create);
  EXPECT_EQ(store.find("k")->position, 3);
  ModelRecord made = record("new", 4, "d");
  made.beside = {{"a.mtl", {10, 20, 30}}};
  store.put(made);
  EXPECT_EQ(store.find("new")->beside, made.beside);
}

TEST(ResultsStore, EqualModelsStandForOneHoweverManyOfThemWereRun) {
  const test::TemporaryFolder scratch;
  ResultsStore store(scratch.file(), Database::Mode::Create);
  store.put(record("a", 5, "same"));
  store.put(record("b", 1, "same"));
  store.put(record("c", 9, "other"));
  EXPECT_EQ(column(store, "duplicate_of"), "b;;;");
  EXPECT_EQ(column(store, "folder"), "of-b;of-b;of-c;");
  EXPECT_EQ(store.counts().done, 2);
  EXPECT_EQ(store.counts().duplicates, 1);
}

TEST(ResultsStore, AModelThatIsDoneStandsForOneThatFailedAndAChangedOneForNone) {
  const test::TemporaryFolder scratch;
  ResultsStore store(scratch.file(), Database::Mode::Create);
  ModelRecord crashed = record("a", 0, "same", "failed");
  crashed.reason = "crash";
  ModelRecord changed = record("b", 1, "same", "failed");
  changed.reason = "changed";
  store.put(crashed);
  store.put(changed);
  store.put(record("c", 2, "same"));
  EXPECT_EQ(column(store, "status"), "done;failed;done;");
  EXPECT_EQ(column(store, "duplicate_of"), "c;;;");
}

TEST(ResultsStore, ModelsThatCouldNotBeReadAreNotEqual) {
  const test::TemporaryFolder scratch;
  ResultsStore store(scratch.file(), Database::Mode::Create);
  store.put(record("a", 0, "", "failed"));
  store.put(record("b", 1, "", "failed"));
  EXPECT_EQ(store.counts().failed, 2);
  EXPECT_EQ(column(store, "duplicate_of"), ";;");
}

TEST(ResultsStore, MergingTwiceChangesNothing) {
  const test::TemporaryFolder scratch;
  ResultsStore store(scratch.file(), Database::Mode::Create);
  EXPECT_TRUE(store.merge(record("a", 0, "A")));
  EXPECT_FALSE(store.merge(record("a", 0, "A")));
  EXPECT_FALSE(store.merge(record("a", 0, "A", "failed")));
}

TEST(ResultsStore, AFolderWithoutOneIsRefusedForReading) {
  const test::TemporaryFolder scratch;
  EXPECT_THROW(ResultsStore(scratch.file(), Database::Mode::Read), IoError);
}

TEST(ResultsStore, AFileThatIsNoDatabaseIsRefused) {
  const test::TemporaryFolder scratch;
  const std::string path =
      scratch.write(ResultsStore::kFileName, std::string(4096, 'x') + "no database at all");
  EXPECT_THROW(ResultsStore(scratch.file(), Database::Mode::Create), IoError) << path;
}

TEST(ResultsStore, FindsAllModelsOfOneContentOptionsAndVersion) {
  const test::TemporaryFolder scratch;
  ResultsStore store(scratch.file(), Database::Mode::Create);
  ModelRecord other = record("d", 3, "A");
  other.options = "another";
  for (const ModelRecord& each :
       {record("b", 0, "A"), record("a", 1, "A"), record("c", 2, "B"), other}) {
    store.put(each);
  }
  std::string keys;
  for (const ModelRecord& equal : store.find_equals(record("new", 9, "A"))) {
    keys += equal.key;
  }
  EXPECT_EQ(keys, "ab");
}

TEST(ResultsStore, FindsTheFirstOfEqualModelsThatIsDone) {
  const test::TemporaryFolder scratch;
  ResultsStore book(scratch.file(), Database::Mode::Create);
  test::expect_finds_what_stands_for_a_content(book);
}

TEST(ResultsStore, FindsTheFirstThatHasTheResultsOfAnother) {
  const test::TemporaryFolder scratch;
  ResultsStore book(scratch.file(), Database::Mode::Create);
  test::expect_finds_first_duplicate(book);
}

TEST(ResultsStore, KeysMayHoldQuotesAndLineEnds) {
  const test::TemporaryFolder scratch;
  ResultsStore store(scratch.file(), Database::Mode::Create);
  const std::string key = "'); DROP TABLE models;--\n\"";
  store.put(record(key, 0, "A"));
  EXPECT_TRUE(store.find(key));
}

}  // namespace
}  // namespace vantage::batch
