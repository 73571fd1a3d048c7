// SPDX-License-Identifier: MIT
#include "render/scene.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>

#include <Eigen/Geometry>

#include "vantage/mesh/measures.h"

#include "core/parallel.h"
#include "core/srgb.h"
#include "render/corner_normals.h"
#include "render/feature_edges.h"

namespace vantage {
namespace {

constexpr double kRadPerDeg = std::numbers::pi / 180.0;
/// Edges turn from smooth to crisp within so much on either side of the crease angle [ours]: at the
/// default of 40° rounded fillets of CAD parts, rarely split finer than 12 to the full turn, stay
/// smooth and their chamfers sharp, and bends of scans do not fray into teeth.
constexpr double kCreaseSoftnessDeg = 10.0;
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
/// Opacity of the ground where it sees no sky. [ours]
constexpr double kShadowOpacity = 0.72;
/// The shadow fades out over this share of the picture's shorter side at the border. [ours]
constexpr double kShadowFade = 0.07;
/// Width of drawn lines over the picture's shorter side, and the least, px. [ours]
constexpr double kLineShare = 0.0022;
constexpr double kLeastLinePx = 1.1;
/// Outlines are so much wider than lines inside, as draughtsmen have it. [ours]
constexpr double kOutlineFactor = 1.5;
/// Least step in depth that gets a line, over the scene's radius. [ours]
constexpr double kLeastJump = 0.012;
/// Feature lines shorter in all than this, over the scene's radius, are left out. [ours]
constexpr double kLeastFeature = 0.06;
/// Longest piece of a feature line, px: about two tiles, so that few rays ask about it.
constexpr double kPiecePx = 32.0;
/// A sample this far from the plane of its pixel's middle still shows the same patch, px.
constexpr double kSamePatchPx = 2.0;
/// Most samples across a pixel of outlines: enough for 16 steps of coverage.
constexpr int kMostOutlineSamples = 4;
/// Layers of glass and leaves that are looked through. [ours]
constexpr int kMostLayers = 16;
/// What lies behind a layer is looked for so much further, in units of the frame: more than float
/// rounding (1e-7 at distances up to 8).
constexpr float kLayerGap = 1e-5F;
const Vec3 kInk(0.012, 0.014, 0.018);

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

/// Shift of the occlusion rays of a pixel: neighbours differ as much as they can, so that what is
/// left of the noise is too fine to be seen. Radius: the R2 sequence as a dither matrix (Roberts,
/// "The Unreasonable Effectiveness of Quasirandom Sequences", 2018); angle: interleaved gradient
/// noise (Jimenez, "Next Generation Post Processing in Call of Duty", SIGGRAPH 2014).
std::array<double, 2> pixel_shift(int x, int y) {
  const double radius = 0.7548776662466927 * x + 0.5698402909980532 * y;
  const double angle = 52.9829189 * std::fmod(0.06711056 * x + 0.00583715 * y, 1.0);
  return {radius - std::floor(radius), angle - std::floor(angle)};
}

/// Largest distance from the frame's origin of anything drawn. \pre the mesh is in the frame.
double scene_reach(const TriMesh& mesh, std::span<const Paint> paints, const UnitFrame& frame) {
  double squared = 0.0;
  for (const Triangle& triangle : mesh.triangles) {
    for (const std::uint32_t v : triangle) {
      squared = std::max(squared, mesh.positions[v].squaredNorm());
    }
  }
  double reach = std::sqrt(squared);
  for (const Paint& paint : paints) {
    if (paint.overlay.graph != nullptr) {
      const double thickness = kJointThickness * paint.overlay.radius * frame.scale;
      for (const Vec3& node : paint.overlay.graph->nodes) {
        reach = std::max(reach, frame.to_frame(node).norm() + thickness);
      }
    }
  }
  return reach > 0.0 ? reach : 1.0;
}

/// All that may show in the picture.
std::vector<Vec3> drawn_points(const TriMesh& mesh, std::span<const Paint> paints) {
  std::vector<Vec3> points = referenced_points(mesh);
  for (const Paint& paint : paints) {
    if (paint.overlay.graph != nullptr) {
      const std::vector<Vec3>& nodes = paint.overlay.graph->nodes;
      points.insert(points.end(), nodes.begin(), nodes.end());
    }
  }
  return points;
}

/// The normal turned until it faces the viewer at least a little.
Vec3 facing_normal(const Vec3& normal, const Vec3& to_viewer) {
  const double cosine = normal.dot(to_viewer);
  if (cosine >= kLeastFacing) {
    return normal;
  }
  return (normal + (kLeastFacing - cosine) * to_viewer).normalized();
}

Crease crease_of(double crease_deg) {
  return {std::max(0.0, crease_deg - kCreaseSoftnessDeg) * kRadPerDeg,
          (crease_deg + kCreaseSoftnessDeg) * kRadPerDeg};
}

/// How far something at the scene's middle may move for its picture to move by a pixel.
double pixel_size(const Camera& camera, const UnitFrame& frame, int height_px) {
  if (camera.projection == Projection::Orthographic) {
    return camera.height * frame.scale / height_px;
  }
  return 2.0 * std::tan(0.5 * camera.fov_y_deg * kRadPerDeg) * frame.to_frame(camera.eye).norm() /
         height_px;
}

}  // namespace

Scene::Scene(const TriMesh& mesh, const Camera& camera, std::span<const Paint> paints,
             const RenderOptions& options, const RunContext& run)
    : options_(options),
      mesh_(mesh),
      colour_(linear_of_srgb(options.colour)),
      pattern_(sample_pattern(options.samples)) {
  const UnitFrame frame = unit_frame(drawn_points(mesh, paints));
  for (Vec3& position : mesh_.positions) {
    position = frame.to_frame(position);
  }
  const double reach = scene_reach(mesh_, paints, frame);
  // The shadow on the ground lies around the model.
  const double drawn_reach = options.ground ? (1.0 + kOcclusionReach) * reach : reach;
  pixel_ = pixel_size(camera, frame, options.height);
  rays_.emplace(camera, frame, drawn_reach, options.width, options.height);
  for (const Paint& paint : paints) {
    add_coat(paint, frame);
  }
  if (options.crease_deg > 0.0) {
    normals_ = corner_normals(mesh_, crease_of(options.crease_deg), run);
  } else {  // no normals: the faces' own
    normals_.assign(mesh_.triangles.size(), {Vec3f::Zero(), Vec3f::Zero(), Vec3f::Zero()});
  }
  run.check();
  OpacityOfHit opacity;
  const Coat* coat = coats_.front().get();
  if (coat->skin && coat->skin->has_openings()) {
    opacity = [coat](std::uint32_t face, float u, float v) {
      return coat->skin->at(face, u, v).opacity;
    };
  }
  surface_.emplace(mesh_, std::move(opacity));
  mask_.emplace(mesh_, *rays_, pixel_, options.width, options.height);
  std::optional<Floor> floor;
  if (options.ground) {
    ground_.emplace(mesh_, *surface_, options.up.normalized(), kOcclusionReach * reach, run);
    floor = ground_->floor();
  }
  occlusion_.emplace(*surface_, kOcclusionReach * reach, kOcclusionOffset * reach, floor);
  if (options.style == Style::Technical) {
    add_lines(reach, run);
  }
}

void Scene::add_coat(const Paint& paint, const UnitFrame& frame) {
  auto coat = std::make_unique<Coat>();
  for (const Rgb8& colour : paint.vertex_colours) {
    coat->colour_of_vertex.emplace_back(linear_of_srgb(colour).cast<float>());
  }
  if (paint.overlay.graph != nullptr) {
    CurveGraph graph = *paint.overlay.graph;
    for (Vec3& node : graph.nodes) {
      node = frame.to_frame(node);
    }
    coat->tubes.emplace(graph, paint.overlay.radius * frame.scale, *rays_, options_.width,
                        options_.height);
    coat->tube_colour = linear_of_srgb(paint.overlay.colour);
    has_tubes_ = true;
  }
  if (paint.appearance != nullptr && !paint.appearance->materials.empty()) {
    coat->skin.emplace(*paint.appearance, mesh_,
                       pixel_ / std::sqrt(static_cast<double>(options_.samples)));
  }
  coats_.push_back(std::move(coat));
}

void Scene::add_lines(double reach, const RunContext& run) {
  const int shorter = std::min(options_.width, options_.height);
  const double line_px = std::max(kLeastLinePx, kLineShare * shorter);
  const CurveGraph edges = feature_edges(mesh_, std::max(1.0, options_.crease_deg) * kRadPerDeg,
                                         kLeastFeature * reach, kPiecePx * pixel_);
  run.check();
  creases_.emplace(edges, 0.5 * line_px * pixel_, *rays_, options_.width, options_.height, 1.0);
  const int side =
      std::min(kMostOutlineSamples,
               static_cast<int>(std::lround(std::sqrt(static_cast<double>(pattern_.size())))));
  contours_.emplace(*surface_, *rays_, options_.width, side, kOutlineFactor * line_px,
                    kLeastJump * reach);
}

SceneBand Scene::band(int first_row, int rows, const RunContext& run) const {
  SceneBand band;
  band.first_row = first_row;
  if (contours_) {
    band.outlines = contours_->coverage(first_row, rows, run);
  }
  if (options_.ambient_rays > 0) {
    // Rows beside the band take part in the means of its own.
    const int first = std::max(0, first_row - kOpennessRadiusPx);
    const int last = std::min(options_.height, first_row + rows + kOpennessRadiusPx);
    const auto width = static_cast<std::size_t>(options_.width);
    std::vector<SurfaceProbe> probes(static_cast<std::size_t>(last - first) * width);
    parallel_for(
        run, static_cast<std::size_t>(last - first), 1, [&](std::size_t begin, std::size_t end) {
          for (std::size_t i = begin * width; i < end * width; ++i) {
            probes[i] = probe(static_cast<int>(i % width), first + static_cast<int>(i / width));
          }
        });
    smooth_openness(probes, options_.width, pixel_);
    const auto skipped =
        static_cast<std::ptrdiff_t>(static_cast<std::size_t>(first_row - first) * width);
    band.probes.assign(probes.begin() + skipped,
                       probes.begin() + skipped +
                           static_cast<std::ptrdiff_t>(static_cast<std::size_t>(rows) * width));
  }
  return band;
}

RayHit Scene::nearest(const PictureRay& ray, int x, int y) const {
  return ray.can_hit && mask_->may_show(x, y)
             ? surface_->closest_hit(ray.origin.cast<float>(), ray.direction.cast<float>())
             : RayHit{};
}

Vec3 Scene::to_camera(const Vec3& vector) const {
  return {vector.dot(rays_->right()), vector.dot(rays_->up()), vector.dot(rays_->back())};
}

Skin::Shown Scene::shown_at(const Coat& coat, const RayHit& hit) const {
  Skin::Shown shown;
  if (coat.skin) {
    shown = coat.skin->at(hit.face, hit.u, hit.v);
  }
  if (coat.colour_of_vertex.empty()) {
    shown.colour = shown.has_material ? shown.colour : colour_;
    return shown;
  }
  const Triangle& t = mesh_.triangles[hit.face];
  const Vec3f colour = (1.0F - hit.u - hit.v) * coat.colour_of_vertex[t[0]] +
                       hit.u * coat.colour_of_vertex[t[1]] + hit.v * coat.colour_of_vertex[t[2]];
  shown.colour = shown.colour.cwiseProduct(colour.cast<double>().cwiseMax(0.0).cwiseMin(1.0));
  return shown;
}

Scene::Place Scene::place_of(const PictureRay& ray, const RayHit& hit) const {
  const Vec3 to_viewer = -ray.direction;
  const Vec3 area = area_vector(mesh_, mesh_.triangles[hit.face]);
  const double area_norm = area.norm();
  Place place;
  place.position = ray.origin + static_cast<double>(hit.t) * ray.direction;
  place.face_normal = area_norm > 0.0 ? Vec3(area / area_norm) : to_viewer;
  const std::array<Vec3f, 3>& corners = normals_[hit.face];
  const Vec3f mixed = (1.0F - hit.u - hit.v) * corners[0] + hit.u * corners[1] + hit.v * corners[2];
  const float length = mixed.norm();
  place.normal = length > 0.0F ? Vec3((mixed / length).cast<double>()) : place.face_normal;
  if (place.face_normal.dot(to_viewer) < 0.0) {
    place.face_normal = -place.face_normal;
    place.normal = -place.normal;
  }
  place.normal = facing_normal(place.normal, to_viewer);
  return place;
}

std::size_t Scene::band_index(int x, int y, const SceneBand& band) const {
  return static_cast<std::size_t>(y - band.first_row) * static_cast<std::size_t>(options_.width) +
         static_cast<std::size_t>(x);
}

SurfaceProbe Scene::probe(int x, int y) const {
  SurfaceProbe probe;
  const PictureRay ray = rays_->ray(x + 0.5, y + 0.5);
  const RayHit hit = nearest(ray, x, y);
  if (hit) {
    const Place place = place_of(ray, hit);
    const std::size_t rays = static_cast<std::size_t>(options_.ambient_rays) * pattern_.size();
    probe = {.position = place.position,
             .normal = place.normal,
             .openness =
                 occlusion_->openness(place.position, place.normal, place.face_normal,
                                      {.count = rays, .total = rays, .shift = pixel_shift(x, y)}),
             .hit = true};
  }
  return probe;
}

double Scene::openness(const Place& place, int x, int y, std::size_t index,
                       const SceneBand& band) const {
  if (options_.ambient_rays == 0) {
    return 1.0;
  }
  const SurfaceProbe& probe = band.probes[band_index(x, y, band)];
  if (same_patch(probe, place.position, place.normal, kSamePatchPx * pixel_)) {
    return probe.openness;
  }
  // Another part of the surface shows in a corner of the pixel.
  const auto rays = static_cast<std::size_t>(options_.ambient_rays);
  return occlusion_->openness(place.position, place.normal, place.face_normal,
                              {.first = index,
                               .stride = pattern_.size(),
                               .count = rays,
                               .total = rays * pattern_.size(),
                               .shift = pixel_shift(x, y)});
}

double Scene::shadow(const PictureRay& ray, double t, int x, int y) const {
  const double dark = ground_->shadow(ray.origin + t * ray.direction);
  const double border =
      std::min({x + 0.5, y + 0.5, options_.width - x - 0.5, options_.height - y - 0.5});
  const double fade =
      std::clamp(border / (kShadowFade * std::min(options_.width, options_.height)), 0.0, 1.0);
  return kShadowOpacity * dark * fade * fade * (3.0 - 2.0 * fade);
}

SurfacePoint Scene::surface_at(const Sample& sample, const RayHit& hit) const {
  const Place place = place_of(sample.ray, hit);
  SurfacePoint point;
  point.normal = to_camera(place.normal);
  point.to_viewer = to_camera(-sample.ray.direction);
  point.openness = openness(place, sample.x, sample.y, sample.index, *sample.band);
  return point;
}

Light Scene::surface_light(const Coat& coat, Sample& sample, const RayHit& hit,
                           bool before_tube) const {
  const Skin::Shown shown = shown_at(coat, hit);
  if (shown.unlit) {
    return {shown.colour, shown.opacity};
  }
  const bool is_first = hit.t == sample.hit.t;
  if (is_first && !sample.surface) {
    sample.surface = surface_at(sample, hit);
  }
  SurfacePoint point = is_first ? *sample.surface : surface_at(sample, hit);
  point.albedo = shown.colour;
  const Vec3 colour =
      options_.style == Style::Technical ? shade_drawing(point) : shade_surface(point);
  return {colour, shown.opacity * (coat.tubes ? translucent_opacity(point, before_tube) : 1.0)};
}

Light Scene::light_of(const Coat& coat, Sample& sample) const {
  Light light;
  const PictureRay& ray = sample.ray;
  const double hit_t =
      sample.hit ? static_cast<double>(sample.hit.t) : std::numeric_limits<double>::infinity();
  if (std::isfinite(sample.crease_t) && sample.crease_t <= hit_t) {
    light.behind(kInk, 1.0);
    return light;
  }
  const TubeHit tube = coat.tubes ? coat.tubes->closest_hit(ray, sample.x, sample.y) : TubeHit{};
  const bool has_tube = std::isfinite(tube.t);
  RayHit layer = sample.hit;
  for (int count = 0; layer && static_cast<double>(layer.t) <= tube.t && count < kMostLayers;
       ++count) {
    const Light seen = surface_light(coat, sample, layer, has_tube);
    light.behind(seen.colour, seen.alpha);
    if (!coat.skin || !coat.skin->has_openings() || seen.alpha >= 1.0) {
      break;
    }
    layer = surface_->closest_hit(ray.origin.cast<float>(), ray.direction.cast<float>(),
                                  layer.t + kLayerGap);
  }
  if (has_tube) {
    SurfacePoint point;
    point.albedo = coat.tube_colour;
    point.normal = to_camera(tube.normal);
    point.to_viewer = to_camera(-ray.direction);
    light.behind(shade_tube(point), 1.0);
  }
  if (ground_ && light.alpha < 1.0) {
    const double ground_t = ground_->meet(ray);
    if (std::isfinite(ground_t)) {
      light.behind(Vec3::Zero(), shadow(ray, ground_t, sample.x, sample.y));
    }
  }
  return light;
}

Vec3 Scene::background(int y) const {
  if (!options_.background_bottom) {
    return linear_of_srgb(*options_.background);
  }
  // In sRGB, where equal steps look about equal.
  const double share = (y + 0.5) / options_.height;
  Vec3 mixed;
  for (std::size_t c = 0; c < 3; ++c) {
    const double encoded =
        (1.0 - share) * (*options_.background)[c] + share * (*options_.background_bottom)[c];
    mixed[static_cast<Eigen::Index>(c)] = linear_of_encoded(encoded / 255.0);
  }
  return mixed;
}

void Scene::pixel(int x, int y, const SceneBand& band, std::span<Light> lights) const {
  std::fill(lights.begin(), lights.end(), Light{});
  const bool is_empty = !mask_->may_show(x, y) && !has_tubes_ && !creases_ && !ground_;
  for (std::size_t index = 0; index < pattern_.size() && !is_empty; ++index) {
    Sample sample{.x = x, .y = y, .index = index, .band = &band};
    sample.ray = rays_->ray(x + 0.5 + pattern_[index][0], y + 0.5 + pattern_[index][1]);
    if (!sample.ray.can_hit) {
      continue;
    }
    sample.hit = nearest(sample.ray, x, y);
    sample.crease_t = creases_ ? creases_->closest_hit(sample.ray, x, y).t
                               : std::numeric_limits<double>::infinity();
    for (std::size_t c = 0; c < coats_.size(); ++c) {
      const Light light = light_of(*coats_[c], sample);
      lights[c].colour += light.colour;
      lights[c].alpha += light.alpha;
    }
  }
  const double count = static_cast<double>(pattern_.size());
  const double outline = band.outlines.empty() ? 0.0 : band.outlines[band_index(x, y, band)];
  for (Light& sum : lights) {
    sum.colour = outline * kInk + (1.0 - outline) * (sum.colour / count);
    sum.alpha = outline + (1.0 - outline) * (sum.alpha / count);
    if (options_.background) {
      sum.behind(background(y), 1.0);
    }
    // The mean of light times opacity over the mean opacity: edges keep the surface's own colour.
    sum = {sum.alpha > 0.0 ? Vec3(sum.colour / sum.alpha) : Vec3(Vec3::Zero()),
           std::min(sum.alpha, 1.0)};
  }
}

}  // namespace vantage
