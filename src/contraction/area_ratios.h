// SPDX-License-Identifier: MIT
#pragma once

#include <utility>
#include <vector>

#include "vantage/mesh/topology.h"
#include "vantage/mesh/tri_mesh.h"

#include "contraction/component_contraction.h"

namespace vantage {

/// Area ratios of faces, then of vertices, against the start.
class AreaRatios {
 public:
  /// \param shares must outlive this.
  AreaRatios(const TriMesh& start, const EvenShares& shares);

  /// Of the faces at the start.
  [[nodiscard]] double mean_area() const { return mean_area_; }

  /// Mean over the faces at each vertex of area now over area at the start, or with shares the ratio
  /// of the sums of those areas, which small faces cannot upset; vertices without a face that counts
  /// take the mean of the others. Returns that mean [a_t] too.
  [[nodiscard]] std::pair<std::vector<double>, double> of_vertices(const TriMesh& now) const;

 private:
  std::vector<double> start_;
  IndexLists faces_of_vertex_;
  const EvenShares& shares_;
  double smallest_ = 0.0;
  double mean_area_ = 0.0;
};

}  // namespace vantage
