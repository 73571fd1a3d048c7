// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "vantage/core/vec3.h"
#include "vantage/mesh/curve_graph.h"
#include "vantage/mesh/topology.h"

#include "render/picture_rays.h"

namespace vantage {

/// How much thicker than its tubes a graph's ends and branches are drawn.
inline constexpr double kJointThickness = 1.6;

/// Where a ray meets a tube or a joint.
struct TubeHit {
  double t = std::numeric_limits<double>::infinity();
  Vec3 normal = Vec3::Zero();  ///< Unit, outward.
};

/// A curve graph as round tubes, exact in double precision. Nodes of degree two are joined
/// smoothly; ends, branches and isolated nodes are balls of kJointThickness times the radius.
/// Tubes are listed by picture tile, the foremost first, so that a ray asks only those near it and not
/// those behind the one that it meets.
class Tubes {
 public:
  static constexpr int kTilePx = 8;  ///< Side of a tile.

  /// \param graph in the frame of the rays. \param radius of the tubes, > 0.
  /// \param joint_thickness radius of the balls over that of the tubes.
  Tubes(const CurveGraph& graph, double radius, const PictureRays& rays, int width, int height,
        double joint_thickness = kJointThickness);

  /// False only if no ray that belongs to pixel (x, y) meets a tube.
  [[nodiscard]] bool may_show(int x, int y) const { return !near(x, y).empty(); }

  /// Nearest hit of a ray that belongs to pixel (x, y). Ties go to the lower index.
  [[nodiscard]] TubeHit closest_hit(const PictureRay& ray, int x, int y) const;

 private:
  /// A ball if both ends are equal.
  struct Capsule {
    Vec3 begin;
    Vec3 end;
    double radius;
    std::uint32_t index;  ///< In the order of edges, then nodes.
    double depth;         ///< Along the line of sight: no point of it has less.
  };

  void add(const Vec3& begin, const Vec3& end, double radius);
  /// Tiles that a capsule may show in, ascending.
  [[nodiscard]] std::vector<std::uint32_t> tiles_of(const Capsule& capsule,
                                                    const PictureRays& rays) const;
  [[nodiscard]] std::span<const std::uint32_t> near(int x, int y) const;
  static TubeHit meet(const Capsule& capsule, const PictureRay& ray);
  static void meet_ball(const Vec3& centre, double radius, const PictureRay& ray, TubeHit& hit);

  std::vector<Capsule> capsules_;
  IndexLists capsules_of_tile_;
  int tiles_across_ = 0;
  Vec3 sight_;  ///< Unit.
};

}  // namespace vantage
