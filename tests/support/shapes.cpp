// SPDX-License-Identifier: MIT
#include "support/shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

#include <Eigen/Geometry>

#include "vantage/mesh/mesh_check.h"

#include "core/random.h"

namespace vantage::test {
namespace {

using std::numbers::pi;

std::uint32_t index(int value) {
  return static_cast<std::uint32_t>(value);
}

void add_quad(TriMesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  mesh.triangles.push_back({a, b, c});
  mesh.triangles.push_back({a, c, d});
}

TriMesh tube_wall(double radius, double height, int around, int along) {
  TriMesh mesh;
  for (int j = 0; j <= along; ++j) {
    for (int i = 0; i < around; ++i) {
      const double angle = 2.0 * pi * i / around;
      mesh.positions.emplace_back(radius * std::cos(angle), radius * std::sin(angle),
                                  height * j / along);
    }
  }
  for (int j = 0; j < along; ++j) {
    for (int i = 0; i < around; ++i) {
      const int next = (i + 1) % around;
      add_quad(mesh, index(j * around + i), index(j * around + next),
               index((j + 1) * around + next), index((j + 1) * around + i));
    }
  }
  return mesh;
}

/// Signed distance to the union of three capsules from the origin in the xy plane.
double y_distance(const Vec3& p, double radius) {
  double nearest = 1e9;
  for (const double degrees : {90.0, 210.0, 330.0}) {
    const double angle = degrees * pi / 180.0;
    const Vec3 axis(std::cos(angle), std::sin(angle), 0.0);
    const double along = std::clamp(p.dot(axis), 0.0, 1.0);
    nearest = std::min(nearest, (p - along * axis).norm());
  }
  return nearest - radius;
}

/// Surface of the zero set of a sampled function by marching tetrahedra (six per cell).
class MarchingTetrahedra {
 public:
  MarchingTetrahedra(int cells, double low, double high, double radius)
      : n_(cells + 1), low_(low), step_((high - low) / cells) {
    value_.resize(static_cast<std::size_t>(n_) * index(n_) * index(n_));
    for (int k = 0; k < n_; ++k) {
      for (int j = 0; j < n_; ++j) {
        for (int i = 0; i < n_; ++i) {
          double d = y_distance(point(i, j, k), radius);
          value_[id(i, j, k)] = d == 0.0 ? 1e-9 : d;
        }
      }
    }
    for (int k = 0; k < cells; ++k) {
      for (int j = 0; j < cells; ++j) {
        for (int i = 0; i < cells; ++i) {
          cell(i, j, k);
        }
      }
    }
  }

  TriMesh mesh{};

 private:
  [[nodiscard]] Vec3 point(int i, int j, int k) const {
    return {low_ + step_ * i, low_ + step_ * j, low_ + step_ * k};
  }

  [[nodiscard]] std::size_t id(int i, int j, int k) const {
    return (static_cast<std::size_t>(k) * index(n_) + index(j)) * index(n_) + index(i);
  }

  [[nodiscard]] Vec3 point_of(std::size_t v) const {
    const auto n = static_cast<std::size_t>(n_);
    return point(static_cast<int>(v % n), static_cast<int>(v / n % n), static_cast<int>(v / n / n));
  }

  std::uint32_t cut(std::size_t a, std::size_t b) {
    const auto key = std::minmax(a, b);
    const auto [entry, fresh] = vertex_of_edge_.try_emplace(key, index(0));
    if (fresh) {
      const double s = value_[key.first] / (value_[key.first] - value_[key.second]);
      entry->second = static_cast<std::uint32_t>(mesh.positions.size());
      mesh.positions.push_back(point_of(key.first) +
                               s * (point_of(key.second) - point_of(key.first)));
    }
    return entry->second;
  }

  /// Adds a triangle turned away from the inside point.
  void add(std::uint32_t a, std::uint32_t b, std::uint32_t c, const Vec3& inner) {
    const Vec3& p = mesh.positions[a];
    const Vec3 normal = (mesh.positions[b] - p).cross(mesh.positions[c] - p);
    if (normal.dot(p - inner) < 0.0) {
      std::swap(b, c);
    }
    mesh.triangles.push_back({a, b, c});
  }

