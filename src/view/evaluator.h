// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "vantage/core/run_context.h"
#include "vantage/view/search.h"

/// \file
/// Scores directions once each and keeps the record of it.

namespace vantage {

/// Remembers every score, so that searches that meet the same direction again pay nothing.
class Evaluator {
 public:
  explicit Evaluator(const ScoreBatch& score) : score_(&score) {}

  /// Scores of the directions; new ones are scored in one batch and recorded at `level`.
  std::vector<double> scores(const std::vector<Vec3>& directions, int level);

  /// The same in batches of a size that lets a user stop the search, with progress reported as
  /// fractions of [0, 1] of `run`.
  std::vector<double> scores(const std::vector<Vec3>& directions, int level, const RunContext& run);

  /// The score of a direction, if it was asked for.
  [[nodiscard]] std::optional<double> known(const Vec3& direction) const;

  /// Each direction scored so far, in order.
  [[nodiscard]] const std::vector<SearchStep>& trace() const { return trace_; }

 private:
  using Key = std::array<std::uint64_t, 3>;  // the bits of a direction

  static Key key_of(const Vec3& direction);

  const ScoreBatch* score_;
  std::map<Key, double> known_{};
  std::vector<SearchStep> trace_{};
};

/// The directions that were estimated and then scored, in order, but for those of a list.
std::vector<KnownScore> known_scores(const Evaluator& estimates, const Evaluator& exact,
                                     std::span<const Vec3> but_for);

}  // namespace vantage
