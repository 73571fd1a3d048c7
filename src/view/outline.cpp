// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

#include <Eigen/Geometry>

#include "vantage/core/error.h"
#include "vantage/mesh/topology.h"
#include "vantage/view/measure.h"

#include "core/cross.h"
#include "core/shannon.h"
#include "core/unit_direction.h"
#include "mesh/triangle_corners.h"
#include "view/outline_sweep.h"
#include "view/turning.h"

namespace vantage {
namespace {

// Bins of turning angles: odd, so that straight on falls into the middle of one. [Page 2003]
constexpr std::size_t kTurningBins = 9;
// An eye this much nearer than the sphere's radius is inside, over the radius.
constexpr double kInside = 1e-6;
// What lies outside the square around the disc is left out; only an eye within the sphere meets it.
constexpr double kReach = 0.5;
constexpr std::uint32_t kNone = ~std::uint32_t{0};

/// Adds an edge, cut where it leaves the square and what is outside moved to its border: a shape
/// that reaches out ends there.
void add_clipped(const LayerEdge& edge, std::vector<LayerEdge>& edges) {
  const auto is_out = [](const PicturePoint& p) { return p.cwiseAbs().maxCoeff() > kReach; };
  if (!is_out(edge.from) && !is_out(edge.to)) {
    edges.push_back(edge);
    return;
  }
  const PicturePoint way = edge.to - edge.from;
  std::array<double, 6> cuts{0.0, 1.0, 1.0, 1.0, 1.0, 1.0};
  std::size_t count = 1;
  for (const Eigen::Index axis : {0, 1}) {
    for (const double border : {-kReach, kReach}) {
      const double t = (border - edge.from[axis]) / way[axis];
      if (t > 0.0 && t < 1.0) {
        cuts[count++] = t;
      }
    }
  }
  std::sort(cuts.begin(), cuts.end());
  const auto place = [&](double t) {
    const PicturePoint p = t < 1.0 ? PicturePoint(edge.from + t * way) : edge.to;
    return PicturePoint(p.cwiseMax(-kReach).cwiseMin(kReach));
  };
  for (std::size_t k = 0; k < count; ++k) {
    edges.push_back({place(cuts[k]), place(cuts[k + 1]), edge.layers});
  }
}

double loop_length(const std::vector<PicturePoint>& loop) {
  double length = 0.0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    length += (loop[(i + 1) % loop.size()] - loop[i]).norm();
  }
  return length;
}

/// `count` points at equal distances along the loop.
std::vector<PicturePoint> resampled(const std::vector<PicturePoint>& loop, double length,
                                    std::size_t count) {
  std::vector<PicturePoint> points;
  points.reserve(count);
  const double distance = length / static_cast<double>(count);
  double passed = 0.0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const PicturePoint way = loop[(i + 1) % loop.size()] - loop[i];
    const double step = way.norm();
    while (step > 0.0 && points.size() < count) {
      const double wanted = distance * static_cast<double>(points.size());
      if (wanted > passed + step) {
        break;
      }
      points.emplace_back(loop[i] + way * std::max(0.0, (wanted - passed) / step));
    }
    passed += step;
  }
  while (points.size() < count) {  // rounding at the very end
    points.push_back(loop.back());
  }
  return points;
}

using TurningBins = std::array<double, kTurningBins>;

/// Counts an angle in its bin. Within a quarter of a bin of the border to the next it counts in
/// both, in proportion: it must not jump from one to the other.
void count_turning(double angle, TurningBins& bins) {
  const double place = (angle / (2.0 * std::numbers::pi) + 1.5) * kTurningBins - 0.5;
  const double low = std::floor(place);
  const double share = std::clamp(2.0 * (place - low) - 0.5, 0.0, 1.0);
  const auto bin = static_cast<std::size_t>(low);
  bins[bin % kTurningBins] += 1.0 - share;
  bins[(bin + 1) % kTurningBins] += share;
}

/// Adds the turning angles between the chords before and after each of the points, which are a
/// `stride` apart.
void add_turning(const std::vector<PicturePoint>& points, std::size_t stride, TurningBins& bins,
                 OutlineMeasures& measures) {
  const std::size_t count = points.size();
  std::vector<double> sine(count);
  std::vector<double> cosine(count);
  for (std::size_t i = 0; i < count; ++i) {
    const PicturePoint before = points[i] - points[i < stride ? i + count - stride : i - stride];
    const PicturePoint after =
        points[i + stride < count ? i + stride : i + stride - count] - points[i];
    sine[i] = cross(before, after);
    cosine[i] = before.dot(after);
  }
  std::vector<double> angles(count);
  angles_of(sine, cosine, angles);
  for (const double angle : angles) {
    count_turning(angle, bins);
    measures.curvature += std::abs(angle);
    measures.curvature_extrema += angle * angle;
  }
}

}  // namespace

SilhouetteDisc silhouette_disc(const Sphere& sphere, const Viewpoint& eye) {
  if (eye.projection == Projection::Orthographic) {
    return {unit_direction(eye.position).normalized(), sphere.diameter};
  }
  const Vec3 to_eye = eye.position - sphere.centre;
  const double distance = to_eye.norm();
  const double radius = 0.5 * sphere.diameter;
  SilhouetteDisc disc{distance > 0.0 ? Vec3(to_eye / distance) : Vec3::UnitZ(), sphere.diameter};
  if (distance > radius * (1.0 + kInside)) {
    const double sine = radius / distance;
    disc.diameter /= std::sqrt(1.0 - sine * sine);
  }
  return disc;
}

