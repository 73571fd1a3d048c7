// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "vantage/mesh/topology.h"
#include "vantage/mesh/tri_mesh.h"

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

  /// Finds the middle between a vertex and the wall across from it, along the normal.
  /// \return false, and `middle` as it was, if neither way leads through the inside.
  [[nodiscard]] bool middle_at(std::uint32_t vertex, Vec3& middle) const;

  /// The vertices that share an edge with each vertex.
  [[nodiscard]] const IndexLists& neighbours() const { return neighbours_; }

  /// Faces in cells of the grid, each counted in every cell that it touches.
  [[nodiscard]] std::size_t grid_entries() const { return faces_.size(); }

  /// Whether the component has an edge with an odd number of faces, or many more
  /// faces than a closed surface of its vertices: nothing is inside or outside.
  [[nodiscard]] bool is_open(std::uint32_t component) const {
    return component >= is_open_.size() || is_open_[component] != 0;
  }

 private:
  /// Part of a segment, up to a share of its way, and its box.
  struct Stretch {
    double leave = 1.0;
    Vec3 low = Vec3::Zero();
    Vec3 high = Vec3::Zero();
  };

  void look_at_edges();
  void sort_into_cells();
  [[nodiscard]] double faces_met() const;
  bool fill_cells(double width, double height, double cell_size);
  [[nodiscard]] std::array<int, 2> cell_of(const Vec3& p) const;
  [[nodiscard]] std::array<int, 2> cells_in_row(const Triangle& t, int row) const;
  [[nodiscard]] int crossing(std::uint32_t from, std::uint32_t to, const Vec3& p) const;
  [[nodiscard]] int winding_of_face(const Triangle& t, const Vec3& p) const;
  [[nodiscard]] bool is_near(const Triangle& t, const Vec3& normal, const Vec3& p) const;
  [[nodiscard]] Stretch stretch_in(int slab, std::size_t axis, const Vec3& a, const Vec3& b) const;
  template <class Visit>
  void visit_cell(int x, int y, const Stretch& stretch, const Visit& visit) const;
  template <class Visit, class Done>
  void walk(const Vec3& a, const Vec3& b, const Visit& visit, const Done& done) const;
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
  // Faces by the cell of a plane grid that their projection along `up_` touches.
  int up_ = 2;
  Vec3 low_ = Vec3::Zero();
  double size_ = 0.0;  ///< Longest side of the box.
  std::array<int, 2> cells_{1, 1};
  double cell_size_ = 1.0;
  std::vector<std::uint32_t> offsets_{};
  std::vector<std::uint32_t> faces_{};
  // For walls.
  UnitFrame frame_{};               ///< Of the rays.
  std::optional<RayScene> rays_{};  ///< If there are many faces.
  std::vector<Vec3> normal_{};      ///< |V| unit normals; zero where undefined.
};

}  // namespace vantage
