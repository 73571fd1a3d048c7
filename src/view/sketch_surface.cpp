// SPDX-License-Identifier: MIT
#include "view/sketch_surface.h"

#include <limits>

#include <Eigen/Geometry>
#include <meshoptimizer.h>

#include "vantage/mesh/topology.h"

#include "visibility/surface.h"

namespace vantage {
namespace {

// Collapsing edges keeps the shape best, but takes long from many faces: first, vertices are merged in
// the cells of a grid, until there are so many times the faces asked for. [ours, docs/search.md]
constexpr std::size_t kBeforeCollapse = 10;
// It deletes small components until few enough faces are left, and with them what they hide: where a
// component has fewer than so many of the faces asked for, all is merged in the grid and no more, to as
// many as before a collapse. [ours]
constexpr std::size_t kFacesOfComponent = 16;
// In a lattice of like parts all may vanish in cells of one size: if not one in so many of the faces
// asked for is left, smaller cells are tried. [ours]
constexpr std::size_t kVanished = 4;

/// Positions of the corners in single precision, three numbers for each vertex. Those of no face lie
/// where a corner does: far from all faces, they would widen the grid's cells.
std::vector<float> packed(const std::vector<Vec3>& positions,
                          const std::vector<std::uint32_t>& corners) {
  const Vec3& somewhere = positions[corners.front()];
  std::vector<float> numbers(3 * positions.size());
  const auto put = [&](std::size_t v, const Vec3& p) {
    for (std::size_t k = 0; k < 3; ++k) {
      numbers[3 * v + k] = static_cast<float>(p[static_cast<Eigen::Index>(k)]);
    }
  };
  for (std::size_t v = 0; v < positions.size(); ++v) {
    put(v, somewhere);
  }
  for (const std::uint32_t v : corners) {
    put(v, positions[v]);
  }
  return numbers;
}

/// The corners of faces as they become coarser; vertices stay where they are.
class Coarsening {
 public:
  /// \param triangles one at least.
  Coarsening(const std::vector<Triangle>& triangles, const std::vector<Vec3>& positions) {
    corners_.reserve(3 * triangles.size());
    for (const Triangle& t : triangles) {
      corners_.insert(corners_.end(), t.begin(), t.end());
    }
    positions_ = packed(positions, corners_);
  }

  /// Merges vertices in the cells of a grid: thin walls may close up, which a sketch can bear.
  void merge_in_grid(std::size_t faces) {
    for (std::size_t asked = faces; corners_.size() > 3 * asked; asked *= 2) {
      std::vector<std::uint32_t> coarse(corners_.size());
      coarse.resize(meshopt_simplifySloppy(
          coarse.data(), corners_.data(), corners_.size(), positions_.data(), positions_.size() / 3,
          3 * sizeof(float), 3 * asked, std::numeric_limits<float>::max(), nullptr));
      if (coarse.size() > 3 * faces / kVanished) {
        corners_ = std::move(coarse);
        return;
      }
    }
  }

  void collapse_edges(std::size_t faces) {
    constexpr float kAnyError = 1.0F;
    if (corners_.size() > 3 * faces) {
      std::vector<std::uint32_t> coarse(corners_.size());
      coarse.resize(meshopt_simplify(coarse.data(), corners_.data(), corners_.size(),
                                     positions_.data(), positions_.size() / 3, 3 * sizeof(float),
                                     3 * faces, kAnyError, 0, nullptr));
      corners_ = std::move(coarse);
    }
  }

  [[nodiscard]] const std::vector<std::uint32_t>& corners() const { return corners_; }

 private:
  std::vector<std::uint32_t> corners_{};
  std::vector<float> positions_{};
};

/// The corners of the surface's faces, or of about so many that look like them.
std::vector<Triangle> coarse_faces(const TriMesh& surface, const std::vector<Vec3>& positions,
                                   std::size_t components, std::size_t count) {
  if (surface.triangles.size() <= count) {
    return surface.triangles;
  }
  Coarsening coarsening(surface.triangles, positions);
  coarsening.merge_in_grid(kBeforeCollapse * count);
  if (kFacesOfComponent * components <= count) {
    coarsening.collapse_edges(count);
  }
  std::vector<Triangle> faces;
  const std::vector<std::uint32_t>& corners = coarsening.corners();
  for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
    faces.push_back({corners[i], corners[i + 1], corners[i + 2]});
  }
  return faces;
}

}  // namespace

std::vector<FaceSides> sides_of_vertices(const TriMesh& surface,
                                         const std::vector<FaceSides>& sides) {
  if (sides.size() == 1) {
    return std::vector<FaceSides>(surface.positions.size(), sides.front());
  }
  const Components components = connected_components(surface);
  std::vector<FaceSides> of_vertex;
  of_vertex.reserve(surface.positions.size());
  for (const std::uint32_t component : components.of_vertex) {
    of_vertex.push_back(sides[component]);
  }
  return of_vertex;
}

SketchSurface sketch_surface(const TriMesh& surface, const std::vector<FaceSides>& sides,
                             const Sphere& sphere, std::size_t count) {
  SketchSurface sketch;
  sketch.order = morton_order(surface.positions);
  std::vector<Vec3> positions;
  positions.reserve(surface.positions.size());
  for (const Vec3& p : surface.positions) {
    positions.push_back(in_frame(sphere, p));
  }
  const std::vector<Triangle> faces = coarse_faces(surface, positions, sides.size(), count);
  std::vector<Vec3> normals;
  normals.reserve(faces.size());
  for (const auto& [a, b, c] : faces) {
    // Zero for a face without area, which is not drawn.
    normals.push_back(
        (positions[b] - positions[a]).cross(positions[c] - positions[a]).stableNormalized());
  }
  const std::vector<FaceSides> side_of = sides_of_vertices(surface, sides);
  for (const std::uint32_t f : morton_order(normals)) {
    const bool is_two_sided = side_of[faces[f][0]] == FaceSides::Both;
    sketch.two_sided.push_back(is_two_sided ? -1 : 0);
    if (is_two_sided) {
      sketch.planes.append(Vec3::Zero(), SketchPlanes::kAlways);
    } else {
      const double height = normals[f].dot(positions[faces[f][0]]);
      sketch.planes.append(normals[f], static_cast<float>(height));
    }
    for (std::size_t k = 0; k < 3; ++k) {
      sketch.corners[k].append(positions[faces[f][k]]);
    }
  }
  sketch.face_count = faces.size();
  sketch.planes.pad();
  sketch.two_sided.resize(whole_registers(faces.size()), 0);
  for (SketchCoordinates& corner : sketch.corners) {
    corner.pad();
  }
  return sketch;
}

}  // namespace vantage