  void tetrahedron(const std::array<std::size_t, 4>& corner) {
    std::vector<std::size_t> in;
    std::vector<std::size_t> out;
    for (const std::size_t v : corner) {
      (value_[v] < 0.0 ? in : out).push_back(v);
    }
    if (in.empty() || out.empty()) {
      return;
    }
    const Vec3 inner = point_of(in.front());
    if (in.size() == 1) {
      add(cut(in[0], out[0]), cut(in[0], out[1]), cut(in[0], out[2]), inner);
    } else if (in.size() == 3) {
      add(cut(in[0], out[0]), cut(in[1], out[0]), cut(in[2], out[0]),
          (point_of(in[0]) + point_of(in[1]) + point_of(in[2])) / 3.0);
    } else {
      const Vec3 middle = 0.5 * (point_of(in[0]) + point_of(in[1]));
      add(cut(in[0], out[0]), cut(in[0], out[1]), cut(in[1], out[1]), middle);
      add(cut(in[0], out[0]), cut(in[1], out[1]), cut(in[1], out[0]), middle);
    }
  }

  /// Whether the surface passes through a cell.
  [[nodiscard]] bool is_cut(int i, int j, int k) const {
    int inside = 0;
    for (int corner = 0; corner < 8; ++corner) {
      inside += value_[id(i + corner % 2, j + corner / 2 % 2, k + corner / 4)] < 0.0 ? 1 : 0;
    }
    return inside > 0 && inside < 8;
  }

  void cell(int i, int j, int k) {
    if (!is_cut(i, j, k)) {
      return;
    }
    // Kuhn's six tetrahedra along the diagonal: one for each order of the axes.
    std::array<int, 3> axes{0, 1, 2};
    do {
      std::array<int, 3> at{i, j, k};
      std::array<std::size_t, 4> corner{};
      corner[0] = id(at[0], at[1], at[2]);
      for (std::size_t s = 0; s < 3; ++s) {
        ++at[static_cast<std::size_t>(axes[s])];
        corner[s + 1] = id(at[0], at[1], at[2]);
      }
      tetrahedron(corner);
    } while (std::next_permutation(axes.begin(), axes.end()));
  }

