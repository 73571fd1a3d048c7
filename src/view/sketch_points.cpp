// SPDX-License-Identifier: MIT
#include "view/sketch_points.h"

#include <algorithm>
#include <numeric>

#include <Eigen/Geometry>

#include "vantage/mesh/measures.h"

#include "view/sketch_surface.h"
#include "visibility/surface.h"

namespace vantage {
namespace {

// Normals whose cosine with a cone's axis is larger belong to it. [ours]
constexpr double kSameCone = 0.9999;
// A vertex is seen if any of its faces is turned to the eye, that is from somewhat behind the plane
// across the cone's axis: the share of the mean sine between axis and normals. [ours, by trial]
constexpr double kOpening = 0.6;
// Far more than single precision rounds off, as a share of the eye's distance.
constexpr double kRounded = 1e-5;

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
  constexpr std::uint32_t kNotChosen = ~std::uint32_t{0};
  std::vector<std::uint32_t> slot(surface.positions.size(), kNotChosen);
  for (std::uint32_t i = 0; i < chosen.size(); ++i) {
    slot[chosen[i].vertex] = i;
  }
  std::vector<std::vector<Vec3>> normals(chosen.size());
  for (const Triangle& t : surface.triangles) {
    if (slot[t[0]] == kNotChosen && slot[t[1]] == kNotChosen && slot[t[2]] == kNotChosen) {
      continue;
    }
    const Vec3 vector = area_vector(surface, t);
    const double size = vector.norm();
    for (const std::uint32_t v : t) {
      if (size > 0.0 && slot[v] != kNotChosen) {
        normals[slot[v]].emplace_back(vector / size);
      }
    }
  }
  return normals;
}

/// The chosen that some face with area names, as nothing ever sees the others; by their mean normals.
std::vector<std::size_t> order_by_normal(const std::vector<std::vector<Vec3>>& normals) {
  std::vector<std::size_t> faced;
  std::vector<Vec3> means;
  for (std::size_t i = 0; i < normals.size(); ++i) {
    if (!normals[i].empty()) {
      faced.push_back(i);
      const Vec3 sum = std::accumulate(normals[i].begin(), normals[i].end(), Vec3(Vec3::Zero()));
      means.push_back(sum.stableNormalized());
    }
  }
  std::vector<std::size_t> order;
  order.reserve(faced.size());
  for (const std::uint32_t k : morton_order(means)) {
    order.push_back(faced[k]);
  }
  return order;
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
void append_hull(SketchPlanes& hull, const std::vector<Cone>& cones, const Vec3& p, double distance,
                 bool perspective) {
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
  const double height = (perspective ? mean.dot(p) : 0.0) - rise - kRounded * (1.0 + distance);
  hull.append(mean, static_cast<float>(height));
}

/// Adds the cones of a point both of whose sides count: one is always turned to the eye.
void append_two_sided(SketchPoints& points) {
  points.hull.append(Vec3::Zero(), SketchPlanes::kAlways);
  for (SketchPlanes& of_points : points.cones) {
    of_points.append(Vec3::Zero(), SketchPlanes::kAlways);
  }
}

void append_cones(SketchPoints& points, const std::vector<Cone>& cones, const Vec3& p,
                  double distance, bool perspective) {
  append_hull(points.hull, cones, p, distance, perspective);
  for (std::size_t k = 0; k < SketchPoints::kCones; ++k) {
    if (k < cones.size()) {
      points.cones[k].append(
          cones[k].sum.normalized(),
          perspective ? offset_of(cones[k], p, distance) : offset_of(cones[k], Vec3::Zero(), 1.0));
    } else {
      points.cones[k].append(Vec3::Zero(), SketchPlanes::kNever);
    }
  }
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
  for (const std::size_t i : order_by_normal(normals)) {
    const Vec3 p = in_frame(camera.sphere, surface.positions[chosen[i].vertex]);
    points.position.append(p);
    points.weight.push_back(static_cast<float>(chosen[i].weight));
    if (side_of[chosen[i].vertex] == FaceSides::Both) {
      append_two_sided(points);
    } else {
      append_cones(points, gather_cones(normals[i]), p, distance, perspective);
    }
  }
  points.position.pad();
  points.hull.pad();
  for (SketchPlanes& cones : points.cones) {
    cones.pad();
  }
  return points;
}

}  // namespace vantage
