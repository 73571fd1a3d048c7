// SPDX-License-Identifier: MIT
#include "mesh/extent.h"

#include <cmath>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vantage {
namespace {

using testing::HasSubstr;

TEST(StepsAcross, CountsTheDoublesBetweenTheEndsWhereTheyAreFarthestApart) {
  EXPECT_EQ(steps_across(std::vector<Vec3>{{1.0, 0.0, 0.0}, {1.0 + 5.0 * 0x1p-52, 0.0, 0.0}}), 5.0);
  // Along another axis the steps are finer, but turned the model has no more of them.
  EXPECT_EQ(steps_across(std::vector<Vec3>{{0x1p50, 0.0, 0.0}, {0x1p50, 0.0, 1.0}}), 4.0);
}

TEST(ExtentProblem, IsNoneOfModelsWithinTheLimitsAndOfASinglePlace) {
  for (const double size : {1e-59, 1e-9, 1.0, 1e9, 9e59}) {
    const std::vector<Vec3> points{Vec3::Zero(), size * Vec3::Ones()};
    EXPECT_EQ(extent_problem(points), "") << size;
  }
  EXPECT_EQ(extent_problem(std::vector<Vec3>{{1e15, 1.0, 0.0}, {1e15, 1.0, 0.0}}), "");
  EXPECT_EQ(extent_problem({}), "");
}

TEST(ExtentProblem, NamesTheLimitThatIsNotKept) {
  const std::vector<Vec3> huge{Vec3::Zero(), 2e60 * Vec3::Ones()};
  const std::vector<Vec3> tiny{Vec3::Zero(), 1e-61 * Vec3::Ones()};
  const std::vector<Vec3> far{{1e15, 0.0, 0.0}, {1e15 + 100.0, 0.0, 0.0}};
  EXPECT_THAT(extent_problem(huge), HasSubstr("beyond 1e60"));
  EXPECT_THAT(extent_problem(tiny), HasSubstr("less than 1e-60 across"));
  EXPECT_THAT(extent_problem(far), HasSubstr("only 800 places apart"));
}

}  // namespace
}  // namespace vantage
