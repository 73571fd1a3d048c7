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

}  // namespace vantage::test
