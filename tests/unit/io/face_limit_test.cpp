// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "vantage/core/error.h"
#include "vantage/io/model.h"

namespace vantage {
namespace {

using testing::HasSubstr;

TEST(FaceLimit, IsTwoDigitsAndZeros) {
  EXPECT_EQ(faces_that_fit(23'456'789'012), 46'000'000U);
  EXPECT_EQ(faces_that_fit(1'000'000'000), 2'000'000U);
  EXPECT_EQ(faces_that_fit(0), 100'000U);
  EXPECT_GE(faces_that_fit(~std::uint64_t{0}), 36'000'000'000'000'000U);
}

TEST(FaceLimit, FollowsTheMemoryThatThereIs) {
  EXPECT_GT(usable_memory_bytes(), 100'000'000U);
  EXPECT_LT(usable_memory_bytes(), std::uint64_t{1} << 60U);
}

TEST(FaceLimit, HoldsForEveryFormatAndForPoints) {
  const char* const square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
  EXPECT_EQ(parse_model(square, "square.obj", {}, {.max_faces = 2}).mesh.triangles.size(), 2U);
  const auto refusal = [](const char* bytes, const char* name) -> std::string {
    try {
      parse_model(bytes, name, {}, {.max_faces = 1});
    } catch (const FormatError& error) {
      return error.what();
    }
    return "read";
  };
  EXPECT_THAT(refusal(square, "square.obj"), HasSubstr("has more than 1 faces, the most that"));
  EXPECT_THAT(refusal("0 0 0\n1 0 0\n", "two.xyz"), HasSubstr("has more than 1 points"));
  EXPECT_THAT(
      refusal("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 1 1 1\nv 2 1 1\nf 1 2 3\n", "loose.obj"),
      HasSubstr("has more than 1 points"));  // no face has half of them
}

}  // namespace
}  // namespace vantage
