// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "vantage/mesh/measures.h"
#include "vantage/orientation/orientation.h"
#include "vantage/spatial/mirror_symmetry.h"

#include "orientation/planar_hull.h"

namespace vantage {
namespace {

using Mat3 = Eigen::Matrix3d;
using Vec2 = Eigen::Vector2d;

// cos of 5 degrees: directions nearer than that are one.
constexpr double kSame = 0.996;
// Plane parts and edges of an outline that are tried, the largest first. [ours]
constexpr std::size_t kPlanes = 6;
constexpr std::size_t kEdges = 4;
// Another box must suit better than the axes' by this. [ours]
constexpr double kClearly = 0.05;
// What an axis across a mirror plane is worth, beside shares of the area and of the volume. [ours]
constexpr double kMirrorWorth = 0.2;

struct Face {
  Vec3 normal;
  double area;
};

/// Adds a direction unless it, or its opposite, is there.
void add_direction(std::vector<Vec3>& directions, const Vec3& direction) {
  const auto is_same = [&](const Vec3& other) { return std::abs(other.dot(direction)) > kSame; };
  if (direction.allFinite() && std::none_of(directions.begin(), directions.end(), is_same)) {
    directions.push_back(direction.normalized());
  }
}

/// Normals of the faces, the largest first.
std::vector<Face> faces_of(const TriMesh& surface) {
  std::vector<Face> faces;
  faces.reserve(surface.triangles.size());
  for (const Triangle& t : surface.triangles) {
    const Vec3& a = surface.positions[t[0]];
    const Vec3 twice = (surface.positions[t[1]] - a).cross(surface.positions[t[2]] - a);
    const double area = twice.norm();
    if (area > 0.0) {
      faces.push_back({twice / area, area});
    }
  }
  std::stable_sort(faces.begin(), faces.end(),
                   [](const Face& a, const Face& b) { return a.area > b.area; });
  return faces;
}

/// Normals that the most area has, of those of the largest faces.
void add_planes(const std::vector<Face>& faces, std::vector<Vec3>& directions) {
  constexpr std::size_t kTried = 64;
  std::vector<Vec3> normals;
  for (std::size_t i = 0; i < faces.size() && normals.size() < kTried; ++i) {
    add_direction(normals, faces[i].normal);
  }
  std::vector<Face> planes;
  for (const Vec3& normal : normals) {
    double area = 0.0;
    for (const Face& face : faces) {
      area += std::abs(face.normal.dot(normal)) > kSame ? face.area : 0.0;
    }
    planes.push_back({normal, area});
  }
  std::stable_sort(planes.begin(), planes.end(),
                   [](const Face& a, const Face& b) { return a.area > b.area; });
  for (std::size_t i = 0; i < std::min(kPlanes, planes.size()); ++i) {
    add_direction(directions, planes[i].normal);
  }
}

void add_principal_axes(const std::vector<Vec3>& points, std::vector<Vec3>& directions) {
  Vec3 mean = Vec3::Zero();
  for (const Vec3& p : points) {
    mean += p / static_cast<double>(points.size());
  }
  Mat3 spread = Mat3::Zero();
  for (const Vec3& p : points) {
    spread += (p - mean) * (p - mean).transpose() / static_cast<double>(points.size());
  }
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(spread);
  for (Eigen::Index i = 0; i < 3; ++i) {
    add_direction(directions, solver.eigenvectors().col(i));
  }
}

/// Boxes with one axis along `axis` and a side on an edge of the outline seen along it.
void add_boxes(const Vec3& axis, const std::vector<Vec3>& points, std::vector<Mat3>& boxes) {
  const Vec3 u = axis.unitOrthogonal();
  const Vec3 v = axis.cross(u);
  std::vector<Vec2> flat;
  flat.reserve(points.size());
  for (const Vec3& p : points) {
    flat.emplace_back(u.dot(p), v.dot(p));
  }
  const std::vector<Vec2> hull = planar_hull(std::move(flat));
  std::vector<Vec2> edges;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    edges.emplace_back(hull[(i + 1) % hull.size()] - hull[i]);
  }
  std::stable_sort(edges.begin(), edges.end(),
                   [](const Vec2& a, const Vec2& b) { return a.norm() > b.norm(); });
  std::vector<Vec3> sides;
  for (const Vec2& edge : edges) {
    if (sides.size() < kEdges) {
      add_direction(sides, (u * edge.x() + v * edge.y()).normalized());
    }
  }
  for (const Vec3& side : sides) {
    Mat3 box;
    box << axis, side, axis.cross(side);
    boxes.push_back(box.transpose());
  }
}

/// How well a box suits the surface; volumes are compared with `least`.
class BoxWorth {
 public:
  BoxWorth(const std::vector<Vec3>& points, const std::vector<Face>& faces,
           const std::vector<MirrorPlane>& planes)
      : points_(points), faces_(faces), planes_(planes) {}

