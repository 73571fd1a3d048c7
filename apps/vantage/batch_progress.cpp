// SPDX-License-Identifier: MIT
#include "batch_progress.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "vantage/core/error.h"

#include "terminal.h"

namespace vantage::cli {
namespace {

std::int64_t ended_of(const batch::RunnerCounts& counts) {
  return counts.done + counts.failed + counts.duplicates + counts.skipped + counts.repeated;
}

/// When the first line of a log is due. For tests only: VANTAGE_TEST_PROGRESS_S says it.
double first_due_s() {
  constexpr double kUsual = 30.0;
  const char* const wanted = std::getenv("VANTAGE_TEST_PROGRESS_S");
  return wanted == nullptr ? kUsual : std::atof(wanted);
}

}  // namespace

BatchProgress::BatchProgress(const RunContext& run, std::int64_t total)
    : run_(run), total_(total), due_s_(first_due_s()) {}

std::string duration_text(double seconds) {
  const auto whole = static_cast<std::int64_t>(std::lround(seconds));
  const auto two = [](std::int64_t large, const char* large_unit, std::int64_t small,
                      const char* small_unit) {
    return std::to_string(large) + large_unit + std::to_string(small) + small_unit;
  };
  return whole < 60      ? std::to_string(whole) + " s"
         : whole < 3600  ? two(whole / 60, " min ", whole % 60, " s")
         : whole < 86400 ? two(whole / 3600, " h ", whole % 3600 / 60, " min")
                         : two(whole / 86400, " d ", whole % 86400 / 3600, " h");
}

std::string counts_text(const batch::RunnerCounts& counts) {
  const auto count = [](std::int64_t number) { return grouped(static_cast<std::size_t>(number)); };
  std::string text = count(counts.done) + " done, " + count(counts.failed) + " failed, " +
                     count(counts.duplicates) + " with the content of another, " +
                     count(counts.skipped) + " done before";
  if (counts.skipped_failed > 0) {
    text += " (" + count(counts.skipped_failed) + " of them failed; --retry failed)";
  }
  if (counts.repeated > 0) {
    text += ", " + count(counts.repeated) + " left out with a key that came before (" +
            printable(counts.first_repeated) + ")";
  }
  if (counts.doubted > 0) {
    text += ", " + count(counts.doubted) + " not to be trusted";
  }
  return text;
}

std::string doubted_text(const batch::RunnerCounts& counts) {
  std::string text;
  for (const std::string& key : counts.first_doubted) {
    text += (text.empty() ? "not to be trusted: " : ", ") + printable(key);
  }
  const auto named = static_cast<std::int64_t>(counts.first_doubted.size());
  return text + (counts.doubted > named
                     ? " and " + grouped(static_cast<std::size_t>(counts.doubted - named)) + " more"
                     : "");
}

std::string BatchProgress::line_of(const batch::RunnerCounts& counts) const {
  const std::int64_t worked = counts.done + counts.failed + counts.duplicates;
  const std::int64_t ended = ended_of(counts);
  const double seconds = std::chrono::duration<double>(Clock::now() - start_).count();
  const double rate = seconds > 0.0 ? static_cast<double>(worked) / seconds : 0.0;
  std::string line = grouped(static_cast<std::size_t>(ended));
  if (total_ >= 0) {
    line += " of " + grouped(static_cast<std::size_t>(std::max(total_, ended)));
  }
  line += " models";
  if (worked > 0) {
    line += ", " +
            (rate >= 1.0 ? rounded(rate, 3) + " a second" : rounded(60.0 * rate, 3) + " a minute");
  }
  if (worked > 0 && total_ > ended) {
    line += ", " + duration_text(static_cast<double>(total_ - ended) / rate) + " left";
  }
  if (counts.failed > 0) {
    line += ", " + grouped(static_cast<std::size_t>(counts.failed)) + " failed";
  }
  return line;
}

void BatchProgress::show(const batch::RunnerCounts& counts) {
  if (!run_.report) {
    return;
  }
  const std::int64_t ended = ended_of(counts);
  run_.report(
      line_of(counts),
      total_ > 0 ? std::min(1.0, static_cast<double>(ended) / static_cast<double>(total_)) : -1.0);
}

std::optional<std::string> BatchProgress::due(const batch::RunnerCounts& counts) {
  const double seconds = std::chrono::duration<double>(Clock::now() - start_).count();
  if (!run_.report || seconds < due_s_) {
    return std::nullopt;
  }
  constexpr double kGrowth = 1.1;  // days of work are no thousands of lines
  due_s_ = std::max(seconds + first_due_s(), kGrowth * seconds);
  return line_of(counts);
}

}  // namespace vantage::cli
