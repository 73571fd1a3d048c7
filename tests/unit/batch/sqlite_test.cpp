// SPDX-License-Identifier: MIT
#include "batch/sqlite.h"

#include <cerrno>
#include <string>

#include <gtest/gtest.h>

#include "vantage/core/error.h"

#include "batch/no_room.h"
#include "support/temporary_folder.h"

namespace vantage::batch {
namespace {

TEST(Database, OneThatCanHoldNoMoreSaysWhatHelps) {
  const test::TemporaryFolder scratch;
  Database database(scratch.file() + "/d.sqlite", Database::Mode::Create);
  database.run("CREATE TABLE texts(text TEXT); PRAGMA max_page_count = 4");
  Statement put(database, "INSERT INTO texts VALUES(?1)");
  try {
    put.bind(1, std::string(100'000, 'x')).run();
    FAIL() << "100 kB went into 4 pages";
  } catch (const IoError& error) {
    EXPECT_EQ(error.error_number(), ENOSPC);
    EXPECT_NE(std::string(error.what()).find(kNoRoom), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace vantage::batch
