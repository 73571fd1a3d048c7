// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "vantage/pipeline/shape_analysis.h"
#include "vantage/view/scoring.h"

#include "pipeline/coarse_copies.h"

namespace vantage {

/// Estimates of the scores of views by a map: on a coarse copy of the surface, or at some of its vertices
/// where it cannot be made coarser.
class MapEstimates {
 public:
  /// \param shape must outlive this. \param map what is summed, a value a vertex. \throw Cancelled
  MapEstimates(const ShapeAnalysis& shape, std::span<const double> map, const ViewOptions& options,
               const RunContext& run = {});
  MapEstimates(const MapEstimates&) = delete;
  MapEstimates& operator=(const MapEstimates&) = delete;

  [[nodiscard]] const CoarseCopies& copies() const { return *copies_; }

  /// Whether they are so much sooner than the scores themselves that estimates gain.
  [[nodiscard]] bool are_sooner() const {
    return copies_->is_coarse() || copies_->is_sampled() || is_by_area_;
  }

  /// By vertices. \throw Cancelled
  [[nodiscard]] std::vector<double> scores(const std::vector<Vec3>& directions) const;

  /// The same on the proxy. \pre copies().has_proxy()
  [[nodiscard]] std::vector<double> proxy_scores(const std::vector<Vec3>& directions) const;

 private:
  RunContext quiet_;
  bool is_by_area_;
  std::shared_ptr<const CoarseCopies> copies_;
  std::shared_ptr<const VertexVisibility> looked_at_;  // of the coarse copy, or of the surface
  std::vector<double> proxy_shares_{};
  std::optional<ViewScorer> proxy_scorer_{};
  std::vector<double> coarse_shares_{};
  std::optional<ViewScorer> coarse_scorer_{};
};

}  // namespace vantage
