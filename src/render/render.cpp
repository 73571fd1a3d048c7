// SPDX-License-Identifier: MIT
#include "vantage/render/render.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "vantage/core/error.h"
#include "vantage/core/random.h"
#include "vantage/mesh/measures.h"

#include "core/parallel.h"
#include "render/corner_normals.h"
#include "render/picture_rays.h"
#include "render/shading.h"
#include "render/srgb.h"
#include "render/tubes.h"
#include "spatial/ray_scene.h"

namespace vantage {
namespace {

/// Edges that bend by less than the first are smooth, by more than the second crisp, between them
/// something of both (ours): rounded fillets of CAD parts, rarely split finer than 12 to the full
/// turn, stay smooth and their chamfers sharp, and bends of scans do not fray into teeth.
constexpr double kSmoothRad = 30.0 * std::numbers::pi / 180.0;
constexpr double kCreaseRad = 50.0 * std::numbers::pi / 180.0;
/// Half-width of the tent filter, px. It blurs hardly more than a box as wide as the pixel, and
/// leaves edges without steps.
constexpr double kFilterPx = 0.75;
/// Occlusion looks this far, over the scene's radius: what is further darkens no crevice.
constexpr double kOcclusionReach = 0.6;
/// Occlusion rays start this far off the surface, over the scene's radius: above float rounding
/// (1e-7), below what a pixel shows.
constexpr double kOcclusionOffset = 1e-4;
/// Least cosine between a shading normal and the viewer; interpolated normals may lean away.
constexpr double kLeastFacing = 0.02;
constexpr int kMaxSidePx = 16384;
/// Rows between two reports of progress: fine enough to stop within a second.
constexpr int kBandPx = 64;

/// Light of one sample, multiplied by its opacity.
struct Light {
  Vec3 colour = Vec3::Zero();
  double alpha = 0.0;

  /// Puts more light behind what is there.
  void behind(const Vec3& other, double opacity) {
    colour += (1.0 - alpha) * opacity * other;
    alpha += (1.0 - alpha) * opacity;
  }
};

/// Places of the samples of a pixel, relative to its centre: a square grid turned so that no two
/// share a row or column, spread by the tent filter. The same for every pixel.
std::vector<std::array<double, 2>> sample_pattern(int samples) {
  const int side = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(samples))));
  const auto tent = [](double u) {
    return kFilterPx * (u < 0.5 ? std::sqrt(2.0 * u) - 1.0 : 1.0 - std::sqrt(2.0 - 2.0 * u));
  };
  std::vector<std::array<double, 2>> pattern;
  for (int j = 0; j < side; ++j) {
    for (int i = 0; i < side; ++i) {
      const double u = (i + (j + 0.5) / side) / side;
      const double v = (j + (side - i - 0.5) / side) / side;
      pattern.push_back({tent(u), tent(v)});
    }
  }
  return pattern;
}

/// Everything to be drawn, in one unit frame.
class Scene {
 public:
  Scene(const TriMesh& mesh, const Camera& camera, std::span<const Rgb8> vertex_colours,
        const TubeOverlay& overlay, const RenderOptions& options, const RunContext& run);

  /// The four bytes of a pixel.
  [[nodiscard]] std::array<std::uint8_t, 4> pixel(int x, int y) const;

 private:
  [[nodiscard]] Light sample(const PictureRay& ray, int x, int y, std::size_t index,
                             const std::array<double, 2>& shift) const;
  [[nodiscard]] SurfacePoint surface_point(const PictureRay& ray, const RayHit& hit,
                                           std::size_t index,
                                           const std::array<double, 2>& shift) const;
  [[nodiscard]] double openness(const Vec3& position, const Vec3& normal, const Vec3& face_normal,
                                std::size_t index, const std::array<double, 2>& shift) const;
  [[nodiscard]] Vec3 to_camera(const Vec3& vector) const;
  [[nodiscard]] Vec3 albedo(const RayHit& hit) const;

  RenderOptions options_;
  TriMesh mesh_;
  std::vector<std::array<Vec3f, 3>> normals_;
  std::vector<Vec3f> colour_of_vertex_;
  Vec3 colour_;
  double reach_ = 1.0;
  std::vector<std::array<double, 2>> pattern_;
  std::optional<RayScene> surface_;
  std::optional<PictureRays> rays_;
  std::optional<Tubes> tubes_;
  Vec3 tube_colour_;
};

