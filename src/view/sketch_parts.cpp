// SPDX-License-Identifier: MIT
#include "view/sketch_parts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include <Eigen/Geometry>
#include <meshoptimizer.h>

#include "vantage/mesh/measures.h"
#include "vantage/mesh/topology.h"

#include "visibility/surface.h"

namespace vantage {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
// Normals whose cosine with a cone's axis is larger belong to it. [ours]
constexpr double kSameCone = 0.9999;
// A vertex is seen if any of its faces is turned to the eye, that is from somewhat behind the plane
// across the cone's axis: the share of the mean sine between axis and normals. [ours, by trial]
constexpr double kOpening = 0.6;
// Far more than single precision rounds off, as a share of the eye's distance.
constexpr double kRounded = 1e-5;

/// Maps the camera's sphere to the unit sphere.
Vec3 in_frame(const Sphere& sphere, const Vec3& p) {
  return (p - sphere.centre) * (2.0 / sphere.diameter);
}

void append(SketchCoordinates& to, const Vec3& p) {
  to.x.push_back(static_cast<float>(p.x()));
  to.y.push_back(static_cast<float>(p.y()));
  to.z.push_back(static_cast<float>(p.z()));
}

void pad(SketchCoordinates& coordinates) {
  for (std::vector<float>* axis : {&coordinates.x, &coordinates.y, &coordinates.z}) {
    axis->resize(axis->size() + kWideLanes, 0.0F);
  }
}

/// The sides of each vertex.
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

/// A vertex and the significance it stands for.
struct Chosen {
  std::uint32_t vertex;
  double weight;
};

/// Systematic samples: walking along a curve through space, one each time a share of the total
/// significance has been passed.
std::vector<Chosen> choose_vertices(std::span<const std::uint32_t> order,
                                    std::span<const double> significance, std::size_t count) {
  std::vector<Chosen> chosen;
  if (order.size() <= count) {
    for (const std::uint32_t v : order) {
      chosen.push_back({v, significance[v]});
    }
    return chosen;
  }
  const double total = std::accumulate(significance.begin(), significance.end(), 0.0);
  const double step = total / static_cast<double>(count);
  double passed = 0.0;
  std::size_t taken = 0;
  for (const std::uint32_t v : order) {
    passed += significance[v];
    std::size_t here = 0;
    while (taken < count && passed > (static_cast<double>(taken) + 0.5) * step) {
      ++taken;
      ++here;
    }
    if (here > 0) {
      chosen.push_back({v, static_cast<double>(here) * step});
    }
  }
  return chosen;
}

/// Unit normals of the faces at each chosen vertex.
std::vector<std::vector<Vec3>> normals_at(const TriMesh& surface,
                                          const std::vector<Chosen>& chosen) {
  constexpr std::uint32_t kNone = ~std::uint32_t{0};
  std::vector<std::uint32_t> slot(surface.positions.size(), kNone);
  for (std::uint32_t i = 0; i < chosen.size(); ++i) {
    slot[chosen[i].vertex] = i;
  }
  std::vector<std::vector<Vec3>> normals(chosen.size());
  for (const Triangle& t : surface.triangles) {
    if (slot[t[0]] == kNone && slot[t[1]] == kNone && slot[t[2]] == kNone) {
      continue;
    }
    const Vec3 vector = area_vector(surface, t);
    const double size = vector.norm();
    for (const std::uint32_t v : t) {
      if (size > 0.0 && slot[v] != kNone) {
        normals[slot[v]].emplace_back(vector / size);
      }
    }
  }
  return normals;
}

/// Normals of about one direction.
struct Cone {
  Vec3 sum = Vec3::Zero();
  std::vector<Vec3> members{};
};

std::vector<Cone> gather_cones(const std::vector<Vec3>& normals) {
  std::vector<Cone> cones;
  for (const Vec3& normal : normals) {
    auto cone = std::find_if(cones.begin(), cones.end(), [&](const Cone& c) {
      return c.sum.dot(normal) > kSameCone * c.sum.norm();
    });
    if (cone == cones.end()) {
      if (cones.size() < SketchPoints::kCones) {
        cones.emplace_back();
      }
      cone = cones.end() - 1;
    }
    cone->sum += normal;
    cone->members.push_back(normal);
  }
  return cones;
}

/// Where the eye sees into the cone at p: axis · eye > offset.
float offset_of(const Cone& cone, const Vec3& p, double distance) {
  const Vec3 axis = cone.sum.normalized();
  double sine = 0.0;
  for (const Vec3& normal : cone.members) {
    sine += axis.cross(normal).norm() / static_cast<double>(cone.members.size());
  }
  return static_cast<float>(axis.dot(p) - kOpening * sine * distance);
}

/// The cone around all of a point's. Towards an eye at e the axis a of one of them rises by
/// (a − mean) · (e − p) more than the mean does, and its offset lies below its plane through p.
void append_hull(SketchPoints::Cones& hull, const std::vector<Cone>& cones, const Vec3& p,
                 double distance, bool perspective) {
  Vec3 mean = Vec3::Zero();
  for (const Cone& cone : cones) {
    mean += cone.sum.normalized() / static_cast<double>(cones.size());
  }
  const double reach = perspective ? distance + p.norm() : 1.0;
  double rise = 0.0;
  for (const Cone& cone : cones) {
    const Vec3 axis = cone.sum.normalized();
    const double offset = perspective ? offset_of(cone, p, distance) - axis.dot(p)
                                      : offset_of(cone, Vec3::Zero(), 1.0);
    rise = std::max(rise, (axis - mean).norm() * reach - offset);
  }
  append(hull.axis, mean);
  hull.offset.push_back(
      static_cast<float>((perspective ? mean.dot(p) : 0.0) - rise - kRounded * (1.0 + distance)));
}

}  // namespace