OutlineMeasures measure_outline(const Outline& outline, int phases) {
  OutlineMeasures measures;
  TurningBins bins{};
  double places = 0.0;
  const auto stride = static_cast<std::size_t>(std::max(1, phases));
  for (const auto& loop : outline) {
    const double length = loop_length(loop);
    measures.length += length;
    const auto count = static_cast<std::size_t>(std::lround(length * kTurningSteps));
    if (count >= 3) {
      add_turning(resampled(loop, length, count * stride), stride, bins, measures);
      places += static_cast<double>(count * stride);
    }
  }
  if (places > 0.0) {
    measures.curvature /= places;
    measures.curvature_extrema /= places;
    measures.turning_entropy = histogram_entropy(bins);
  }
  return measures;
}

OutlineTracer::OutlineTracer(const TriMesh& mesh, std::span<const FaceSides> sides,
                             const Sphere& sphere)
    : mesh_(&mesh), sphere_(sphere) {
  const Components components = connected_components(mesh);
  if (!(sphere.diameter > 0.0) || (sides.size() != 1 && sides.size() != components.count)) {
    throw InvalidInput("an outline needs an extent, and one rule a component");
  }
  two_sided_.reserve(mesh.triangles.size());
  for (const Triangle& face : mesh.triangles) {
    const FaceSides side = sides.size() == 1 ? sides[0] : sides[components.of_vertex[face[0]]];
    two_sided_.push_back(side == FaceSides::Both ? 1 : 0);
  }
  EdgeTable table = build_edge_table(mesh);
  edges_ = std::move(table.edges);
  faces_of_edge_ = std::move(table.faces_of_edge);
  follows_.reserve(faces_of_edge_.values.size());
  beside_.assign(edges_.size(), {kNone, kNone});
  for (std::size_t e = 0; e < edges_.size(); ++e) {
    const auto faces = faces_of_edge_[e];
    for (const std::uint32_t f : faces) {
      const bool follows = runs_from(mesh.triangles[f], edges_[e][0], edges_[e][1]);
      follows_.push_back(follows ? std::int8_t{1} : std::int8_t{-1});
    }
    if (faces.size() == 2 && follows_.end()[-1] != follows_.end()[-2]) {
      const std::size_t first = follows_.end()[-2] > 0 ? 0 : 1;
      beside_[e] = {faces[first], faces[1 - first]};
    }
  }
}

std::vector<PicturePoint> OutlineTracer::places(const Viewpoint& eye,
                                                std::vector<std::uint8_t>& ahead) const {
  const SilhouetteDisc disc = silhouette_disc(sphere_, eye);
  const Vec3 right = disc.towards.unitOrthogonal() / disc.diameter;
  const Vec3 up = disc.towards.cross(right);
  const double distance = (eye.position - sphere_.centre).norm();
  std::vector<PicturePoint> places;
  places.reserve(mesh_->positions.size());
  for (std::size_t v = 0; v < mesh_->positions.size(); ++v) {
    const Vec3 p = mesh_->positions[v] - sphere_.centre;
    double shrink = 1.0;
    if (eye.projection == Projection::Perspective) {
      const double depth = distance - p.dot(disc.towards);
      ahead[v] = depth > kInside * sphere_.diameter ? 1 : 0;
      shrink = ahead[v] != 0 ? distance / depth : 0.0;
    }
    places.emplace_back(shrink * p.dot(right), shrink * p.dot(up));
  }
  return places;
}

Outline OutlineTracer::trace(const Viewpoint& eye) const {
  std::vector<std::uint8_t> ahead(mesh_->positions.size(), 1);
  const std::vector<PicturePoint> place = places(eye, ahead);
  // Layers that each face adds on the left of its sides: 1, -1 if it is seen from its back, or
  // none.
  std::vector<std::int8_t> layer(mesh_->triangles.size(), 0);
  for (std::size_t f = 0; f < layer.size(); ++f) {
    const auto& [a, b, c] = mesh_->triangles[f];
    const double twice = cross(place[b] - place[a], place[c] - place[a]);
    const bool is_drawn = (ahead[a] & ahead[b] & ahead[c]) != 0;
    const int back = two_sided_[f] != 0 && twice < 0.0 ? -1 : 0;
    layer[f] = static_cast<std::int8_t>(is_drawn ? (twice > 0.0 ? 1 : back) : 0);
  }
  std::vector<LayerEdge> edges;
  for (std::size_t e = 0; e < edges_.size(); ++e) {
    if (const auto [left, right] = beside_[e]; left != kNone) {
      if (layer[left] != layer[right]) {
        add_clipped({place[edges_[e][0]], place[edges_[e][1]], layer[left] - layer[right]}, edges);
      }
      continue;
    }
    int layers = 0;
    for (std::uint32_t k = faces_of_edge_.offsets[e]; k < faces_of_edge_.offsets[e + 1]; ++k) {
      layers += follows_[k] * layer[faces_of_edge_.values[k]];
    }
    if (layers != 0) {
      add_clipped({place[edges_[e][0]], place[edges_[e][1]], layers}, edges);
    }
  }
  return boundary_of_layers(edges);
}

}  // namespace vantage
