// SPDX-License-Identifier: MIT
#include "orientation/candidate_model.h"

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "vantage/core/error.h"

namespace vantage::test {
namespace {

constexpr std::array<std::string_view, 2> kNames{"height", "width"};

TEST(CandidateModel, AddsUpTheLeavesThatEachCandidateComesTo) {
  const CandidateModel model(
      "# a comment\nup witness 1.5\nup threshold 0.75\nup share 0.5\n"
      "up tree height 0.5 -1 width 2 3 4\n"
      "up tree height-opposite 0 10 20\n"
      "up tree width-mean 0 100 200\n"
      "front tree height 0 7 8\n",
      "up", kNames);
  EXPECT_EQ(model.witness, 1.5);
  EXPECT_EQ(model.threshold, 0.75);
  EXPECT_EQ(model.share, 0.5);
  const std::vector<double> scores = model.scores({{0.25, 1.0}, {0.75, 3.0}});
  EXPECT_EQ(scores[0], -1.0 + 10.0 + 100.0);  // 0.25 is below 0.5, below 0.75, and 1 below 2
  EXPECT_EQ(scores[1], 4.0 + 20.0 + 200.0);
}

TEST(CandidateModel, RefusesLinesThatAreNoTree) {
  for (const char* const line :
       {"up tree height 0.5 -1", "up tree depth 0.5 1 2", "up tree height low 1 2",
        "up tree height 0.5 1 2 3", "up witness much"}) {
    try {
      const CandidateModel model(line, "up", kNames);
      ADD_FAILURE() << line;
    } catch (const InvalidInput& error) {
      EXPECT_NE(std::string(error.what()).find(line), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace vantage::test
