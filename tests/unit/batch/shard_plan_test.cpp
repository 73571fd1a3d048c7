// SPDX-License-Identifier: MIT
#include "batch/shard_plan.h"

#include <filesystem>
#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "support/temporary_folder.h"

namespace vantage::batch {
namespace {

// A line that names no path once ended the whole run, as "" has no absolute path.
TEST(WritePlan, AnEntryWithoutAPathStaysOneWithItsProblem) {
  const test::TemporaryFolder scratch;
  const std::string list = scratch.write("list", "path,key,name\na.off,a,\n,,nothing\n,k,\n");
  const ConfinedFolder folder(scratch.file());
  EXPECT_EQ(write_plan(*entries_of_manifest(list), folder, "plan.jsonl"), 3);
  balance_plan(folder, "plan.jsonl", 2);
  const std::unique_ptr<EntrySource> planned = entries_of_manifest(scratch.file("plan.jsonl"));
  EXPECT_EQ(planned->next()->path, std::filesystem::absolute(scratch.file("a.off")));
  const std::optional<Entry> second = planned->next();
  EXPECT_EQ(second->key, "line 3 of the manifest");
  EXPECT_EQ(second->problem, "line 3 of the manifest names no path");
  EXPECT_EQ(second->path, "");
  EXPECT_EQ(planned->next()->key, "k");
  EXPECT_FALSE(planned->next());
}

}  // namespace
}  // namespace vantage::batch