  [[nodiscard]] double volume(const Mat3& box) const {
    Vec3 low = Vec3::Constant(std::numeric_limits<double>::max());
    Vec3 high = -low;
    for (const Vec3& p : points_) {
      const Vec3 at = box * p;
      low = low.cwiseMin(at);
      high = high.cwiseMax(at);
    }
    const Vec3 size = high - low;
    return (size.array() + 1e-3 * size.maxCoeff()).prod();  // sheets have volume, too
  }

  /// What faces and mirror planes say of it.
  [[nodiscard]] double alignment(const Mat3& box) const {
    double aligned = 0.0;
    double area = 0.0;
    for (const Face& face : faces_) {
      const double along = (box * face.normal).cwiseAbs().maxCoeff();
      const double square = along * along;
      const double fourth = square * square;
      aligned += face.area * fourth * fourth * fourth * fourth;  // half of it is lost at 17 degrees
      area += face.area;
    }
    double mirrors = 0.0;
    for (const MirrorPlane& plane : planes_) {
      mirrors += (box * plane.normal).cwiseAbs().maxCoeff() > kSame ? kMirrorWorth : 0.0;
    }
    return (area > 0.0 ? aligned / area : 0.0) + std::min(mirrors, 2.0 * kMirrorWorth);
  }

  [[nodiscard]] double of(const Mat3& box, double least) const {
    return alignment(box) + least / volume(box);
  }

 private:
  const std::vector<Vec3>& points_;
  const std::vector<Face>& faces_;
  const std::vector<MirrorPlane>& planes_;
};

/// Of the rotations to the same box's axes, the smallest.
Mat3 smallest_turn(const Mat3& box) {
  Mat3 best = Mat3::Identity();
  double most = -4.0;
  for (Eigen::Index first = 0; first < 3; ++first) {
    for (const Eigen::Index second : {(first + 1) % 3, (first + 2) % 3}) {
      for (const double one : {1.0, -1.0}) {
        for (const double two : {1.0, -1.0}) {
          Mat3 turn;
          turn.row(0) = one * box.row(first);
          turn.row(1) = two * box.row(second);
          turn.row(2) = turn.row(0).cross(turn.row(1));
          if (turn.trace() > most + 1e-9) {
            most = turn.trace();
            best = turn;
          }
        }
      }
    }
  }
  return best;
}

}  // namespace

Mat3 standing_rotation(const TriMesh& surface) {
  const std::vector<Vec3> points = referenced_points(surface);
  const std::vector<Face> faces = faces_of(surface);
  if (faces.empty()) {
    return Mat3::Identity();
  }
  const std::vector<MirrorPlane> planes = mirror_planes(surface);
  std::vector<Vec3> axes;
  for (const MirrorPlane& plane : planes) {
    add_direction(axes, plane.normal);
  }
  add_planes(faces, axes);
  add_principal_axes(points, axes);
  std::vector<Mat3> boxes{Mat3::Identity()};
  for (const Vec3& axis : axes) {
    add_boxes(axis, points, boxes);
  }
  const BoxWorth worth(points, faces, planes);
  double least = std::numeric_limits<double>::max();
  for (const Mat3& box : boxes) {
    least = std::min(least, worth.volume(box));
  }
  Mat3 best = boxes.front();
  double most = worth.of(best, least) + kClearly;
  // The least box around an animal lies along nose and tail: volume alone turns nothing.
  const double alignment = worth.alignment(best) + kClearly;
  for (const Mat3& box : boxes) {
    if (const double here = worth.of(box, least); here > most && worth.alignment(box) > alignment) {
      most = here;
      best = box;
    }
  }
  return smallest_turn(best);
}

}  // namespace vantage
