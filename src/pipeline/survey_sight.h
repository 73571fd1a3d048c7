// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "vantage/core/run_context.h"
#include "vantage/view/scoring.h"

namespace vantage {

/// Whether two cameras see the same from every direction.
bool is_same(const ScoringCamera& a, const ScoringCamera& b);

/// Which vertices are seen from the directions that a search surveys. They do not depend on the map, so
/// that they are found beside the contraction.
class SurveySight {
 public:
  /// \param level of the icosahedron, as ViewObjective::survey_level. \throw Cancelled
  SurveySight(const VertexVisibility& visibility, const ScoringCamera& camera, int level,
              const RunContext& run);

  /// What it is seen through.
  [[nodiscard]] const ScoringCamera& camera() const { return camera_; }

  /// What ViewScorer::score() gives for `shares`, one a vertex; nothing for other directions.
  [[nodiscard]] std::optional<double> score(const Vec3& direction,
                                            std::span<const double> shares) const;

 private:
  ScoringCamera camera_;
  std::vector<std::vector<std::uint8_t>> visible_;  // of each direction, 1 where a vertex is seen
  std::map<std::array<double, 3>, std::size_t> index_{};
};

}  // namespace vantage
