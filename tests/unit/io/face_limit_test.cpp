// SPDX-License-Identifier: MIT
#include <string>

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

TEST(FaceLimit, EndsTheReadingBeforeWhatIsWrongFurtherOn) {
  const auto refusal = [](const std::string& bytes, const char* name) -> std::string {
    try {
      parse_model(bytes, name, {}, {.max_faces = 1});
    } catch (const FormatError& error) {
      return error.what();
    }
    return "read";
  };
  const auto too_many = HasSubstr("has more than 1 faces, the most that");
  std::string stl(80, '\0');
  stl += std::string("\2\0\0\0", 4) + std::string(100, '\xFF');  // nothing but NaN
  EXPECT_THAT(refusal(stl, "a.stl"), too_many);
  const std::string facet =
      "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
      "0\nendloop\nendfacet\n";
  EXPECT_THAT(refusal("solid\n" + facet + facet + "wrong\n", "a.stl"), too_many);
  EXPECT_THAT(refusal("OFF\n3 2 0\nx 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 1 2\n", "a.off"), too_many);
  EXPECT_THAT(refusal("OFF BINARY\n" + std::string("\0\0\0\1\0\0\0\2\0\0\0\0", 12) +
                          std::string(40, '\xFF'),
                      "a.off"),
              too_many);
  EXPECT_THAT(
      refusal("ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
              "property float z\nelement face 2\nproperty list uchar int vertex_indices\n"
              "end_header\nx 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 1 2\n",
              "a.ply"),
      too_many);
  EXPECT_THAT(refusal("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 3\nv x\n", "a.obj"), too_many);
}

TEST(FaceLimit, LeavesCountsThatTheFileCannotHoldToTheReader) {
  EXPECT_THAT(
      [] {
        try {
          parse_model("OFF\n3 2000000 0\n0 0 0\n", "a.off", {}, {.max_faces = 1});
        } catch (const FormatError& error) {
          return std::string(error.what());
        }
        return std::string("read");
      }(),
      HasSubstr("more than its size can hold"));
}

}  // namespace
}  // namespace vantage
