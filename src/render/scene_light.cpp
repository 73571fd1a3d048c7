// SPDX-License-Identifier: MIT
// Light of a picture's pixels. scene.cpp prepares what it is made of.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "core/srgb.h"
#include "render/scene.h"

namespace vantage {
namespace {

/// How much their light may differ from its mean, over its brightness. [ours]
constexpr double kEvenLight = 0.12;
/// Opacity of the ground where it sees no sky. [ours]
constexpr double kShadowOpacity = 0.72;
/// The shadow fades out over this share of the picture's shorter side at the border. [ours]
constexpr double kShadowFade = 0.07;
/// Layers of glass and leaves that are looked through, until what is behind them would not show. [ours]
constexpr int kMostLayers = 256;
constexpr double kNothingBehind = 1.0 - 0.25 / 255.0;
/// What lies behind a layer is looked for so much further, in units of the frame: more than float
/// rounding (1e-7 at distances up to 8).
constexpr float kLayerGap = 1e-5F;
/// Samples of a pixel are lit alike where their normals differ by less than this cosine, and their
/// albedos by less than this share of their brightness. [ours]
constexpr float kLitAlike = 0.99F;
constexpr double kShownAlike = 0.02;
/// How far from the plane of the first of them they may lie, px. [ours]
constexpr float kLitAlikePx = 1.0F;
const Vec3 kInk(0.012, 0.014, 0.018);

}  // namespace

SurfacePoint Scene::plain_point(int x, int y, const SceneBand& band) const {
  SurfacePlace place = band.rows.at(x, y).place;
  float open = 1.0F;
  if (band.openness) {
    const std::optional<float> near = band.openness->at(place, x, y);
    open = near ? *near : probed(place, probe_directions_->part(OpennessGrid::set_of(x, y)));
  }
  if (pattern_.size() > 1) {
    place.normal = band.rows.mixed_normal(x, y);
  }
  return point_at(place, rays_->ray(x + 0.5, y + 0.5).direction, static_cast<double>(open));
}

Light Scene::plain_light(int x, int y, std::size_t paint, const SceneBand& band,
                         std::optional<SurfacePoint>& point) const {
  Light light;
  if (band.rows.at(x, y).hit) {
    point = point ? point : plain_point(x, y, band);
    point->albedo = band.rows.mixed_albedo(x, y, paint).cast<double>();
    const Vec3 emission = band.rows.mixed_emission(x, y, paint).cast<double>();
    light.behind(shaded(*point) + emission,
                 paints_[paint].tubes() ? translucent_opacity(*point, false) : 1.0);
  }
  if (ground_) {
    add_ground(light, rays_->ray(x + 0.5, y + 0.5), x, y);
  }
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

std::size_t Scene::patch_at(const Sample& sample, const RayHit& hit, Patches& patches) const {
  const SurfacePlace place = surface_->place(sample.ray.segment(), hit);
  const auto pixel = static_cast<float>(pixel_);
  for (std::size_t p = 0; p < patches.size(); ++p) {
    const SurfacePlace& first = patches[p].place;
    if (first.normal.dot(place.normal) > kLitAlike &&
        std::abs(first.normal.dot(place.position - first.position)) <= kLitAlikePx * pixel) {
      return p;
    }
  }
  float open = 1.0F;
  if (sample.band->openness) {
    const std::optional<float> near = sample.band->openness->at(place, sample.x, sample.y);
    open = near ? *near : probed(place, sample_directions_->part(sample.index));
  }
  patches.push_back(
      {.place = place, .point = point_at(place, sample.ray.direction, static_cast<double>(open))});
  return patches.size() - 1;
}

void Scene::find_patches(SamplePacket& samples, std::size_t count, Patches& patches) const {
  for (std::size_t i = 0; i < count; ++i) {
    if (samples[i].hit && !samples[i].on_line) {
      samples[i].patch = patch_at(samples[i], samples[i].hit, patches);
    }
  }
}

Light Scene::surface_light(const PreparedPaint& paint, Sample& sample, const RayHit& hit,
                           bool before_tube, Patches& patches) const {
  const double width = pixel_ / std::sqrt(static_cast<double>(pattern_.size()));
  const SurfaceMaterials::Shown shown = paint.shown(hit, width);
  if (shown.unlit) {
    return {shown.colour, shown.opacity};
  }
  const bool is_first = hit.t == sample.hit.t;
  Patch& patch = patches[is_first ? *sample.patch : patch_at(sample, hit, patches)];
  const double most = kShownAlike * (shown.colour.maxCoeff() + static_cast<double>(kDarkestColour));
  // What another paint left is only taken if it is the same: paints look as they would alone.
  if (!patch.shown || (patch.point.albedo - shown.colour).cwiseAbs().maxCoeff() >
                          (patch.is_of_paint ? most : 0.0)) {
    patch.point.albedo = shown.colour;
    patch.shown = shaded(patch.point);
  }
  patch.is_of_paint = true;
  double opacity = shown.opacity;
  if (paint.tubes()) {
    std::optional<double>& veil = patch.veil[before_tube ? 1 : 0];
    veil = veil ? veil : translucent_opacity(patch.point, before_tube);
    opacity *= *veil;
  }
  return {*patch.shown + shown.emission, opacity};
}

void Scene::add_tube_and_ground(Light& light, const PreparedPaint& paint, const Sample& sample,
                                const TubeHit& tube) const {
  if (std::isfinite(tube.t)) {
    SurfacePoint point;
    point.albedo = paint.tube_colour();
    point.normal = to_camera(tube.normal);
    point.to_viewer = to_camera(-sample.ray.direction);
    light.behind(shade_tube(point), 1.0);
  }
  add_ground(light, sample.ray, sample.x, sample.y);
}

std::array<Light, 4> Scene::lights_of(const PreparedPaint& paint, SamplePacket& samples,
                                      std::size_t count, Patches& patches) const {
  std::array<Light, 4> lights{};
  std::array<TubeHit, 4> tubes{};
  std::array<RayHit, 4> layers{};
  for (std::size_t i = 0; i < count; ++i) {
    const Sample& sample = samples[i];
    if (sample.ray.can_hit && sample.on_line) {
      lights[i].behind(kInk, 1.0);
    } else if (sample.ray.can_hit) {
      layers[i] = sample.hit;
      tubes[i] =
          paint.tubes() ? paint.tubes()->closest_hit(sample.ray, sample.x, sample.y) : TubeHit{};
    }
  }
  // Layer by layer, from the eye on.
  const auto width = static_cast<float>(pixel_ / std::sqrt(static_cast<double>(pattern_.size())));
  for (int depth = 0; depth < kMostLayers; ++depth) {
    RayPacket next{};
    bool any = false;
    for (std::size_t i = 0; i < count; ++i) {
      next[i].tfar = -1.0F;
      if (!layers[i] || static_cast<double>(layers[i].t) > tubes[i].t) {
        continue;
      }
      const bool before_tube = std::isfinite(tubes[i].t);
      const Light seen = surface_light(paint, samples[i], layers[i], before_tube, patches);
      lights[i].behind(seen.colour, seen.alpha);
      if (paint.has_openings() && lights[i].alpha < kNothingBehind) {
        next[i] = samples[i].ray.segment();
        next[i].tnear = layers[i].t + kLayerGap;
        any = true;
      }
    }
    if (!any) {
      break;
    }
    layers = surface_->rays().closest_hits(next, count, width);
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (samples[i].ray.can_hit && !samples[i].on_line) {
      add_tube_and_ground(lights[i], paint, samples[i], tubes[i]);
    }
  }
  return lights;
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

void Scene::begin_paint(Patches& patches) {
  for (Patch& patch : patches) {
    patch.is_of_paint = false;
  }
}

void Scene::look_at_few(int x, int y, const SceneBand& band, std::span<PixelLight> lights) const {
  const std::size_t count = few_.size();
  SamplePacket packet{};
  for (std::size_t i = 0; i < count; ++i) {
    packet[i] = aimed(x, y, few_[i][0], few_[i][1]);
    // The place in the whole pattern, for the rays of occlusion.
    packet[i].index = i * pattern_.size() / count;
    packet[i].band = &band;
  }
  trace(packet, count, pixel_ / std::sqrt(static_cast<double>(count)));
  Patches patches;
  find_patches(packet, count, patches);
  for (std::size_t c = 0; c < paints_.size(); ++c) {
    if (lights[c].need != SampleNeed::Few) {
      continue;
    }
    begin_paint(patches);
    const std::array<Light, 4> seen = lights_of(paints_[c], packet, count, patches);
    Light mean;
    for (std::size_t i = 0; i < count; ++i) {
      mean.colour += seen[i].colour / static_cast<double>(count);
      mean.alpha += seen[i].alpha / static_cast<double>(count);
    }
    const double most = kEvenLight * (mean.colour.maxCoeff() + static_cast<double>(kDarkestColour));
    const bool even = std::all_of(seen.begin(), seen.begin() + count, [&](const Light& light) {
      return std::abs(light.alpha - mean.alpha) <= kEvenLight &&
             (light.colour - mean.colour).cwiseAbs().maxCoeff() <= most;
    });
    lights[c].need = even ? SampleNeed::Few : SampleNeed::All;
    lights[c].light = even ? mean : Light{};
  }
}

void Scene::look_at_all(int x, int y, const SceneBand& band, std::span<PixelLight> lights) const {
  const auto samples = static_cast<double>(pattern_.size());
  std::vector<SamplePacket> packets((pattern_.size() + 3) / 4);
  Patches patches;
  for (std::size_t first = 0; first < pattern_.size(); first += 4) {
    SamplePacket& packet = packets[first / 4];
    const std::size_t count = std::min<std::size_t>(4, pattern_.size() - first);
    for (std::size_t i = 0; i < count; ++i) {
      packet[i] = aimed(x, y, pattern_[first + i][0], pattern_[first + i][1]);
      packet[i].index = first + i;
      packet[i].band = &band;
    }
    trace(packet, count, pixel_ / std::sqrt(samples));
    find_patches(packet, count, patches);
  }
  for (std::size_t c = 0; c < paints_.size(); ++c) {
    begin_paint(patches);
    for (std::size_t p = 0; p < packets.size() && lights[c].need == SampleNeed::All; ++p) {
      const std::size_t count = std::min<std::size_t>(4, pattern_.size() - 4 * p);
      const std::array<Light, 4> seen = lights_of(paints_[c], packets[p], count, patches);
      for (std::size_t i = 0; i < count; ++i) {
        lights[c].light.colour += seen[i].colour / samples;
        lights[c].light.alpha += seen[i].alpha / samples;
      }
    }
  }
}

void Scene::pixel(int x, int y, const SceneBand& band, std::span<PixelLight> lights) const {
  const auto any_needs = [&](SampleNeed need) {
    return std::any_of(lights.begin(), lights.end(),
                       [need](const PixelLight& pixel) { return pixel.need == need; });
  };
  // What shows nothing, nor do those beside it, needs no look at the fragments.
  const bool may_show = may_show_anything(x, y);
  const SampleNeed of_surface =
      may_show ? band.rows.need(x, y, static_cast<float>(pixel_)) : SampleNeed::One;
  std::optional<SurfacePoint> point;
  for (std::size_t c = 0; c < paints_.size(); ++c) {
    const SampleNeed need =
        may_show ? band.rows.need_of_paint(x, y, c, of_surface) : SampleNeed::One;
    lights[c] = {need == SampleNeed::One ? plain_light(x, y, c, band, point) : Light{}, need};
  }
  if (any_needs(SampleNeed::Few)) {
    look_at_few(x, y, band, lights);
  }
  if (any_needs(SampleNeed::All)) {
    look_at_all(x, y, band, lights);
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
