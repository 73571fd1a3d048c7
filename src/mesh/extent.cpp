// SPDX-License-Identifier: MIT
#include "mesh/extent.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "vantage/core/error.h"
#include "vantage/mesh/measures.h"

namespace vantage {
namespace {

double largest_coordinate(const Box& box) {
  return box.low.cwiseAbs().cwiseMax(box.high.cwiseAbs()).maxCoeff();
}

}  // namespace

std::string finite_problem(std::span<const Vec3> points) {
  const auto at = std::find_if(points.begin(), points.end(),
                               [](const Vec3& point) { return !point.allFinite(); });
  return at == points.end() ? std::string()
                            : "vertex " + std::to_string(at - points.begin()) +
                                  " has a coordinate that is infinite or no number";
}

double steps_across(std::span<const Vec3> points) {
  const Box box = bounding_box(points);
  const double largest = largest_coordinate(box);
  const double next = std::nextafter(largest, std::numeric_limits<double>::infinity());
  return box.longest_side() / (next - largest);
}

std::string extent_problem(std::span<const Vec3> points) {
  const Box box = bounding_box(points);
  const double side = box.longest_side();
  if (largest_coordinate(box) > kLargestCoordinate) {
    return "has coordinates beyond 1e60; rescale it";
  }
  if (side > 0.0 && side < kSmallestExtent) {
    return "is less than 1e-60 across, too small to compute with; rescale it";
  }
  if (side > 0.0 && steps_across(points) < kFewestSteps) {
    return "is so far from the origin that its coordinates tell only " +
           std::to_string(static_cast<int>(steps_across(points))) +
           " places apart across it; move it nearer and write it again";
  }
  return {};
}

void check_coordinates(const TriMesh& mesh) {
  if (const std::string problem = finite_problem(mesh.positions); !problem.empty()) {
    throw InvalidInput(problem);
  }
  if (const std::string problem = extent_problem(referenced_points(mesh)); !problem.empty()) {
    throw InvalidInput("the model " + problem);
  }
}

}  // namespace vantage
