// SPDX-License-Identifier: MIT
#include "orientation/candidate_model.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "vantage/core/error.h"

namespace vantage::test {
namespace {

TEST(CandidateModel, AddsUpTheLeavesThatEachCandidateComesTo) {
  const CandidateModel model(
      "# a comment\nup convention_log_odds 1.5\nup threshold 0.75\nup share 0.5\n"
      "up tree height 0.5 -1 width 2 3 4\n"
      "up tree height-opposite 0 10 20\n"
      "up tree width-mean 0 100 200\n"
      "front tree height 0 7 8\n",
      "up");
  EXPECT_EQ(model.convention_log_odds, 1.5);
  EXPECT_EQ(model.threshold, 0.75);
  EXPECT_EQ(model.share, 0.5);
  const std::vector<double> scores =
      model.scores({{{"height", 0.25}, {"width", 1.0}}, {{"height", 0.75}, {"width", 3.0}}});
  EXPECT_EQ(scores[0], -1.0 + 10.0 + 100.0);  // 0.25 is below 0.5, below 0.75, and 1 below 2
  EXPECT_EQ(scores[1], 4.0 + 20.0 + 200.0);
}

TEST(CandidateModel, RefusesLinesThatAreNoTree) {
  for (const char* const line : {"up tree height 0.5 -1", "up tree height low 1 2",
                                 "up tree height 0.5 1 2 3", "up convention_log_odds much"}) {
    try {
      const CandidateModel model(line, "up");
      ADD_FAILURE() << line;
    } catch (const InvalidInput& error) {
      EXPECT_NE(std::string(error.what()).find(line), std::string::npos);
    }
  }
}

TEST(CandidateModel, RefusesFeaturesThatAreNotMeasured) {
  const CandidateModel model("up tree depth-mean 0.5 1 2", "up");
  EXPECT_THROW((void)model.scores({{{"height", 0.25}}, {{"height", 0.75}}}), InvalidInput);
}

}  // namespace
}  // namespace vantage::test
