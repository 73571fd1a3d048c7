// SPDX-License-Identifier: MIT
#include "spatial/point_rings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "core/cross.h"
#include "core/parallel.h"
#include "spatial/point_tree.h"

namespace vantage {
namespace {

constexpr std::size_t kGrain = 1024;  // points a task
/// Sine below which three inverted points lie on a line, so that four points lie on a circle.
constexpr double kOnLine = 1e-10;
/// Points whose projection is this close to the centre, over the neighbourhood's reach, lie behind
/// it: which way they lead is rounding.
constexpr double kBehind = 1e-9;
/// Second over first principal variance below which a neighbourhood is a line and has no plane.
constexpr double kLine = 1e-12;

using Vec2 = Eigen::Vector2d;

struct Inverted {
  Vec2 place;
  std::uint32_t point;
};

constexpr std::uint32_t kCentre = 0xffffffffu;

/// Corners of the convex hull, counter-clockwise; corners that are none within kOnLine left out.
std::vector<Inverted> hull_of(std::vector<Inverted>& points) {
  std::sort(points.begin(), points.end(), [](const Inverted& a, const Inverted& b) {
    return std::tuple(a.place.x(), a.place.y(), a.point) <
           std::tuple(b.place.x(), b.place.y(), b.point);
  });
  std::vector<Inverted> hull;
  const auto add = [&hull](const Inverted& next, std::size_t keep) {
    while (hull.size() >= keep + 2) {
      const Vec2 before = hull.back().place - hull[hull.size() - 2].place;
      const Vec2 after = next.place - hull.back().place;
      if (cross(before, after) > kOnLine * before.norm() * after.norm()) {
        break;
      }
      hull.pop_back();
    }
    hull.push_back(next);
  };
  for (const Inverted& p : points) {
    add(p, 0);
  }
  const std::size_t lower = hull.size() - 1;
  for (std::size_t i = points.size() - 1; i-- > 0;) {
    add(points[i], lower);
  }
  hull.pop_back();  // the first again
  return hull;
}

/// Axes of the plane that fits the points best; false if they lie on a line.
bool fit_plane(std::span<const Vec3> around, Vec3& u, Vec3& v) {
  Vec3 mean = Vec3::Zero();
  for (const Vec3& p : around) {
    mean += p / static_cast<double>(around.size());
  }
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const Vec3& p : around) {
    covariance += (p - mean) * (p - mean).transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
  u = solver.eigenvectors().col(2);
  v = solver.eigenvectors().col(1);
  return solver.eigenvalues()[1] > kLine * solver.eigenvalues()[2];
}

/// Finds rings, one after the other; keeps its buffers.
class RingFinder {
 public:
  RingFinder(std::span<const Vec3> points, const PointTree& tree, std::size_t k)
      : points_(points), tree_(tree), found_(std::min(k, points.size())), squared_(found_.size()) {}

  /// The ring of a point, appended to `ring`; returns whether it is closed.
  bool find(std::uint32_t point, std::vector<std::uint32_t>& ring) {
    const Vec3& centre = points_[point];
    const std::size_t count = tree_.nearest(centre, found_, squared_);
    // Offsets over the reach: squares and inverses then stay near 1 in any unit.
    const double reach = std::sqrt(squared_[count - 1]);
    around_.assign(1, Vec3::Zero());
    who_.assign(1, point);
    for (std::size_t i = 0; i < count; ++i) {
      if (found_[i] != point) {
        around_.emplace_back((points_[found_[i]] - centre) / reach);
        who_.push_back(static_cast<std::uint32_t>(found_[i]));
      }
    }
    Vec3 u = Vec3::Zero();
    Vec3 v = Vec3::Zero();
    if (count < 3 || !fit_plane(around_, u, v)) {
      return false;
    }
    // A point is a Delaunay neighbour of the centre exactly if its inverse in a circle around the
    // centre is a corner of the hull of all inverses and the centre.
    inverted_.assign(1, {Vec2::Zero(), kCentre});
    for (std::size_t i = 1; i < around_.size(); ++i) {
      const Vec2 flat(around_[i].dot(u), around_[i].dot(v));
      const double squared = flat.squaredNorm();
      if (squared > kBehind * kBehind) {
        inverted_.push_back({flat / squared, who_[i]});
      }
    }
    if (inverted_.size() < 3) {
      return false;
    }
    std::vector<Inverted> hull = hull_of(inverted_);
    const auto at = std::find_if(hull.begin(), hull.end(),
                                 [](const Inverted& p) { return p.point == kCentre; });
    const bool closed = at == hull.end();
    if (!closed) {
      std::rotate(hull.begin(), at, hull.end());
      hull.erase(hull.begin());
    }
    for (const Inverted& p : hull) {
      ring.push_back(p.point);
    }
    return closed;
  }

 private:
  std::span<const Vec3> points_;
  const PointTree& tree_;
  std::vector<std::size_t> found_;
  std::vector<double> squared_;
  std::vector<Vec3> around_{};
  std::vector<std::uint32_t> who_{};
  std::vector<Inverted> inverted_{};
};

}  // namespace

std::size_t neighbourhood_size(std::size_t point_count) {
  const double wanted = std::round(0.012 * static_cast<double>(point_count));
  return static_cast<std::size_t>(std::clamp(wanted, 8.0, 30.0));
}

PointRings point_rings(std::span<const Vec3> points, std::size_t k, const RunContext& run) {
  PointRings rings;
  rings.closed.assign(points.size(), 0);
  rings.neighbours.offsets.assign(points.size() + 1, 0);
  if (points.size() < 2) {
    return rings;
  }
  const PointTree tree(points);
  std::vector<std::vector<std::uint32_t>> parts((points.size() + kGrain - 1) / kGrain);
  parallel_for(run, points.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    RingFinder finder(points, tree, k);
    auto& part = parts[begin / kGrain];
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t before = part.size();
      rings.closed[i] = finder.find(static_cast<std::uint32_t>(i), part) ? 1 : 0;
      rings.neighbours.offsets[i + 1] = static_cast<std::uint32_t>(part.size() - before);
    }
  });
  for (std::size_t i = 0; i < points.size(); ++i) {
    rings.neighbours.offsets[i + 1] += rings.neighbours.offsets[i];
  }
  rings.neighbours.values.reserve(rings.neighbours.offsets.back());
  for (const auto& part : parts) {
    rings.neighbours.values.insert(rings.neighbours.values.end(), part.begin(), part.end());
  }
  return rings;
}

std::vector<Triangle> agreed_triangles(const PointRings& rings, int votes) {
  std::vector<Triangle> cast;
  cast.reserve(rings.neighbours.values.size());
  for (std::uint32_t i = 0; i < rings.closed.size(); ++i) {
    rings.each_triangle(i, [&](std::uint32_t a, std::uint32_t b) {
      Triangle t{i, a, b};
      std::sort(t.begin(), t.end());
      cast.push_back(t);
    });
  }
  std::sort(cast.begin(), cast.end());
  std::size_t kept = 0;
  for (std::size_t begin = 0; begin < cast.size();) {
    std::size_t end = begin;
    while (end < cast.size() && cast[end] == cast[begin]) {
      ++end;
    }
    if (end - begin >= static_cast<std::size_t>(votes)) {
      cast[kept++] = cast[begin];
    }
    begin = end;
  }
  cast.resize(kept);
  cast.shrink_to_fit();
  return cast;
}

}  // namespace vantage