  int n_;
  double low_;
  double step_;
  std::vector<double> value_;
  std::map<std::pair<std::size_t, std::size_t>, std::uint32_t> vertex_of_edge_;
};

}  // namespace

TriMesh sphere(int level) {
  TriMesh mesh;
  const double phi = std::numbers::phi;
  for (const double a : {-1.0, 1.0}) {
    for (const double b : {-phi, phi}) {
      mesh.positions.emplace_back(0.0, a, b);
      mesh.positions.emplace_back(a, b, 0.0);
      mesh.positions.emplace_back(b, 0.0, a);
    }
  }
  // Faces of the icosahedron: all triples at edge length 2, wound outwards.
  for (std::uint32_t a = 0; a < 12; ++a) {
    for (std::uint32_t b = a + 1; b < 12; ++b) {
      for (std::uint32_t c = b + 1; c < 12; ++c) {
        const Vec3& p = mesh.positions[a];
        const Vec3& q = mesh.positions[b];
        const Vec3& r = mesh.positions[c];
        if ((p - q).norm() < 2.1 && (q - r).norm() < 2.1 && (r - p).norm() < 2.1) {
          const bool outward = (q - p).cross(r - p).dot(p + q + r) > 0.0;
          mesh.triangles.push_back(outward ? Triangle{a, b, c} : Triangle{a, c, b});
        }
      }
    }
  }
  for (int i = 0; i < level; ++i) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middle;
    const auto split = [&](std::uint32_t a, std::uint32_t b) {
      const auto [entry, fresh] = middle.try_emplace(std::minmax(a, b), 0U);
      if (fresh) {
        entry->second = static_cast<std::uint32_t>(mesh.positions.size());
        const Vec3 sum = mesh.positions[a] + mesh.positions[b];
        mesh.positions.push_back(sum);
      }
      return entry->second;
    };
    std::vector<Triangle> finer;
    for (const auto& [a, b, c] : mesh.triangles) {
      const std::uint32_t ab = split(a, b);
      const std::uint32_t bc = split(b, c);
      const std::uint32_t ca = split(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    mesh.triangles = std::move(finer);
    for (Vec3& p : mesh.positions) {
      p.normalize();
    }
  }
  for (Vec3& p : mesh.positions) {
    p.normalize();
  }
  return mesh;
}

TriMesh cube_sphere(int cells) {
  TriMesh mesh = box(2.0, 2.0, 2.0, cells);
  for (Vec3& p : mesh.positions) {
    p = (0.25 * std::numbers::pi * (p - Vec3::Ones())).array().tan().matrix().normalized();
  }
  return mesh;
}

TriMesh torus(double major, double minor, int major_segments, int minor_segments) {
  TriMesh mesh;
  for (int i = 0; i < major_segments; ++i) {
    const double u = 2.0 * pi * i / major_segments;
    for (int j = 0; j < minor_segments; ++j) {
      const double v = 2.0 * pi * j / minor_segments;
      const double r = major + minor * std::cos(v);
      mesh.positions.emplace_back(r * std::cos(u), r * std::sin(u), minor * std::sin(v));
    }
  }
  for (int i = 0; i < major_segments; ++i) {
    const int next_i = (i + 1) % major_segments;
    for (int j = 0; j < minor_segments; ++j) {
      const int next_j = (j + 1) % minor_segments;
      add_quad(mesh, index(i * minor_segments + j), index(next_i * minor_segments + j),
               index(next_i * minor_segments + next_j), index(i * minor_segments + next_j));
    }
  }
  return mesh;
}

TriMesh box(double x, double y, double z, int cells) {
  TriMesh loose;
  const Vec3 size(x, y, z);
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    for (const int side : {0, 1}) {
      for (int i = 0; i < cells; ++i) {
        for (int j = 0; j < cells; ++j) {
          const auto corner = [&](int a, int b) {
            Vec3 p;
            p[axis] = side * size[axis];
            p[u] = size[u] * a / cells;
            p[v] = size[v] * b / cells;
            loose.positions.push_back(p);
            return static_cast<std::uint32_t>(loose.positions.size() - 1);
          };
          const auto a = corner(i, j);
          const auto b = corner(i + 1, j);
          const auto c = corner(i + 1, j + 1);
          const auto d = corner(i, j + 1);
          side == 1 ? add_quad(loose, a, b, c, d) : add_quad(loose, a, d, c, b);
        }
      }
    }
  }
  return weld(loose).mesh;
}

TriMesh open_cylinder(double radius, double height, int around, int along) {
  return tube_wall(radius, height, around, along);
}

TriMesh cylinder(double radius, double height, int around, int along) {
  TriMesh mesh = tube_wall(radius, height, around, along);
  const auto bottom = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.emplace_back(0.0, 0.0, 0.0);
  mesh.positions.emplace_back(0.0, 0.0, height);
  for (int i = 0; i < around; ++i) {
    const int next = (i + 1) % around;
    mesh.triangles.push_back({bottom, index(next), index(i)});
    mesh.triangles.push_back({bottom + 1, index(along * around + i), index(along * around + next)});
  }
  return mesh;
}

TriMesh y_of_tubes(double radius, int cells) {
  const double reach = 1.05 + radius;
  return MarchingTetrahedra(cells, -reach, reach, radius).mesh;
}

TriMesh sphere_with_caps(double height) {
  TriMesh mesh = sphere(4);
  const std::size_t faces = mesh.triangles.size();
  for (std::size_t f = 0; f < faces; f += 7) {
    const auto [a, b, c] = mesh.triangles[f];
    const auto tip = static_cast<std::uint32_t>(mesh.positions.size());
    const Vec3 middle = 0.5 * (mesh.positions[a] + mesh.positions[b]);
    mesh.positions.emplace_back(middle + height * (mesh.positions[c] - middle));
    mesh.triangles[f] = {a, b, tip};
    mesh.triangles.push_back({b, c, tip});
    mesh.triangles.push_back({c, a, tip});
  }
  return mesh;
}

TriMesh sheet(double x, double y, int cells) {
  TriMesh mesh;
  for (int j = 0; j <= cells; ++j) {
    for (int i = 0; i <= cells; ++i) {
      mesh.positions.emplace_back(x * i / cells, y * j / cells, 0.0);
    }
  }
  const int row = cells + 1;
  for (int j = 0; j < cells; ++j) {
    for (int i = 0; i < cells; ++i) {
      add_quad(mesh, index(j * row + i), index(j * row + i + 1), index((j + 1) * row + i + 1),
               index((j + 1) * row + i));
    }
  }
  return mesh;
}

TriMesh wall_with_window() {
  TriMesh wall;
  for (const double z : {0.0, 1.0}) {
    for (const double half : {2.0, 1.0}) {
      for (const auto& [x, y] : {std::pair(-1, -1), {1, -1}, {1, 1}, {-1, 1}}) {
        wall.positions.emplace_back(half * x, half * y, z);
      }
    }
  }
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    wall.triangles.push_back({a, b, c});
    wall.triangles.push_back({a, c, d});
  };
  for (std::uint32_t k = 0; k < 4; ++k) {
    const std::uint32_t next = (k + 1) % 4;
    add(8 + k, 8 + next, 12 + next, 12 + k);  // front
    add(4 + k, 4 + next, next, k);            // back
    add(k, next, 8 + next, 8 + k);            // outside
    add(4 + next, 4 + k, 12 + k, 12 + next);  // of the window
  }
  return wall;
}