/// Largest distance from the frame's origin of anything drawn.
double scene_reach(const TriMesh& mesh, const CurveGraph& graph, double tube_radius) {
  double squared = 0.0;
  for (const Triangle& triangle : mesh.triangles) {
    for (const std::uint32_t v : triangle) {
      squared = std::max(squared, mesh.positions[v].squaredNorm());
    }
  }
  double reach = std::sqrt(squared);
  for (const Vec3& node : graph.nodes) {
    reach = std::max(reach, node.norm() + kJointThickness * tube_radius);
  }
  return reach > 0.0 ? reach : 1.0;
}

Scene::Scene(const TriMesh& mesh, const Camera& camera, std::span<const Rgb8> vertex_colours,
             const TubeOverlay& overlay, const RenderOptions& options, const RunContext& run)
    : options_(options),
      mesh_(mesh),
      colour_(linear_of_srgb(options.colour)),
      pattern_(sample_pattern(options.samples)),
      tube_colour_(linear_of_srgb(overlay.colour)) {
  CurveGraph graph = overlay.graph == nullptr ? CurveGraph{} : *overlay.graph;
  std::vector<Vec3> points = referenced_points(mesh);
  points.insert(points.end(), graph.nodes.begin(), graph.nodes.end());
  const UnitFrame frame = unit_frame(points);
  for (Vec3& position : mesh_.positions) {
    position = frame.to_frame(position);
  }
  for (Vec3& node : graph.nodes) {
    node = frame.to_frame(node);
  }
  const double tube_radius = overlay.radius * frame.scale;
  reach_ = scene_reach(mesh_, graph, tube_radius);
  rays_.emplace(camera, frame, reach_, options.width, options.height);
  if (overlay.graph != nullptr) {
    tubes_.emplace(graph, tube_radius, *rays_, options.width, options.height);
  }
  for (const Rgb8& colour : vertex_colours) {
    colour_of_vertex_.emplace_back(linear_of_srgb(colour).cast<float>());
  }
  normals_ = corner_normals(mesh_, {kSmoothRad, kCreaseRad}, run);
  run.check();
  surface_.emplace(mesh_);
}

Vec3 Scene::to_camera(const Vec3& vector) const {
  return {vector.dot(rays_->right()), vector.dot(rays_->up()), vector.dot(rays_->back())};
}

Vec3 Scene::albedo(const RayHit& hit) const {
  if (colour_of_vertex_.empty()) {
    return colour_;
  }
  const Triangle& t = mesh_.triangles[hit.face];
  const Vec3f colour = (1.0F - hit.u - hit.v) * colour_of_vertex_[t[0]] +
                       hit.u * colour_of_vertex_[t[1]] + hit.v * colour_of_vertex_[t[2]];
  return colour.cast<double>().cwiseMax(0.0).cwiseMin(1.0);
}

/// The normal turned until it faces the viewer at least a little.
Vec3 facing_normal(const Vec3& normal, const Vec3& to_viewer) {
  const double cosine = normal.dot(to_viewer);
  if (cosine >= kLeastFacing) {
    return normal;
  }
  return (normal + (kLeastFacing - cosine) * to_viewer).normalized();
}

SurfacePoint Scene::surface_point(const PictureRay& ray, const RayHit& hit, std::size_t index,
                                  const std::array<double, 2>& shift) const {
  const Vec3 to_viewer = -ray.direction;
  const Vec3 area = area_vector(mesh_, mesh_.triangles[hit.face]);
  const double area_norm = area.norm();
  Vec3 face_normal = area_norm > 0.0 ? Vec3(area / area_norm) : to_viewer;
  const std::array<Vec3f, 3>& corners = normals_[hit.face];
  const Vec3f mixed = (1.0F - hit.u - hit.v) * corners[0] + hit.u * corners[1] + hit.v * corners[2];
  const float length = mixed.norm();
  Vec3 normal = length > 0.0F ? Vec3((mixed / length).cast<double>()) : face_normal;
  if (face_normal.dot(to_viewer) < 0.0) {
    face_normal = -face_normal;
    normal = -normal;
  }
  normal = facing_normal(normal, to_viewer);
  SurfacePoint point;
  point.albedo = albedo(hit);
  point.normal = to_camera(normal);
  point.to_viewer = to_camera(to_viewer);
  if (options_.ambient_rays > 0) {
    const Vec3 position = ray.origin + static_cast<double>(hit.t) * ray.direction;
    point.openness = openness(position, normal, face_normal, index, shift);
  }
  return point;
}

