// SPDX-License-Identifier: MIT
#include "vantage/visibility/face_visibility.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include <Eigen/Geometry>

#include "vantage/core/error.h"
#include "vantage/mesh/measures.h"

#include "visibility/sight.h"

namespace vantage {
namespace {

// A piece below this share of the area of an equilateral one of the wanted size is not cut again,
// however long: it bounds the number of pieces by area, and a fan of needles is still sampled in
// proportion to its area. [ours]
constexpr double kLeastArea = 1.0 / 4.0;
// Pieces grow when the surface is so folded that more than this many would be needed. [ours]
constexpr double kMaxPieces = 4e6;

/// A piece of a face, by the barycentric coordinates of its corners.
using Piece = std::array<Vec3, 3>;

/// Cuts a face across the longest side until its pieces are small.
class Cutter {
 public:
  Cutter(double longest, double least_area) : longest_(longest), least_area_(least_area) {}

  /// Calls take(centroid, area) with the pieces of the triangle: their centroids in barycentric
  /// coordinates, and their areas in units of the corners.
  template <class Take>
  void cut(const std::array<Vec3, 3>& corners, double area, const Take& take) {
    stack_.assign(1, {{Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()}, area});
    while (!stack_.empty()) {
      const auto [piece, size] = stack_.back();
      stack_.pop_back();
      const std::size_t side = longest_side(corners, piece);
      if (size <= least_area_ || length(corners, piece, side) <= longest_) {
        take(Vec3((piece[0] + piece[1] + piece[2]) / 3.0), size);
        continue;
      }
      const Vec3 middle = 0.5 * (piece[side] + piece[(side + 1) % 3]);
      Piece first = piece;
      Piece second = piece;
      first[side] = middle;
      second[(side + 1) % 3] = middle;
      stack_.push_back({first, 0.5 * size});
      stack_.push_back({second, 0.5 * size});
    }
  }

 private:
  static Vec3 place(const std::array<Vec3, 3>& corners, const Vec3& weights) {
    return weights.x() * corners[0] + weights.y() * corners[1] + weights.z() * corners[2];
  }

  static double length(const std::array<Vec3, 3>& corners, const Piece& piece, std::size_t side) {
    return (place(corners, piece[side]) - place(corners, piece[(side + 1) % 3])).norm();
  }

  static std::size_t longest_side(const std::array<Vec3, 3>& corners, const Piece& piece) {
    std::size_t longest = 0;
    for (const std::size_t side : {std::size_t{1}, std::size_t{2}}) {
      if (length(corners, piece, side) > length(corners, piece, longest)) {
        longest = side;
      }
    }
    return longest;
  }

  struct Part {
    Piece piece{};
    double area = 0.0;
  };

  double longest_;
  double least_area_;
  std::vector<Part> stack_{};
};

}  // namespace

struct FaceVisibility::Samples {
  Samples(const TriMesh& mesh, std::span<const FaceSides> sides)
      : sight(prepare_surface(mesh, sides)) {}

  Sight sight;
  std::vector<Triangle> triangles{};   // of the mesh
  Sphere sphere{};                     // of the mesh
  std::vector<Vec3> places{};          // in the surface's frame, by face of the surface
  FloatPoints rounded{};               // the same
  std::vector<std::uint32_t> owner{};  // face of the surface
  std::vector<Vec3> weights{};         // barycentric, in the corners of the mesh's face
  std::vector<double> areas{};         // model units squared
  double total_area = 0.0;

  /// Cuts every face of the surface into pieces.
  void cut(double spacing) {
    const Surface& surface = sight.surface();
    const double unit = surface.frame.scale;
    for (const double twice : surface.twice_areas) {
      total_area += 0.5 * twice / (unit * unit);
    }
    // About 6 pieces a squared side.
    const double least_side = std::sqrt(6.0 * total_area / kMaxPieces);
    const double longest = unit * std::max(spacing * sphere.diameter, least_side);
    Cutter cutter(longest, kLeastArea * 0.25 * std::sqrt(3.0) * longest * longest);
    for (std::uint32_t f = 0; f < surface.faces.size(); ++f) {
      const auto& [a, b, c] = surface.faces[f];
      const std::array<Vec3, 3> corners{surface.sites[a], surface.sites[b], surface.sites[c]};
      cutter.cut(corners, 0.5 * surface.twice_areas[f], [&](const Vec3& w, double area) {
        places.emplace_back(w.x() * corners[0] + w.y() * corners[1] + w.z() * corners[2]);
        owner.push_back(f);
        weights.push_back(w);
        areas.push_back(area / (unit * unit));
      });
    }
    rounded = rounded_points(places);
  }

  [[nodiscard]] std::vector<std::uint8_t> seen(const Viewpoint& local, const RunContext& run) {
    return sight.seen_points({places, &rounded, owner}, local, run);
  }

