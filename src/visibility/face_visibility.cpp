// SPDX-License-Identifier: MIT
#include "vantage/visibility/face_visibility.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Geometry>

#include "vantage/core/error.h"
#include "vantage/mesh/measures.h"

#include "visibility/face_look.h"
#include "visibility/face_samples.h"

namespace vantage {
namespace {

double checked(double spacing) {
  if (!(spacing > 0.0 && spacing <= 1.0)) {
    throw InvalidInput("the spacing of samples must be above 0 and at most 1");
  }
  return spacing;
}

}  // namespace

double FaceVisibility::enough_spacing(const TriMesh& mesh) {
  constexpr double kEnough = 8e4;     // [ours, by measurement]
  constexpr double kPerSquare = 6.0;  // pieces of a squared side, about
  const double side = kSpacing * enclosing_sphere(referenced_points(mesh)).diameter;
  double pieces = 0.0;
  for (const Triangle& face : mesh.triangles) {
    const double area = 0.5 * area_vector(mesh, face).norm();
    pieces += side > 0.0 ? std::max(1.0, kPerSquare * area / (side * side)) : 1.0;
  }
  return kSpacing / std::clamp(std::sqrt(kEnough / std::max(pieces, 1.0)), 1.0, 2.0);
}

FaceVisibility::FaceVisibility(const TriMesh& mesh, std::vector<FaceSides> sides)
    : FaceVisibility(mesh, std::move(sides), enough_spacing(mesh)) {}

FaceVisibility::FaceVisibility(const TriMesh& mesh, std::vector<FaceSides> sides, double spacing)
    : samples_(std::make_unique<FaceSamples>(mesh, sides, checked(spacing))) {}

FaceVisibility::~FaceVisibility() = default;
FaceVisibility::FaceVisibility(FaceVisibility&&) noexcept = default;
FaceVisibility& FaceVisibility::operator=(FaceVisibility&&) noexcept = default;

double FaceVisibility::total_area() const {
  return samples_->total_area();
}

std::size_t FaceVisibility::sample_count() const {
  return samples_->pieces().places.size();
}

std::vector<SeenFace> FaceVisibility::seen_faces(const Viewpoint& eye,
                                                 const RunContext& run) const {
  return seen_surface(eye, run).faces;
}

SeenSurface FaceVisibility::seen_surface(const Viewpoint& eye, const RunContext& run) const {
  return FaceLook(*samples_, eye_in_frame(eye, samples_->surface().frame), run).seen();
}

std::vector<std::uint8_t> FaceVisibility::visible_vertices(const Viewpoint& eye,
                                                           const RunContext& run) const {
  const Surface& surface = samples_->surface();
  Look look(samples_->sight(), eye_in_frame(eye, surface.frame), run);
  return vertices_of_sites(surface, look.seen_sites());
}

std::vector<double> FaceVisibility::integrals(std::span<const double> of_vertex) const {
  const FacePieces& pieces = samples_->pieces();
  std::vector<double> result;
  result.reserve(sample_count());
  for (std::size_t i = 0; i < sample_count(); ++i) {
    const auto& [a, b, c] =
        samples_->triangles()[samples_->surface().face_of_mesh[pieces.owner[i]]];
    const Vec3& w = pieces.weights[i];
    result.push_back(pieces.areas[i] *
                     (w.x() * of_vertex[a] + w.y() * of_vertex[b] + w.z() * of_vertex[c]));
  }
  return result;
}

std::vector<std::uint8_t> FaceVisibility::seen_samples(const Viewpoint& eye,
                                                       const RunContext& run) const {
  Look look(samples_->sight(), eye_in_frame(eye, samples_->surface().frame), run);
  return look.seen_points(samples_->points());
}

double FaceVisibility::visible_sum(std::span<const double> of_sample, const Viewpoint& eye,
                                   const RunContext& run) const {
  const std::vector<std::uint8_t> seen = seen_samples(eye, run);
  double sum = 0.0;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    sum += seen[i] != 0 ? of_sample[i] : 0.0;
  }
  return sum;
}

}  // namespace vantage
