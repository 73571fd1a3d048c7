// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "vantage/core/run_context.h"
#include "vantage/view/search.h"

namespace vantage {

/// Scores directions once each and keeps the record of it.
class ScoreMemo {
 public:
  explicit ScoreMemo(const ScoreBatch& score) : score_(&score) {}

  /// Scores of the directions; new ones are scored in one batch and recorded at `level`.
  std::vector<double> scores(const std::vector<Vec3>& directions, int level);

  /// The same in batches of a size that lets a user stop the search, with progress reported as
  /// fractions of [0, 1] of `run`.
  std::vector<double> scores(const std::vector<Vec3>& directions, int level, const RunContext& run);

  /// Each direction scored so far, in order.
  [[nodiscard]] const std::vector<SearchStep>& trace() const { return trace_; }

 private:
  using Key = std::array<std::uint64_t, 3>;  // the bits of a direction

  static Key key_of(const Vec3& direction);

  const ScoreBatch* score_;
  std::map<Key, double> score_of_{};
  std::vector<SearchStep> trace_{};
};

}  // namespace vantage
