// SPDX-License-Identifier: MIT
#include "vantage/core/run_context.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "vantage/core/error.h"

namespace vantage {
namespace {

TEST(RunContextAdvance, ReportsNothingWithoutAListener) {
  EXPECT_NO_THROW(RunContext{}.advance("stage", 0.5));
}

TEST(RunContextAdvance, ThrowsOnceAStopIsRequested) {
  std::stop_source source;
  const RunContext run{.stop = source.get_token()};
  run.advance("stage", 0.1);
  source.request_stop();
  EXPECT_THROW(run.advance("stage", 0.2), Cancelled);
}

TEST(RunContextAdvance, DoesNotReportAfterAStop) {
  std::stop_source source;
  bool reported = false;
  const auto note = [&](std::string_view, double) { reported = true; };
  source.request_stop();
  try {
    RunContext{.report = note, .stop = source.get_token()}.advance("stage", 0.2);
  } catch (const Cancelled&) {
    EXPECT_FALSE(reported);
    return;
  }
  ADD_FAILURE() << "was not cancelled";
}

TEST(RunContextAdvance, ClampsToThePart) {
  std::vector<double> seen;
  const RunContext run{.report = [&](std::string_view, double f) { seen.push_back(f); }};
  const RunContext half = run.part(0.0, 0.5);
  half.advance("stage", -1.0);
  half.advance("stage", 2.0);
  EXPECT_EQ(seen, (std::vector<double>{0.0, 0.5}));
}

TEST(RunContextPart, NestsAsARangeWithinARange) {
  double seen = -1.0;
  const RunContext run{.report = [&](std::string_view, double f) { seen = f; }};
  run.part(0.5, 1.0).part(0.5, 1.0).advance("stage", 0.5);
  // Half of [3/4, 1].
  EXPECT_DOUBLE_EQ(seen, 0.75 + 0.5 * 0.25);
}

TEST(RunContextPart, KeepsThreadsAndStop) {
  std::stop_source source;
  const RunContext part = RunContext{.stop = source.get_token(), .max_threads = 3}.part(0.2, 0.4);
  EXPECT_EQ(part.max_threads, 3);
  source.request_stop();
  EXPECT_THROW(part.check(), Cancelled);
}

}  // namespace
}  // namespace vantage
