// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

#include <gtest/gtest.h>

#include "batch/model_record.h"
#include "batch/result_book.h"

namespace vantage::test {

/// Expects of an empty book that it finds the first of the models that have the results of another.
inline void expect_finds_first_duplicate(batch::ResultBook& book) {
  const auto record = [](const std::string& key, std::int64_t position) {
    batch::ModelRecord made;
    made.key = key;
    made.position = position;
    made.content = "same";
    made.status = "done";
    return made;
  };
  batch::ModelRecord first = record("first", 1);
  first.folder = "its";
  batch::ModelRecord twin = record("twin", 4);
  batch::ModelRecord earlier = record("earlier", 3);
  twin.duplicate_of = earlier.duplicate_of = "first";
  for (const batch::ModelRecord& each : {first, twin, earlier}) {
    book.put(each);
  }
  batch::ModelRecord like = record("new", 9);
  EXPECT_EQ(book.find_duplicate(like)->key, "earlier");
  earlier.duplicate_of.clear();
  book.put(earlier);
  EXPECT_EQ(book.find_duplicate(like)->key, "twin");
  like.content = "other";
  EXPECT_FALSE(book.find_duplicate(like));
}

/// Expects of an empty book that of equal models it finds the first that is done, or the first that failed by their
/// content.
inline void expect_finds_what_stands_for_a_content(batch::ResultBook& book) {
  const auto put = [&](const std::string& key, std::int64_t position, const std::string& reason) {
    batch::ModelRecord made;
    made.key = key;
    made.position = position;
    made.content = "same";
    made.status = reason.empty() ? "done" : "failed";
    made.reason = reason;
    book.put(made);
  };
  batch::ModelRecord like;
  like.content = "same";
  put("touched", 0, "changed");
  put("unnamed", 1, "name");
  EXPECT_FALSE(book.find_content(like));
  put("crashed", 2, "crash");
  EXPECT_EQ(book.find_content(like)->key, "crashed");
  put("late", 5, "");
  put("done", 4, "");
  EXPECT_EQ(book.find_content(like)->key, "done");
  put("crashed", 2, "");
  EXPECT_EQ(book.find_content(like)->key, "crashed");
}

}  // namespace vantage::test