SketchPoints sketch_points(const TriMesh& surface, std::span<const std::uint32_t> order,
                           const std::vector<FaceSides>& sides,
                           std::span<const double> significance, const ScoringCamera& camera,
                           std::size_t count) {
  const std::vector<Chosen> chosen = choose_vertices(order, significance, count);
  const std::vector<std::vector<Vec3>> normals = normals_at(surface, chosen);
  const std::vector<FaceSides> side_of = sides_of_vertices(surface, sides);
  const bool perspective = camera.projection == Projection::Perspective;
  const double distance = camera.distance() / (0.5 * camera.sphere.diameter);
  SketchPoints points;
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    if (normals[i].empty()) {
      continue;  // no face with area names it, so that nothing ever sees it
    }
    const Vec3 p = in_frame(camera.sphere, surface.positions[chosen[i].vertex]);
    append(points.position, p);
    points.weight.push_back(static_cast<float>(chosen[i].weight));
    const std::vector<Cone> cones = gather_cones(normals[i]);
    if (side_of[chosen[i].vertex] == FaceSides::Both) {
      append(points.hull.axis, Vec3::Zero());
      points.hull.offset.push_back(-kInfinity);
    } else {
      append_hull(points.hull, cones, p, distance, perspective);
    }
    for (std::size_t k = 0; k < SketchPoints::kCones; ++k) {
      SketchPoints::Cones& of_points = points.cones[k];
      if (side_of[chosen[i].vertex] == FaceSides::Both) {
        append(of_points.axis, Vec3::Zero());
        of_points.offset.push_back(-kInfinity);  // one of its sides is always turned to the eye
      } else if (k < cones.size()) {
        append(of_points.axis, cones[k].sum.normalized());
        of_points.offset.push_back(perspective ? offset_of(cones[k], p, distance)
                                               : offset_of(cones[k], Vec3::Zero(), 1.0));
      } else {
        append(of_points.axis, Vec3::Zero());
        of_points.offset.push_back(kInfinity);
      }
    }
  }
  pad(points.position);
  pad(points.hull.axis);
  points.hull.offset.resize(points.hull.offset.size() + kWideLanes, kInfinity);
  for (SketchPoints::Cones& cones : points.cones) {
    pad(cones.axis);
    cones.offset.resize(cones.offset.size() + kWideLanes, kInfinity);
  }
  return points;
}

SketchSurface sketch_surface(const TriMesh& surface, const std::vector<FaceSides>& sides,
                             const Sphere& sphere, std::size_t count) {
  SketchSurface sketch;
  sketch.order = morton_order(surface.positions);
  std::vector<float> positions;
  positions.reserve(3 * surface.positions.size());
  for (const Vec3& p : surface.positions) {
    const Vec3 q = in_frame(sphere, p);
    append(sketch.corners, q);
    positions.insert(positions.end(),
                     {sketch.corners.x.back(), sketch.corners.y.back(), sketch.corners.z.back()});
  }
  std::vector<std::uint32_t> indices;
  indices.reserve(3 * surface.triangles.size());
  for (const Triangle& t : surface.triangles) {
    indices.insert(indices.end(), t.begin(), t.end());
  }
  if (surface.triangles.size() > count) {
    // Vertices merged in the cells of a grid: thin walls may close up, which a sketch can bear.
    std::vector<std::uint32_t> coarse(indices.size());
    coarse.resize(meshopt_simplifySloppy(coarse.data(), indices.data(), indices.size(),
                                         positions.data(), surface.positions.size(),
                                         3 * sizeof(float), 3 * count, kInfinity, nullptr));
    indices = std::move(coarse);
  }
  const std::vector<FaceSides> side_of = sides_of_vertices(surface, sides);
  // Only the corners that are left are drawn.
  constexpr std::uint32_t kNone = ~std::uint32_t{0};
  std::vector<std::uint32_t> row(surface.positions.size(), kNone);
  SketchCoordinates corners;
  for (std::size_t i = 0; i < indices.size(); i += 3) {
    Triangle face{indices[i], indices[i + 1], indices[i + 2]};
    sketch.two_sided.push_back(side_of[face[0]] == FaceSides::Both ? 1 : 0);
    for (std::uint32_t& v : face) {
      if (row[v] == kNone) {
        row[v] = static_cast<std::uint32_t>(corners.x.size());
        corners.x.push_back(sketch.corners.x[v]);
        corners.y.push_back(sketch.corners.y[v]);
        corners.z.push_back(sketch.corners.z[v]);
      }
      v = row[v];
    }
    sketch.faces.push_back(face);
  }
  // Whole eights.
  for (std::vector<float>* axis : {&corners.x, &corners.y, &corners.z}) {
    axis->resize((axis->size() + kWideLanes - 1) / kWideLanes * kWideLanes, 0.0F);
  }
  sketch.corners = std::move(corners);
  return sketch;
}

}  // namespace vantage
