// SPDX-License-Identifier: MIT
#include "render/scene.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>

#include <Eigen/Geometry>

#include "core/parallel.h"
#include "core/srgb.h"
#include "render/feature_edges.h"
#include "render/sample_pattern.h"

namespace vantage {
namespace {

constexpr double kRadPerDeg = std::numbers::pi / 180.0;
/// Samples of a pixel that its fragment is made of. [ours]: what is wider than half a pixel meets one.
constexpr int kFirstSamples = 4;
/// Least cosine between the normals of a fragment's samples. [ours]
constexpr float kOnePatch = 0.96F;
/// How far its samples may lie from one plane, px. [ours]
constexpr float kOnePlanePx = 1.0F;
/// How much the colours of a fragment's samples may differ from their mean, over its brightness.
/// [ours]
constexpr float kEvenColour = 0.06F;
/// Occlusion rays of a sample that shows what no probe near it does. [ours]
constexpr std::size_t kSampleRays = 4;
/// Occlusion looks this far, over the scene's radius: what is further darkens no crevice.
constexpr double kOcclusionReach = 0.6;
/// Occlusion rays start this far off the surface, over the scene's radius: above float rounding
/// (1e-7), below what a pixel shows.
constexpr double kOcclusionOffset = 1e-4;
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
/// Most samples across a pixel of outlines: enough for 16 steps of coverage.
constexpr int kMostOutlineSamples = 4;
/// Layers of glass and leaves that are looked through. [ours]
constexpr int kMostLayers = 16;
/// What lies behind a layer is looked for so much further, in units of the frame: more than float
/// rounding (1e-7 at distances up to 8).
constexpr float kLayerGap = 1e-5F;
/// Places within this share of the least step of one plane are surely no step. [ours]
constexpr double kCalmJump = 0.25;
const Vec3 kInk(0.012, 0.014, 0.018);

/// Largest distance from the frame's origin of anything drawn.
double drawn_reach(const DrawnSurface& surface, std::span<const Paint> paints) {
  double reach = surface.reach();
  for (const Paint& paint : paints) {
    if (paint.overlay.graph != nullptr) {
      const double thickness = kJointThickness * paint.overlay.radius * surface.frame().scale;
      for (const Vec3& node : paint.overlay.graph->nodes) {
        reach = std::max(reach, surface.frame().to_frame(node).norm() + thickness);
      }
    }
  }
  return reach;
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

Scene::Scene(const DrawnSurface& surface, const Camera& camera, std::span<const Paint> paints,
             const RenderOptions& options, const RunContext& run)
    : surface_(&surface),
      options_(options),
      first_(sample_pattern(std::min(kFirstSamples, options.samples))),
      pattern_(sample_pattern(options.samples)) {
  const double reach = drawn_reach(surface, paints);
  pixel_ = pixel_size(camera, surface.frame(), options.height);
  // The shadow on the ground lies around the model.
  rays_.emplace(camera, surface.frame(), options.ground ? (1.0 + kOcclusionReach) * reach : reach,
                options.width, options.height);
  for (const Paint& paint : paints) {
    coats_.emplace_back(paint, surface, *rays_, options);
  }
  mask_.emplace(surface.mesh(), *rays_, pixel_, options.width, options.height);
  run.check();
  std::optional<Floor> floor;
  if (options.ground) {
    ground_.emplace(surface.mesh(), surface.rays(), options.up.normalized(),
                    kOcclusionReach * reach, run);
    floor = ground_->floor();
  }
  occlusion_.emplace(surface.rays(), kOcclusionReach * reach, kOcclusionOffset * reach, floor,
                     pixel_);
  if (options.ambient_rays > 0) {
    constexpr std::size_t kSets =
        std::size_t{OpennessGrid::kNeighbours} * OpennessGrid::kNeighbours;
    probe_directions_.emplace(static_cast<std::size_t>(options.ambient_rays), kSets);
    sample_directions_.emplace(kSampleRays, pattern_.size());
  }
  if (options.style == Style::Technical) {
    add_lines(run);
  }
}

void Scene::add_lines(const RunContext& run) {
  const int shorter = std::min(options_.width, options_.height);
  const double line_px = std::max(kLeastLinePx, kLineShare * shorter);
  const double reach = surface_->reach();
  const CurveGraph edges =
      feature_edges(surface_->mesh(), std::max(1.0, surface_->crease_deg()) * kRadPerDeg,
                    kLeastFeature * reach, kPiecePx * pixel_);
  run.check();
  creases_.emplace(edges, 0.5 * line_px * pixel_, *rays_, options_.width, options_.height, 1.0);
  const int side =
      std::min(kMostOutlineSamples,
               static_cast<int>(std::lround(std::sqrt(static_cast<double>(pattern_.size())))));
  contours_.emplace(surface_->rays(), *rays_, options_.width, side, kOutlineFactor * line_px,
                    kLeastJump * reach);
}

SceneBand Scene::band(int first_row, int rows, const RunContext& run) const {
  constexpr int kHalo = OpennessGrid::kHalo;
  const int first = std::max(0, first_row - kHalo) / 2 * 2;
  const int last = std::min(options_.height, first_row + rows + kHalo);
  SceneBand band{FragmentRows(options_.width, first, last - first, coats_.size()), first_row};
  parallel_for(
      run, static_cast<std::size_t>(last - first), 1, [&](std::size_t begin, std::size_t end) {
        for (int y = first + static_cast<int>(begin); y < first + static_cast<int>(end); ++y) {
          for (int x = 0; x < options_.width; ++x) {
            make_fragment(x, y, band.rows);
          }
        }
      });
  if (options_.ambient_rays > 0) {
    band.openness.emplace(
        band.rows, pixel_,
        [this](const SurfacePlace& place, std::size_t set) {
          return probed(place, probe_directions_->part(set));
        },
        run);
  }
  if (contours_) {
    const auto tolerance = static_cast<float>(kCalmJump * kLeastJump * surface_->reach());
    band.outlines = contours_->coverage(
        first_row, rows, [&](int x, int y) { return band.rows.may_break(x, y, tolerance); }, run);
  }
  return band;
}

Scene::SamplePacket Scene::samples(int x, int y, const Pattern& pattern, std::size_t first,
                                   std::size_t count, double width) const {
  SamplePacket samples{};
  RayPacket packet;
  bool any = false;
  for (std::size_t i = 0; i < count; ++i) {
    const auto& [right, down] = pattern[first + i];
    samples[i].x = x;
    samples[i].y = y;
    samples[i].index = first + i;
    samples[i].ray = rays_->ray(x + 0.5 + right, y + 0.5 + down);
    packet[i] = samples[i].ray.segment();
    packet[i].tfar = samples[i].ray.can_hit ? packet[i].tfar : -1.0F;
    any = any || samples[i].ray.can_hit;
  }
  if (any && mask_->may_show(x, y)) {
    const std::array<RayHit, 4> hits =
        surface_->rays().closest_hits(packet, count, static_cast<float>(width));
    for (std::size_t i = 0; i < count; ++i) {
      samples[i].hit = hits[i];
    }
  }
  for (std::size_t i = 0; i < count && creases_; ++i) {
    const double line_t = creases_->closest_hit(samples[i].ray, x, y).t;
    samples[i].on_line = std::isfinite(line_t) &&
                         (!samples[i].hit || line_t <= static_cast<double>(samples[i].hit.t));
  }
  return samples;
}

bool Scene::may_show_anything(int x, int y) const {
  return mask_->may_show(x, y) || (creases_ && creases_->may_show(x, y)) ||
         std::any_of(coats_.begin(), coats_.end(), [&](const Coat& coat) {
           return coat.tubes() && coat.tubes()->may_show(x, y);
         });
}

void Scene::make_fragment(int x, int y, FragmentRows& rows) const {
  if (!may_show_anything(x, y)) {
    return;
  }
  const std::size_t count = first_.size();
  const SamplePacket packet = samples(x, y, first_, 0, count, pixel_ / std::sqrt(count));
  Fragment& fragment = rows.fragments[rows.index(x, y)];
  std::size_t hits = 0;
  bool alike = true;
  Vec3f normals = Vec3f::Zero();
  for (std::size_t i = 0; i < count; ++i) {
    fragment.line = fragment.line || packet[i].on_line;
    if (!packet[i].hit) {
      continue;
    }
    const SurfacePlace place = surface_->place(packet[i].ray.segment(), packet[i].hit);
    if (++hits == 1) {
      fragment.place = place;
    }
    const Vec3f offset = place.position - fragment.place.position;
    fragment.off_plane = std::max(fragment.off_plane, std::abs(fragment.place.normal.dot(offset)));
    alike = alike && fragment.place.normal.dot(place.normal) >= kOnePatch;
    normals += place.normal;
  }
  fragment.hit = hits > 0;
  fragment.full = hits == count;
  fragment.one_patch = fragment.full && alike && !fragment.line &&
                       fragment.off_plane <= kOnePlanePx * static_cast<float>(pixel_);
  if (fragment.one_patch) {
    fragment.place.normal = normals.normalized();
  }
  for (std::size_t c = 0; c < coats_.size(); ++c) {
    rows.of_coats[rows.index(x, y) * coats_.size() + c] =
        coat_fragment(coats_[c], std::span(packet).first(count), fragment.one_patch);
  }
}

CoatFragment Scene::coat_fragment(const Coat& coat, std::span<const Sample> samples,
                                  bool one_patch) const {
  CoatFragment fragment;
  for (const Sample& sample : samples) {
    fragment.tube = fragment.tube ||
                    (coat.tubes() &&
                     std::isfinite(coat.tubes()->closest_hit(sample.ray, sample.x, sample.y).t));
  }
  if (!one_patch) {
    return fragment;
  }
  if (coat.is_uniform()) {
    fragment.albedo = coat.shown(samples.front().hit, 0.0).colour.cast<float>();
    fragment.even = !fragment.tube;
    return fragment;
  }
  const double width = pixel_ / std::sqrt(samples.size());
  std::array<Vec3f, kFirstSamples> colours{};
  bool opaque = true;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Skin::Shown shown = coat.shown(samples[i].hit, width);
    opaque = opaque && shown.opacity == 1.0 && !shown.unlit;
    colours[i] = shown.colour.cast<float>();
    fragment.albedo += colours[i] / static_cast<float>(samples.size());
  }
  const float most = kEvenColour * (fragment.albedo.maxCoeff() + kDarkestColour);
  fragment.even =
      opaque && !fragment.tube &&
      std::all_of(colours.begin(), colours.begin() + samples.size(), [&](const auto& c) {
        return (c - fragment.albedo).cwiseAbs().maxCoeff() <= most;
      });
  return fragment;
}

Light Scene::plain_light(int x, int y, std::size_t coat, const SceneBand& band) const {
  Light light;
  const Fragment& fragment = band.rows.at(x, y);
  if (!fragment.hit && !ground_) {
    return light;
  }
  const PictureRay ray = rays_->ray(x + 0.5, y + 0.5);
  if (fragment.hit) {
    float open = 1.0F;
    if (band.openness) {
      const std::optional<float> near = band.openness->at(fragment.place, x, y);
      open = near ? *near
                  : probed(fragment.place, probe_directions_->part(OpennessGrid::set_of(x, y)));
    }
    SurfacePoint point = point_at(fragment.place, ray.direction, static_cast<double>(open));
    point.albedo = band.rows.at(x, y, coat).albedo.cast<double>();
    light.behind(shaded(point), coats_[coat].tubes() ? translucent_opacity(point, false) : 1.0);
  }
  add_ground(light, ray, x, y);
  return light;
}

Vec3 Scene::to_camera(const Vec3& vector) const {
  return {vector.dot(rays_->right()), vector.dot(rays_->up()), vector.dot(rays_->back())};
}

float Scene::probed(const SurfacePlace& place, std::span<const Vec3f> directions) const {
  const HemisphereFrame frame =
      turned_frame(place.normal, rays_->back().cast<float>(), rays_->right().cast<float>(),
                   rays_->up().cast<float>());
  return occlusion_->openness(place.position, frame, place.face_normal, directions);
}

SurfacePoint Scene::point_at(const SurfacePlace& place, const Vec3& ray_direction,
                             double openness) const {
  SurfacePoint point;
  point.normal = to_camera(place.normal.cast<double>());
  point.to_viewer = to_camera(-ray_direction);
  point.openness = openness;
  return point;
}

Vec3 Scene::shaded(const SurfacePoint& point) const {
  return options_.style == Style::Technical ? shade_drawing(point) : shade_surface(point);
}

SurfacePoint Scene::surface_at(const Sample& sample, const RayHit& hit) const {
  const SurfacePlace place = surface_->place(sample.ray.segment(), hit);
  float open = 1.0F;
  if (sample.band->openness) {
    const std::optional<float> near = sample.band->openness->at(place, sample.x, sample.y);
    open = near ? *near : probed(place, sample_directions_->part(sample.index));
  }
  return point_at(place, sample.ray.direction, static_cast<double>(open));
}

Light Scene::surface_light(const Coat& coat, Sample& sample, const RayHit& hit,
                           bool before_tube) const {
  const double width = pixel_ / std::sqrt(static_cast<double>(pattern_.size()));
  const Skin::Shown shown = coat.shown(hit, width);
  if (shown.unlit) {
    return {shown.colour, shown.opacity};
  }
  const bool is_first = hit.t == sample.hit.t;
  if (is_first && !sample.surface) {
    sample.surface = surface_at(sample, hit);
  }
  SurfacePoint point = is_first ? *sample.surface : surface_at(sample, hit);
  point.albedo = shown.colour;
  return {shaded(point),
          shown.opacity * (coat.tubes() ? translucent_opacity(point, before_tube) : 1.0)};
}

Light Scene::light_of(const Coat& coat, Sample& sample) const {
  Light light;
  if (sample.on_line) {
    light.behind(kInk, 1.0);
    return light;
  }
  const PictureRay& ray = sample.ray;
  const TubeHit tube =
      coat.tubes() ? coat.tubes()->closest_hit(ray, sample.x, sample.y) : TubeHit{};
  const bool has_tube = std::isfinite(tube.t);
  RayHit layer = sample.hit;
  for (int count = 0; layer && static_cast<double>(layer.t) <= tube.t && count < kMostLayers;
       ++count) {
    const Light seen = surface_light(coat, sample, layer, has_tube);
    light.behind(seen.colour, seen.alpha);
    if (!coat.has_openings() || seen.alpha >= 1.0) {
      break;
    }
    RayPacket next{ray.segment()};
    next[0].tnear = layer.t + kLayerGap;
    layer = surface_->rays().closest_hits(
        next, 1, static_cast<float>(pixel_ / std::sqrt(static_cast<double>(pattern_.size()))))[0];
  }
  if (has_tube) {
    SurfacePoint point;
    point.albedo = coat.tube_colour();
    point.normal = to_camera(tube.normal);
    point.to_viewer = to_camera(-ray.direction);
    light.behind(shade_tube(point), 1.0);
  }
  add_ground(light, ray, sample.x, sample.y);
  return light;
}

void Scene::add_ground(Light& light, const PictureRay& ray, int x, int y) const {
  if (ground_ && light.alpha < 1.0 && ray.can_hit) {
    const double ground_t = ground_->meet(ray);
    if (std::isfinite(ground_t)) {
      light.behind(Vec3::Zero(), shadow(ray, ground_t, x, y));
    }
  }
}

double Scene::shadow(const PictureRay& ray, double t, int x, int y) const {
  const double dark = ground_->shadow(ray.origin + t * ray.direction);
  const double border =
      std::min({x + 0.5, y + 0.5, options_.width - x - 0.5, options_.height - y - 0.5});
  const double fade =
      std::clamp(border / (kShadowFade * std::min(options_.width, options_.height)), 0.0, 1.0);
  return kShadowOpacity * dark * fade * fade * (3.0 - 2.0 * fade);
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

void Scene::refine(int x, int y, const SceneBand& band, std::span<PixelLight> lights) const {
  const double width = pixel_ / std::sqrt(static_cast<double>(pattern_.size()));
  for (std::size_t first = 0; first < pattern_.size(); first += 4) {
    const std::size_t count = std::min<std::size_t>(4, pattern_.size() - first);
    SamplePacket packet = samples(x, y, pattern_, first, count, width);
    for (std::size_t i = 0; i < count; ++i) {
      packet[i].band = &band;
      for (std::size_t c = 0; c < coats_.size() && packet[i].ray.can_hit; ++c) {
        if (lights[c].refined) {
          const Light light = light_of(coats_[c], packet[i]);
          lights[c].light.colour += light.colour / static_cast<double>(pattern_.size());
          lights[c].light.alpha += light.alpha / static_cast<double>(pattern_.size());
        }
      }
    }
  }
}

void Scene::pixel(int x, int y, const SceneBand& band, std::span<PixelLight> lights) const {
  bool any_refined = false;
  for (std::size_t c = 0; c < coats_.size(); ++c) {
    const bool plain = band.rows.is_plain(x, y, c, static_cast<float>(pixel_));
    lights[c] = {plain ? plain_light(x, y, c, band) : Light{}, !plain};
    any_refined = any_refined || !plain;
  }
  if (any_refined) {
    refine(x, y, band, lights);
  }
  const double outline = band.outlines.empty()
                             ? 0.0
                             : band.outlines[static_cast<std::size_t>(y - band.first_row) *
                                                 static_cast<std::size_t>(options_.width) +
                                             static_cast<std::size_t>(x)];
  for (PixelLight& pixel : lights) {
    Light& sum = pixel.light;
    sum.colour = outline * kInk + (1.0 - outline) * sum.colour;
    sum.alpha = outline + (1.0 - outline) * sum.alpha;
    if (options_.background) {
      sum.behind(background(y), 1.0);
    }
    // The mean of light times opacity over the mean opacity: edges keep the surface's own colour.
    sum = {sum.alpha > 0.0 ? Vec3(sum.colour / sum.alpha) : Vec3(Vec3::Zero()),
           std::min(sum.alpha, 1.0)};
  }
}

}  // namespace vantage
