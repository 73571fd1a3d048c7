// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "vantage/mesh/topology.h"
#include "vantage/mesh/tri_mesh.h"

#include "spatial/face_grid.h"
#include "spatial/ray_scene.h"

namespace vantage {

/// What is inside a surface, component by component. Open components have no inside: every point
/// counts as inside of them.
class Shell {
 public:
  /// \param component_of_vertex |V| labels; a face belongs to the component of its first vertex.
  /// Both must outlive the shell.
  /// \param most_walked faces up to which walls are looked for in the grid: ways through it grow
  ///        longer with their number, and more walls are asked for, so that rays then pay.
  Shell(const TriMesh& mesh, std::span<const std::uint32_t> component_of_vertex,
        std::size_t most_walked = 1'000'000);

  /// Whether the surface of the component winds around the point, or is open.
  [[nodiscard]] bool inside(std::uint32_t component, const Vec3& point) const;

  /// Whether the point is inside and not on the surface, where rounding would decide.
  [[nodiscard]] bool well_inside(std::uint32_t component, const Vec3& point) const;

  /// Whether all of the segment is inside, but for a rounding error at its ends.
  [[nodiscard]] bool inside(std::uint32_t component, const Vec3& a, const Vec3& b) const;

  /// Length of what of the segment is outside, exact up to rounding: the segment is cut where it
  /// passes through a face's plane near that face, and the middle of each piece looked at.
  [[nodiscard]] double outside_length(std::uint32_t component, const Vec3& a, const Vec3& b) const;

  /// From a vertex along its normal, through the inside, to the wall across from it; nothing if
  /// neither way leads through the inside.
  [[nodiscard]] std::optional<Vec3> wall_at(std::uint32_t vertex) const;

  /// The middle between a vertex and the wall across from it; nothing where wall_at() is.
  [[nodiscard]] std::optional<Vec3> middle_at(std::uint32_t vertex) const;

  /// The vertices that share an edge with each vertex.
  [[nodiscard]] const IndexLists& neighbours() const { return neighbours_; }

  /// Faces in cells of the grid, each counted in every cell that it touches.
  [[nodiscard]] std::size_t grid_entries() const { return whole_.entries(); }

  /// How many faces a look at what is inside a component meets, in the mean over its faces.
  [[nodiscard]] double faces_met(std::uint32_t component) const {
    return grid_of(component).faces_met();
  }

  /// Whether the component has an edge with an odd number of faces, or many more
  /// faces than a closed surface of its vertices: nothing is inside or outside.
  [[nodiscard]] bool is_open(std::uint32_t component) const {
    return component >= is_open_.size() || is_open_[component] != 0;
  }

 private:
  void look_at_edges();
  void sort_faces();

  [[nodiscard]] const FaceGrid& grid_of(std::uint32_t component) const {
    return grids_.empty() ? whole_ : grids_[component];
  }

  [[nodiscard]] int crossing(std::uint32_t from, std::uint32_t to, const Vec3& p) const;
  [[nodiscard]] int winding_of_face(const Triangle& t, const Vec3& p) const;
  [[nodiscard]] bool is_near(const Triangle& t, const Vec3& normal, const Vec3& p) const;
  [[nodiscard]] double way_to_wall(std::uint32_t vertex, const Vec3& direction) const;
  struct Passage;
  [[nodiscard]] std::optional<Passage> passage(const Triangle& t, const Vec3& a,
                                               const Vec3& b) const;
  [[nodiscard]] double first_hit(const Vec3& a, const Vec3& b, double nearest) const;
  [[nodiscard]] std::vector<double> cuts(std::uint32_t component, const Vec3& a,
                                         const Vec3& b) const;

  const TriMesh& mesh_;
  std::span<const std::uint32_t> component_of_vertex_;
  std::vector<std::uint8_t> is_open_{};  ///< Of each component.
  IndexLists neighbours_{};
  int up_ = 2;         ///< The axis along which faces are projected.
  double size_ = 0.0;  ///< Longest side of the box.
  FaceGrid whole_{};
  std::vector<FaceGrid> grids_{};  ///< Of each component, empty of open ones; none of a single one.
  // For walls.
  UnitFrame frame_{};               ///< Of the rays.
  std::optional<RayScene> rays_{};  ///< If there are many faces.
  std::vector<Vec3> normal_{};      ///< |V| unit normals; zero where undefined.
};

}  // namespace vantage
