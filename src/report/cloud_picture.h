// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "vantage/core/image.h"
#include "vantage/mesh/tri_mesh.h"
#include "vantage/pipeline/shape_analysis.h"

namespace vantage {

/// What pictures of a cloud show: its surface, and a small solid at each point that no triangle, or none
/// but slivers, join to others, as on curves.
struct CloudPicture {
  TriMesh mesh{};                          ///< The surface's vertices come first.
  std::vector<std::uint32_t> vertex_of{};  ///< Of the surface, for each vertex of the mesh.

  /// Values of the surface's vertices on those of the mesh; none of none.
  template <class Value>
  [[nodiscard]] std::vector<Value> spread(std::span<const Value> of_vertex) const {
    std::vector<Value> values;
    values.reserve(of_vertex.empty() ? 0 : vertex_of.size());
    for (std::size_t v = 0; !of_vertex.empty() && v < vertex_of.size(); ++v) {
      values.push_back(of_vertex[vertex_of[v]]);
    }
    return values;
  }
};

/// Null if the surface shows everything. Outliers are not shown.
std::shared_ptr<const CloudPicture> cloud_picture(const ShapeAnalysis& shape);

/// The colours of the input's vertices on what a picture shows; none of none. Of points at one place the
/// first counts. \param picture null: on the surface.
std::vector<Rgb8> colours_shown(const ShapeAnalysis& shape, const CloudPicture* picture,
                                const std::vector<Rgb8>& of_input);

}  // namespace vantage
