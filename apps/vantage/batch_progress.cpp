// SPDX-License-Identifier: MIT
#include "batch_progress.h"

#include <algorithm>
#include <cmath>

#include "vantage/core/error.h"

#include "terminal.h"

namespace vantage::cli {

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

void BatchProgress::show(const batch::RunnerCounts& counts) const {
  if (!run_.report) {
    return;
  }
  const std::int64_t worked = counts.done + counts.failed + counts.duplicates;
  const std::int64_t ended = worked + counts.skipped + counts.repeated;
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
  run_.report(line, total_ > 0
                        ? std::min(1.0, static_cast<double>(ended) / static_cast<double>(total_))
                        : -1.0);
}

}  // namespace vantage::cli
