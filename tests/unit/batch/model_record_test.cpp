// SPDX-License-Identifier: MIT
#include "batch/model_record.h"

#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace vantage::batch {
namespace {

ModelRecord full_record() {
  return {.key = "k\n\"",
          .position = 7,
          .stamp = {1, -2, 3},
          .content = "c",
          .options = "o",
          .version = "v",
          .status = "done",
          .reason = "",
          .error = "",
          .folder = "f",
          .duplicate_of = "d",
          .name = "n",
          .result = R"({"total":0.1})",
          .timings = {1.5, 2, 3, 4}};
}

TEST(ModelRecord, ReadsBackWhatItWrites) {
  const ModelRecord record = full_record();
  const std::string line = to_json(record).dump();
  EXPECT_EQ(line.find('\n'), std::string::npos);
  const auto read = record_from_line(line);
  ASSERT_TRUE(read);
  EXPECT_EQ(to_json(*read), to_json(record));
}

TEST(ModelRecord, EveryTornLineIsNoRecord) {
  const std::string line = to_json(full_record()).dump();
  for (std::size_t length = 0; length < line.size(); ++length) {
    ASSERT_FALSE(record_from_line(line.substr(0, length))) << length;
  }
}

TEST(ModelRecord, ARecordThatIsDoneStandsAgainstALaterFailure) {
  ModelRecord done = full_record();
  ModelRecord failed = full_record();
  failed.status = "failed";
  failed.timings.finished_ms = done.timings.finished_ms + 1;
  EXPECT_TRUE(supersedes(done, failed));
  EXPECT_FALSE(supersedes(failed, done));
}

// An old answer once hid that the file was broken since, or that new options fail.
TEST(ModelRecord, ALaterFailureAtOtherContentOrOptionsReplacesWhatWasDone) {
  for (std::string ModelRecord::*const member :
       {&ModelRecord::content, &ModelRecord::options, &ModelRecord::version}) {
    const ModelRecord done = full_record();
    ModelRecord failed = full_record();
    failed.status = "failed";
    failed.*member = "other";
    failed.timings.finished_ms = done.timings.finished_ms + 1;
    EXPECT_TRUE(supersedes(failed, done));
    EXPECT_FALSE(supersedes(done, failed));
  }
}

TEST(ModelRecord, OfTwoAlikeTheLaterOneIsKeptAndOneNeverReplacesItself) {
  ModelRecord early = full_record();
  ModelRecord late = full_record();
  late.timings.finished_ms = early.timings.finished_ms + 1;
  EXPECT_TRUE(supersedes(late, early));
  EXPECT_FALSE(supersedes(early, late));
  EXPECT_FALSE(supersedes(early, early));
}

}  // namespace
}  // namespace vantage::batch