/// The radical inverse of van der Corput in base 2.
double radical_inverse(std::uint32_t bits) {
  bits = (bits << 16U) | (bits >> 16U);
  bits = ((bits & 0x00ff00ffU) << 8U) | ((bits & 0xff00ff00U) >> 8U);
  bits = ((bits & 0x0f0f0f0fU) << 4U) | ((bits & 0xf0f0f0f0U) >> 4U);
  bits = ((bits & 0x33333333U) << 2U) | ((bits & 0xccccccccU) >> 2U);
  bits = ((bits & 0x55555555U) << 1U) | ((bits & 0xaaaaaaaaU) >> 1U);
  return static_cast<double>(bits) * 0x1p-32;
}

/// Unblocked part of the cosine-weighted hemisphere. All occlusion rays of a pixel together are one
/// Hammersley set, shifted at random per pixel; each sample takes every so many of them.
double Scene::openness(const Vec3& position, const Vec3& normal, const Vec3& face_normal,
                       std::size_t index, const std::array<double, 2>& shift) const {
  const auto rays = static_cast<std::size_t>(options_.ambient_rays);
  const double total = static_cast<double>(rays * pattern_.size());
  const Vec3 origin = position + kOcclusionOffset * reach_ * face_normal;
  const Vec3 tangent = normal.unitOrthogonal();
  const Vec3 bitangent = normal.cross(tangent);
  std::size_t open = 0;
  for (std::size_t r = 0; r < rays; ++r) {
    const std::size_t k = index + pattern_.size() * r;
    const double u = std::fmod((static_cast<double>(k) + 0.5) / total + shift[0], 1.0);
    const double v = std::fmod(radical_inverse(static_cast<std::uint32_t>(k)) + shift[1], 1.0);
    const double radius = std::sqrt(u);
    const double angle = 2.0 * std::numbers::pi * v;
    Vec3 direction = radius * std::cos(angle) * tangent + radius * std::sin(angle) * bitangent +
                     std::sqrt(1.0 - u) * normal;
    // Smooth normals see below the flat face they stand on; there the face itself would block.
    const double above = direction.dot(face_normal);
    if (above < 0.0) {
      direction -= 2.0 * above * face_normal;
    }
    if (!surface_->occluded(origin.cast<float>(), direction.cast<float>(), 0.0F,
                            static_cast<float>(kOcclusionReach * reach_))) {
      ++open;
    }
  }
  return static_cast<double>(open) / static_cast<double>(rays);
}

Light Scene::sample(const PictureRay& ray, int x, int y, std::size_t index,
                    const std::array<double, 2>& shift) const {
  Light light;
  if (!ray.can_hit) {
    return light;
  }
  const TubeHit tube = tubes_ ? tubes_->closest_hit(ray, x, y) : TubeHit{};
  const bool has_tube = std::isfinite(tube.t);
  const RayHit hit = surface_->closest_hit(ray.origin.cast<float>(), ray.direction.cast<float>());
  if (hit && static_cast<double>(hit.t) <= tube.t) {
    const SurfacePoint point = surface_point(ray, hit, index, shift);
    light.behind(shade_surface(point), tubes_ ? translucent_opacity(point, has_tube) : 1.0);
  }
  if (has_tube) {
    SurfacePoint point;
    point.albedo = tube_colour_;
    point.normal = to_camera(tube.normal);
    point.to_viewer = to_camera(-ray.direction);
    light.behind(shade_tube(point), 1.0);
  }
  return light;
}