  /// Projected area over area, at a sample. \param towards unit vector to the eye from the centre.
  [[nodiscard]] double shrink(std::size_t sample, const Viewpoint& local, const Vec3& centre,
                              const Vec3& towards) const {
    const Surface& surface = sight.surface();
    const std::uint32_t f = owner[sample];
    const Vec3 normal = surface.area_vectors[f] / surface.twice_areas[f];
    if (local.projection == Projection::Orthographic) {
      return std::abs(normal.dot(towards));
    }
    const Vec3 sight_line = local.position - places[sample];
    const double depth = sight_line.dot(towards);
    const double plane = (local.position - centre).dot(towards);
    return depth > 0.0 ? std::abs(normal.dot(sight_line)) * plane * plane / (depth * depth * depth)
                       : 0.0;
  }
};

FaceVisibility::FaceVisibility(const TriMesh& mesh, std::vector<FaceSides> sides, double spacing)
    : samples_(std::make_unique<Samples>(mesh, sides)) {
  if (!(spacing > 0.0 && spacing <= 1.0)) {
    throw InvalidInput("the spacing of samples must be above 0 and at most 1");
  }
  samples_->triangles = mesh.triangles;
  samples_->sphere = enclosing_sphere(referenced_points(mesh));
  samples_->cut(spacing);
}

FaceVisibility::~FaceVisibility() = default;
FaceVisibility::FaceVisibility(FaceVisibility&&) noexcept = default;
FaceVisibility& FaceVisibility::operator=(FaceVisibility&&) noexcept = default;

double FaceVisibility::total_area() const {
  return samples_->total_area;
}

std::size_t FaceVisibility::sample_count() const {
  return samples_->places.size();
}

std::vector<SeenFace> FaceVisibility::seen_faces(const Viewpoint& eye,
                                                 const RunContext& run) const {
  return seen_surface(eye, run).faces;
}

SeenSurface FaceVisibility::seen_surface(const Viewpoint& eye, const RunContext& run) const {
  const Surface& surface = samples_->sight.surface();
  const Viewpoint local = eye_in_frame(eye, surface.frame);
  const Vec3 centre = surface.frame.to_frame(samples_->sphere.centre);
  const Vec3 towards = local.projection == Projection::Perspective
                           ? Vec3((local.position - centre).normalized())
                           : local.position;
  const double diameter = samples_->sphere.diameter * surface.frame.scale;
  SeenSurface result;
  result.samples = samples_->seen(local, run);
  std::vector<SeenFace>& faces = result.faces;
  std::uint32_t last = Surface::kNoSite;
  for (std::size_t i = 0; i < result.samples.size(); ++i) {
    if (result.samples[i] == 0) {
      continue;
    }
    if (samples_->owner[i] != last) {
      last = samples_->owner[i];
      faces.push_back({.face = surface.face_of_mesh[last]});
    }
    const double area = samples_->areas[i] * samples_->shrink(i, local, centre, towards);
    faces.back().visible_area += samples_->areas[i];
    faces.back().projected_area += area;
    const double depth =
        std::clamp(0.5 - (samples_->places[i] - centre).dot(towards) / diameter, 0.0, 1.0);
    constexpr auto kBins = static_cast<double>(SeenSurface::kDepthBins);
    result.depths[static_cast<std::size_t>(std::min(depth * kBins, kBins - 1.0))] += area;
    result.deepest = std::max(result.deepest, depth);
  }
  // Into the mesh's order; quicker than sorting, as about half of all faces are seen.
  constexpr std::uint32_t kUnseen = ~std::uint32_t{0};
  std::vector<std::uint32_t> place(samples_->triangles.size(), kUnseen);
  for (std::uint32_t k = 0; k < faces.size(); ++k) {
    place[faces[k].face] = k;
  }
  std::vector<SeenFace> ordered;
  ordered.reserve(faces.size());
  for (const std::uint32_t k : place) {
    if (k != kUnseen) {
      ordered.push_back(faces[k]);
    }
  }
  faces = std::move(ordered);
  return result;
}

std::vector<double> FaceVisibility::integrals(std::span<const double> of_vertex) const {
  std::vector<double> result;
  result.reserve(sample_count());
  for (std::size_t i = 0; i < sample_count(); ++i) {
    const auto& [a, b, c] =
        samples_->triangles[samples_->sight.surface().face_of_mesh[samples_->owner[i]]];
    const Vec3& w = samples_->weights[i];
    result.push_back(samples_->areas[i] *
                     (w.x() * of_vertex[a] + w.y() * of_vertex[b] + w.z() * of_vertex[c]));
  }
  return result;
}

double FaceVisibility::visible_sum(std::span<const double> of_sample, const Viewpoint& eye,
                                   const RunContext& run) const {
  const Viewpoint local = eye_in_frame(eye, samples_->sight.surface().frame);
  const std::vector<std::uint8_t> seen = samples_->seen(local, run);
  double sum = 0.0;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    sum += seen[i] != 0 ? of_sample[i] : 0.0;
  }
  return sum;
}

}  // namespace vantage