TriMesh together(const TriMesh& first, const TriMesh& second, const Vec3& shift) {
  TriMesh mesh = first;
  const auto offset = static_cast<std::uint32_t>(first.positions.size());
  for (const Vec3& p : second.positions) {
    mesh.positions.emplace_back(p + shift);
  }
  for (const auto& [a, b, c] : second.triangles) {
    mesh.triangles.push_back({a + offset, b + offset, c + offset});
  }
  return mesh;
}

TriMesh points_of_ball_and_pole() {
  TriMesh points{.positions = sphere(2).positions, .triangles = {}};
  for (int i = 1; i <= 30; ++i) {
    points.positions.emplace_back(0.0, 1.0 + 0.1 * i, 0.0);
  }
  return points;
}

TriMesh inside_out(TriMesh mesh) {
  for (Triangle& t : mesh.triangles) {
    std::swap(t[1], t[2]);
  }
  return mesh;
}

TriMesh soup(const TriMesh& mesh) {
  TriMesh loose;
  for (const Triangle& t : mesh.triangles) {
    const auto first = static_cast<std::uint32_t>(loose.positions.size());
    for (const std::uint32_t v : t) {
      loose.positions.push_back(mesh.positions[v]);
    }
    loose.triangles.push_back({first, first + 1, first + 2});
  }
  return loose;
}

TriMesh moved(TriMesh mesh, double scale, double angle_rad, const Vec3& axis, const Vec3& shift) {
  const Eigen::Matrix3d R = Eigen::AngleAxisd(angle_rad, axis.normalized()).toRotationMatrix();
  for (Vec3& p : mesh.positions) {
    const Vec3 rotated = R * p;
    p = scale * rotated + shift;
  }
  return mesh;
}

TriMesh renumbered(const TriMesh& mesh, unsigned seed, std::vector<std::uint32_t>* old_of_new) {
  std::vector<std::uint32_t> order(mesh.positions.size());
  std::iota(order.begin(), order.end(), 0U);
  Pcg32 random(seed);
  for (std::size_t i = order.size(); i > 1; --i) {
    std::swap(order[i - 1], order[random.below(static_cast<std::uint32_t>(i))]);
  }
  std::vector<std::uint32_t> new_of_old(order.size());
  TriMesh result;
  for (std::uint32_t i = 0; i < order.size(); ++i) {
    new_of_old[order[i]] = i;
    result.positions.push_back(mesh.positions[order[i]]);
  }
  for (const auto& [a, b, c] : mesh.triangles) {
    result.triangles.push_back({new_of_old[a], new_of_old[b], new_of_old[c]});
  }
  if (old_of_new != nullptr) {
    *old_of_new = std::move(order);
  }
  return result;
}

}  // namespace vantage::test