std::array<std::uint8_t, 4> Scene::pixel(int x, int y) const {
  const auto number = static_cast<std::uint64_t>(y) * static_cast<std::uint64_t>(options_.width) +
                      static_cast<std::uint64_t>(x);
  Pcg32 random(number);
  const double first = random.uniform();
  const std::array<double, 2> shift{first, random.uniform()};
  Light sum;
  for (std::size_t index = 0; index < pattern_.size(); ++index) {
    const PictureRay ray = rays_->ray(x + 0.5 + pattern_[index][0], y + 0.5 + pattern_[index][1]);
    const Light light = sample(ray, x, y, index, shift);
    sum.colour += light.colour;
    sum.alpha += light.alpha;
  }
  const double count = static_cast<double>(pattern_.size());
  sum.colour /= count;
  sum.alpha /= count;
  if (options_.background) {
    sum.behind(linear_of_srgb(*options_.background), 1.0);
  }
  const auto alpha = static_cast<std::uint8_t>(std::lround(255.0 * std::min(sum.alpha, 1.0)));
  if (alpha == 0) {
    return {0, 0, 0, 0};
  }
  // The mean of light times opacity over the mean opacity: edges keep the surface's own colour.
  const Rgb8 colour = srgb_of_linear(Vec3(sum.colour / sum.alpha));
  return {colour[0], colour[1], colour[2], alpha};
}

void check_input(const TriMesh& mesh, std::span<const Rgb8> vertex_colours,
                 const TubeOverlay& overlay, const RenderOptions& options) {
  check_fields(options, kRenderFields);
  if (options.width < 1 || options.height < 1 || options.width > kMaxSidePx ||
      options.height > kMaxSidePx) {
    throw InvalidInput("a picture's width and height must be between 1 and " +
                       std::to_string(kMaxSidePx) + " pixels");
  }
  if (mesh.positions.empty()) {
    throw InvalidInput("there is nothing to draw: the model is empty");
  }
  if (mesh.triangles.empty()) {
    throw InvalidInput(
        "there is no surface to draw: the model has points but no faces; make a surface from the "
        "points first, for example by Poisson reconstruction in MeshLab");
  }
  if (!vertex_colours.empty() && vertex_colours.size() != mesh.positions.size()) {
    throw InvalidInput("there are " + std::to_string(vertex_colours.size()) + " colours for " +
                       std::to_string(mesh.positions.size()) + " vertices");
  }
  if (overlay.graph != nullptr && !(overlay.radius > 0.0 && std::isfinite(overlay.radius))) {
    throw InvalidInput("the radius of overlaid tubes must be above 0");
  }
}

}  // namespace

void set_quality(RenderOptions& options, Quality quality) {
  constexpr std::array<std::array<int, 2>, 3> kRays{{{9, 2}, {16, 2}, {64, 4}}};
  options.samples = kRays[static_cast<std::size_t>(quality)][0];
  options.ambient_rays = kRays[static_cast<std::size_t>(quality)][1];
}

Image render(const TriMesh& mesh, const Camera& camera, std::span<const Rgb8> vertex_colours,
             const TubeOverlay& overlay, const RenderOptions& options, const RunContext& run) {
  check_input(mesh, vertex_colours, overlay, options);
  Image image;
  image.width = options.width;
  image.height = options.height;
  const auto width = static_cast<std::size_t>(options.width);
  image.rgba.resize(4 * width * static_cast<std::size_t>(options.height));
  run.advance("render", 0.0);
  with_threads(run, [&] {
    const Scene scene(mesh, camera, vertex_colours, overlay, options, run);
    for (int band = 0; band < options.height; band += kBandPx) {
      run.advance("render", 0.1 + 0.9 * band / options.height);
      const int rows = std::min(kBandPx, options.height - band);
      parallel_for(run, static_cast<std::size_t>(rows), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t row = begin; row < end; ++row) {
          const int y = band + static_cast<int>(row);
          for (int x = 0; x < options.width; ++x) {
            const std::array<std::uint8_t, 4> bytes = scene.pixel(x, y);
            const std::size_t at =
                4 * (static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x));
            std::copy(bytes.begin(), bytes.end(),
                      image.rgba.begin() + static_cast<std::ptrdiff_t>(at));
          }
        }
      });
    }
  });
  run.advance("render", 1.0);
  return image;
}

}  // namespace vantage
