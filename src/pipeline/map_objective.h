// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <span>

#include "vantage/pipeline/find_views.h"
#include "vantage/pipeline/shape_analysis.h"
#include "vantage/view/search.h"

#include "pipeline/map_estimates.h"
#include "pipeline/preference.h"

namespace vantage {

/// The score of a view by a map, KSSM or saliency, as a search takes it: exact on the
/// surface, and estimated for the global search.
class MapObjective {
 public:
  /// \param shape must outlive this. \param map of its surface, a value a vertex; likewise.
  MapObjective(const ShapeAnalysis& shape, std::span<const double> map, const ViewOptions& options,
               const RunContext& run = {});
  MapObjective(const MapObjective&) = delete;
  MapObjective& operator=(const MapObjective&) = delete;

  [[nodiscard]] const ViewScorer& scorer() const { return by_map_.scorer(); }

  [[nodiscard]] const VertexVisibility& visibility() const { return *visibility_; }

  /// Refers to this and to `preference`.
  [[nodiscard]] ViewObjective objective(const Preference& preference) const;

 private:
  void add_estimates(ViewObjective& objective) const;

  std::shared_ptr<const VertexVisibility> visibility_;
  RunContext quiet_;
  MapScorer by_map_;
  bool is_small_;
  std::optional<MapEstimates> estimates_{};
};

}  // namespace vantage
