// SPDX-License-Identifier: MIT
#include "contraction/component_scaling.h"

#include "vantage/mesh/measures.h"

namespace vantage {
namespace {

constexpr double kSphereSide = 2.0;  // ours: D = 2
constexpr double kBoxSide = 1.6;     // Cao 2010: the longest side of the box

}  // namespace

ComponentScaling::ComponentScaling(const std::vector<Vec3>& points, ContractionScaling kind) {
  if (kind == ContractionScaling::Box) {
    const Box box = bounding_box(points);
    const double side = box.longest_side();
    centre = box.low + 0.5 * box.size();
    factor = side > 0.0 ? kBoxSide / side : 1.0;
  } else {
    const Sphere sphere = enclosing_sphere(points);
    centre = sphere.centre;
    factor = sphere.diameter > 0.0 ? kSphereSide / sphere.diameter : 1.0;
  }
}

}  // namespace vantage
