// SPDX-License-Identifier: MIT
#include "render/corner_normals.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include <Eigen/Geometry>

#include "vantage/mesh/measures.h"
#include "vantage/mesh/mesh_check.h"
#include "vantage/mesh/topology.h"

#include "core/parallel.h"

namespace vantage {
namespace {

constexpr std::size_t kGrain = 4096;
/// With more corners at a position than this, corners share the sum of the first corner's group
/// they fit into: comparing all pairs would take quadratic time at the hub of a large fan.
constexpr std::size_t kMaxPairwiseCorners = 64;

/// A corner as seen from its position: which one, its face's unit normal, its weighted share.
struct Corner {
  std::size_t face = 0;
  std::size_t index = 0;
  Vec3 normal = Vec3::Zero();
  double weight = 0.0;  ///< Angle times area; 0 if the face has no normal.
};

/// The corners at each welded position, as 3 · face + corner, ascending.
IndexLists corners_of_positions(const TriMesh& mesh, const WeldedMesh& welded) {
  const std::size_t positions = welded.mesh.positions.size();
  IndexLists lists;
  lists.offsets.assign(positions + 1, 0);
  for (const Triangle& triangle : mesh.triangles) {
    for (const std::uint32_t v : triangle) {
      ++lists.offsets[welded.welded_of_vertex[v] + 1];
    }
  }
  for (std::size_t p = 0; p < positions; ++p) {
    lists.offsets[p + 1] += lists.offsets[p];
  }
  lists.values.resize(3 * mesh.triangles.size());
  std::vector<std::uint32_t> next(lists.offsets.begin(), lists.offsets.end() - 1);
  std::uint32_t corner = 0;
  for (const Triangle& triangle : mesh.triangles) {
    for (const std::uint32_t v : triangle) {
      lists.values[next[welded.welded_of_vertex[v]]++] = corner++;
    }
  }
  return lists;
}

double angle_between(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// Area vectors of all faces.
std::vector<Vec3> face_areas(const TriMesh& mesh, const RunContext& run) {
  std::vector<Vec3> areas(mesh.triangles.size());
  parallel_for(run, areas.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) {
      areas[f] = area_vector(mesh, mesh.triangles[f]);
    }
  });
  return areas;
}

Corner make_corner(const TriMesh& mesh, const std::vector<Vec3>& areas, std::uint32_t id) {
  Corner corner;
  corner.face = id / 3;
  corner.index = id % 3;
  const Triangle& t = mesh.triangles[corner.face];
  const Vec3& p = mesh.positions[t[corner.index]];
  const Vec3 a = mesh.positions[t[(corner.index + 1) % 3]] - p;
  const Vec3 b = mesh.positions[t[(corner.index + 2) % 3]] - p;
  const double length = areas[corner.face].norm();
  if (length > 0.0 && std::isfinite(length)) {
    corner.normal = areas[corner.face] / length;
    corner.weight = angle_between(a, b) * length;
  }
  return corner;
}

/// The cosines of a Crease, which are what is compared.
struct CreaseCosines {
  double smooth;
  double crisp;
  double half_smooth;  ///< Faces all this near to one are smooth among each other.
};

/// How much of `other` counts beside `normal`, from 0 across a crease to 1, or to −1 if it is wound
/// the other way.
double share_of(const Vec3& normal, const Vec3& other, const CreaseCosines& crease) {
  const double cosine = normal.dot(other);
  const double t =
      std::clamp((std::abs(cosine) - crease.crisp) / (crease.smooth - crease.crisp), 0.0, 1.0);
  return std::copysign(t * t * (3.0 - 2.0 * t), cosine);
}

Vec3f unit_or(const Vec3& sum, const Vec3& fallback) {
  const double length = sum.norm();
  return (length > 0.0 ? Vec3(sum / length) : fallback).cast<float>();
}

using CornerNormals = std::vector<std::array<Vec3f, 3>>;

void smooth_pairwise(std::span<const Corner> corners, const CreaseCosines& crease,
                     CornerNormals& normals) {
  const bool all_smooth = std::all_of(corners.begin(), corners.end(), [&](const Corner& corner) {
    return corners.front().normal.dot(corner.normal) >= crease.half_smooth;
  });
  if (all_smooth) {
    Vec3 sum = Vec3::Zero();
    for (const Corner& corner : corners) {
      sum += corner.weight * corner.normal;
    }
    for (const Corner& corner : corners) {
      normals[corner.face][corner.index] = unit_or(sum, corner.normal);
    }
    return;
  }
  for (const Corner& corner : corners) {
    Vec3 sum = Vec3::Zero();
    for (const Corner& other : corners) {
      sum += share_of(corner.normal, other.normal, crease) * other.weight * other.normal;
    }
    normals[corner.face][corner.index] = unit_or(sum, corner.normal);
  }
}

void smooth_by_groups(std::span<const Corner> corners, const CreaseCosines& crease,
                      CornerNormals& normals) {
  struct Group {
    Vec3 leader;
    Vec3 sum;
  };

  std::vector<Group> groups;
  std::vector<std::size_t> group_of_corner;
  for (const Corner& corner : corners) {
    std::size_t g = 0;
    while (g < groups.size() && share_of(groups[g].leader, corner.normal, crease) == 0.0) {
      ++g;
    }
    if (g == groups.size()) {
      groups.push_back({corner.normal, Vec3::Zero()});
    }
    groups[g].sum +=
        share_of(groups[g].leader, corner.normal, crease) * corner.weight * corner.normal;
    group_of_corner.push_back(g);
  }
  for (std::size_t c = 0; c < corners.size(); ++c) {
    const Group& group = groups[group_of_corner[c]];
    const double side = group.leader.dot(corners[c].normal) < 0.0 ? -1.0 : 1.0;
    normals[corners[c].face][corners[c].index] = unit_or(side * group.sum, corners[c].normal);
  }
}

}  // namespace

std::vector<std::array<Vec3f, 3>> corner_normals(const TriMesh& mesh, const Crease& crease,
                                                 const RunContext& run) {
  const WeldedMesh welded = weld(mesh);
  const IndexLists corners_at = corners_of_positions(mesh, welded);
  const std::vector<Vec3> areas = face_areas(mesh, run);
  const CreaseCosines cosines{std::cos(crease.smooth_rad), std::cos(crease.crisp_rad),
                              std::cos(0.5 * crease.smooth_rad)};
  CornerNormals normals(mesh.triangles.size(), {Vec3f::Zero(), Vec3f::Zero(), Vec3f::Zero()});
  parallel_for(run, corners_at.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    std::vector<Corner> corners;
    for (std::size_t position = begin; position < end; ++position) {
      corners.clear();
      for (const std::uint32_t id : corners_at[position]) {
        Corner corner = make_corner(mesh, areas, id);
        if (corner.weight > 0.0) {
          corners.push_back(corner);
        }
      }
      if (corners.size() <= kMaxPairwiseCorners) {
        smooth_pairwise(corners, cosines, normals);
      } else {
        smooth_by_groups(corners, cosines, normals);
      }
    }
  });
  return normals;
}

}  // namespace vantage
