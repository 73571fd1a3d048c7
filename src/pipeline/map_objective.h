// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "vantage/pipeline/find_views.h"
#include "vantage/pipeline/shape_analysis.h"
#include "vantage/view/search.h"

#include "pipeline/preference.h"
#include "pipeline/view_preparation.h"

namespace vantage {

/// The score of a view by the shape's map, KSSM or saliency, as a search takes it: exact on the
/// surface, estimated on its coarse copy, or at some vertices where it cannot be made coarser.
class MapObjective {
 public:
  /// \param shape must outlive this. \pre its map is there.
  MapObjective(const ShapeAnalysis& shape, const ViewOptions& options, const RunContext& run = {});
  MapObjective(const MapObjective&) = delete;
  MapObjective& operator=(const MapObjective&) = delete;

  [[nodiscard]] const ViewScorer& scorer() const { return by_map_.scorer(); }

  [[nodiscard]] const VertexVisibility& visibility() const { return prepared_->visibility; }

  /// Estimates of the scores, by vertices. \throw Cancelled
  [[nodiscard]] std::vector<double> estimates(const std::vector<Vec3>& directions) const;

  /// Refers to this and to `preference`.
  [[nodiscard]] ViewObjective objective(const Preference& preference) const;

 private:
  std::shared_ptr<const ViewPreparation> prepared_;
  RunContext quiet_;
  MapScorer by_map_;
  std::vector<double> shares_;  // of the total, by vertex
  std::vector<double> proxy_shares_;
  ViewScorer proxy_scorer_;
  std::vector<double> coarse_shares_;
  ViewScorer coarse_scorer_;
};

}  // namespace vantage
