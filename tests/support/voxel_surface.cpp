// SPDX-License-Identifier: MIT
#include "support/voxel_surface.h"

#include <array>

#include "vantage/mesh/mesh_check.h"

namespace vantage::test {

namespace {

using Cell = std::array<int, 3>;

/// Adds one side of a cell: `axis` is its normal, `side` 1 the one further along the axis.
void add_side(TriMesh& loose, const Cell& cell, int axis, int side, int parts) {
  const int u = (axis + 1) % 3;
  const int v = (axis + 2) % 3;
  const auto corner = [&](int a, int b) {
    Vec3 p(cell[0], cell[1], cell[2]);
    p[axis] += side;
    p[u] += static_cast<double>(a) / parts;
    p[v] += static_cast<double>(b) / parts;
    loose.positions.push_back(p);
    return static_cast<std::uint32_t>(loose.positions.size() - 1);
  };
  for (int a = 0; a < parts; ++a) {
    for (int b = 0; b < parts; ++b) {
      const std::array q{corner(a, b), corner(a + 1, b), corner(a + 1, b + 1), corner(a, b + 1)};
      const std::size_t second = side == 1 ? 1 : 3;
      const std::size_t last = side == 1 ? 3 : 1;
      loose.triangles.push_back({q[0], q.at(second), q[2]});
      loose.triangles.push_back({q[0], q[2], q.at(last)});
    }
  }
}

}  // namespace

TriMesh voxel_surface(int size_x, int size_y, int size_z,
                      const std::function<bool(int, int, int)>& solid, int parts) {
  const auto is_solid = [&](const Cell& c) {
    return c[0] >= 0 && c[1] >= 0 && c[2] >= 0 && c[0] < size_x && c[1] < size_y && c[2] < size_z &&
           solid(c[0], c[1], c[2]);
  };
  TriMesh loose;
  const auto add_cell = [&](const Cell& cell) {
    for (int axis = 0; axis < 3; ++axis) {
      for (const int side : {0, 1}) {
        Cell next = cell;
        next.at(static_cast<std::size_t>(axis)) += side == 1 ? 1 : -1;
        if (!is_solid(next)) {
          add_side(loose, cell, axis, side, parts);
        }
      }
    }
  };
  for (int index = 0; index < size_x * size_y * size_z; ++index) {
    const Cell cell{index / (size_y * size_z), index / size_z % size_y, index % size_z};
    if (is_solid(cell)) {
      add_cell(cell);
    }
  }
  return weld(loose).mesh;
}

TriMesh plate_with_holes(int holes) {
  const auto hole = [](int i) { return i % 5 >= 2; };  // bars 0–1, hole 2–4, bars 5–6, …
  return voxel_surface(5 * holes + 2, 7, 2,
                       [&](int i, int j, int) { return !(hole(i) && j >= 2 && j < 5); });
}

TriMesh cube_frame() {
  const auto outer = [](int i) { return i < 2 || i >= 6; };
  return voxel_surface(8, 8, 8, [&](int i, int j, int k) {
    return static_cast<int>(outer(i)) + static_cast<int>(outer(j)) + static_cast<int>(outer(k)) >=
           2;
  });
}

}  // namespace vantage::test
