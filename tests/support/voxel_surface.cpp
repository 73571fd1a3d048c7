// SPDX-License-Identifier: MIT
#include "support/voxel_surface.h"

#include <array>

#include "vantage/mesh/weld.h"

namespace vantage::test {

TriMesh voxel_surface(int size_x, int size_y, int size_z,
                      const std::function<bool(int, int, int)>& solid, int parts) {
  const std::array size{size_x, size_y, size_z};
  const auto is_solid = [&](const std::array<int, 3>& c) {
    for (std::size_t a = 0; a < 3; ++a) {
      if (c.at(a) < 0 || c.at(a) >= size.at(a)) {
        return false;
      }
    }
    return solid(c[0], c[1], c[2]);
  };
  TriMesh loose;
  // One side of a cell: `axis` is its normal, `side` 1 the one further along the axis.
  const auto add_side = [&](const std::array<int, 3>& cell, int axis, int side) {
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
  };
  for (int i = 0; i < size_x; ++i) {
    for (int j = 0; j < size_y; ++j) {
      for (int k = 0; k < size_z; ++k) {
        const std::array cell{i, j, k};
        for (int axis = 0; is_solid(cell) && axis < 3; ++axis) {
          for (const int side : {0, 1}) {
            std::array next = cell;
            next.at(static_cast<std::size_t>(axis)) += side == 1 ? 1 : -1;
            if (!is_solid(next)) {
              add_side(cell, axis, side);
            }
          }
        }
      }
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
