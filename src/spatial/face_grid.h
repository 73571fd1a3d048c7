// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "vantage/core/vec3.h"
#include "vantage/mesh/measures.h"
#include "vantage/mesh/tri_mesh.h"

namespace vantage {

/// Faces by the cell of a plane grid that their projection along one axis touches.
class FaceGrid {
 public:
  FaceGrid() = default;

  /// \param mesh must outlive the grid. \param faces those to sort in. \param box around them.
  /// \param up the axis along which they are projected.
  FaceGrid(const TriMesh& mesh, std::span<const std::uint32_t> faces, const Box& box, int up);

  /// Faces in cells, each counted in every cell that it touches.
  [[nodiscard]] std::size_t entries() const { return entries_.size(); }

  /// How many faces lie in the cell of one, in the mean over all faces and their cells.
  [[nodiscard]] double faces_met() const;

  /// Visits faces in the cell of a point: all that lie above it, and some others.
  template <class Visit>
  void visit_at(const Vec3& point, const Visit& visit) const {
    const auto [x, y] = cell_of(point);
    const std::uint16_t bottom = level_of(point);
    for (const Entry& entry : entries_in(x, y)) {
      if (entry.high >= bottom) {
        visit(mesh_->triangles[entry.face]);
      }
    }
  }

  /// Visits the faces in the cells along a segment, slab by slab of cells across its longer way, until
  /// `done(share)` says after a slab that it is enough: all faces that may be met up to that share of
  /// the way were visited, some more than once.
  template <class Visit, class Done>
  void walk(const Vec3& a, const Vec3& b, const Visit& visit, const Done& done) const {
    const Vec3 way = (b - a).cwiseAbs();
    const std::size_t major = way[(up_ + 1) % 3] > way[(up_ + 2) % 3] ? 0 : 1;
    const int last = cell_of(b).at(major);
    const int step = cell_of(a).at(major) <= last ? 1 : -1;
    for (int slab = cell_of(a).at(major); slab != last + step; slab += step) {
      const Stretch stretch = stretch_in(slab, major, a, b);
      auto low = cell_of(stretch.low);
      auto high = cell_of(stretch.high);
      low.at(major) = slab;
      high.at(major) = slab;
      for (int y = low[1]; y <= high[1]; ++y) {
        for (int x = low[0]; x <= high[0]; ++x) {
          visit_cell(x, y, stretch, visit);
        }
      }
      if (done(stretch.leave)) {
        return;
      }
    }
  }

 private:
  /// Part of a segment, up to a share of its way, and its box.
  struct Stretch {
    double leave = 1.0;
    Vec3 low = Vec3::Zero();
    Vec3 high = Vec3::Zero();
  };

  /// A face in a cell, and between which levels along the axis it lies: most of those in a cell are told
  /// apart by them, without a look at their corners.
  struct Entry {
    std::uint32_t face = 0;
    std::uint16_t low = 0;
    std::uint16_t high = 0;
  };

  bool fill_cells(std::span<const std::uint32_t> faces, double width, double height,
                  double cell_size);
  template <class Visit>
  void for_each_cell(const Triangle& t, const Visit& visit) const;
  [[nodiscard]] std::array<int, 2> cells_in_row(const Triangle& t, int row) const;
  [[nodiscard]] std::array<int, 2> cell_of(const Vec3& p) const;
  [[nodiscard]] Stretch stretch_in(int slab, std::size_t axis, const Vec3& a, const Vec3& b) const;

  /// The level of a place along the axis: of two places the higher has no lower level.
  [[nodiscard]] std::uint16_t level_of(const Vec3& p) const {
    const double place = (p[up_] - low_[up_]) * levels_;
    return place > 0.0 ? static_cast<std::uint16_t>(std::min(place, kTopLevel)) : std::uint16_t{0};
  }

  [[nodiscard]] Entry entry_of(std::uint32_t face) const;

  [[nodiscard]] std::span<const Entry> entries_in(int x, int y) const {
    const std::size_t cell = static_cast<std::size_t>(y) * static_cast<std::size_t>(cells_[0]) +
                             static_cast<std::size_t>(x);
    return {entries_.data() + offsets_[cell], offsets_[cell + 1] - offsets_[cell]};
  }

  /// Visits the faces of a cell but for those that are wholly below or above a stretch.
  template <class Visit>
  void visit_cell(int x, int y, const Stretch& stretch, const Visit& visit) const {
    const double bottom = stretch.low[up_];
    const double top = stretch.high[up_];
    const std::uint16_t bottom_level = level_of(stretch.low);
    const std::uint16_t top_level = level_of(stretch.high);
    for (const Entry& entry : entries_in(x, y)) {
      if (entry.high < bottom_level || entry.low > top_level) {
        continue;
      }
      const Triangle& t = mesh_->triangles[entry.face];
      const double p = mesh_->positions[t[0]][up_];
      const double q = mesh_->positions[t[1]][up_];
      const double r = mesh_->positions[t[2]][up_];
      if (!((p < bottom && q < bottom && r < bottom) || (p > top && q > top && r > top))) {
        visit(t);
      }
    }
  }

  static constexpr double kTopLevel = 65535.0;

  const TriMesh* mesh_ = nullptr;
  int up_ = 2;
  Vec3 low_ = Vec3::Zero();
  std::array<int, 2> cells_{1, 1};
  double cell_size_ = 1.0;
  double levels_ = 0.0;  ///< To a unit of length along the axis.
  std::vector<std::uint32_t> offsets_{0, 0};
  std::vector<Entry> entries_{};
};

}  // namespace vantage
