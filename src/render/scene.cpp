// SPDX-License-Identifier: MIT
#include "render/scene.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/degrees.h"
#include "core/parallel.h"
#include "core/unit_direction.h"
#include "render/feature_edges.h"
#include "render/sample_pattern.h"

namespace vantage {
namespace {

/// Occlusion rays of a sample that shows what no probe near it does. [ours]
constexpr std::size_t kSampleRays = 4;
/// Occlusion looks this far, over the scene's radius: what is further darkens no crevice.
constexpr double kOcclusionReach = 0.6;
/// Occlusion rays start this far off the surface, over the scene's radius: above float rounding
/// (1e-7), below what a pixel shows.
constexpr double kOcclusionOffset = 1e-4;
/// Width of drawn lines over the picture's shorter side, and the least, px. [ours]
constexpr double kLineShare = 0.0022;
constexpr double kLeastLinePx = 1.1;
/// Outlines are so much wider than lines inside, as draughtsmen have it. [ours]
constexpr double kOutlineFactor = 1.5;
/// Least step in depth that gets a line, over the scene's radius. [ours]
constexpr double kLeastJump = 0.012;
/// Feature lines shorter in all than this, over the scene's radius, are left out. [ours]
constexpr double kLeastFeature = 0.06;
/// Longest piece of a feature line, px: about four tiles, so that few rays ask about it.
constexpr double kPiecePx = 32.0;
/// Most samples across a pixel of outlines: enough for 16 steps of coverage.
constexpr int kMostOutlineSamples = 4;
/// What lies further from the plane of a pixel's middle, px, is not the same surface. [ours]
constexpr float kBreakPx = 2.0F;
/// Places within this share of the least step of one plane are surely no step. [ours]
constexpr double kCalmJump = 0.25;

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

/// How far something at the scene's middle may move for its picture to move by a pixel; of an eye that is
/// there something half a radius away.
double pixel_size(const Camera& camera, const UnitFrame& frame, int height_px) {
  if (camera.projection == Projection::Orthographic) {
    return camera.height * frame.scale / height_px;
  }
  constexpr double kLeastDistance = 0.5;
  const double distance = std::max(kLeastDistance, frame.to_frame(camera.eye).norm());
  return 2.0 * std::tan(0.5 * camera.fov_y_deg * kRadPerDeg) * distance / height_px;
}

}  // namespace

Scene::Scene(const DrawnSurface& surface, const Camera& camera, std::span<const Paint> paints,
             const RenderOptions& options, const RunContext& run)
    : surface_(&surface),
      options_(options),
      few_(sample_pattern(std::min(kFewSamples, options.samples))),
      pattern_(sample_pattern(options.samples)) {
  const double reach = drawn_reach(surface, paints);
  pixel_ = pixel_size(camera, surface.frame(), options.height);
  // The shadow on the ground lies around the model.
  rays_.emplace(camera, surface.frame(), options.ground ? (1.0 + kOcclusionReach) * reach : reach,
                options.width, options.height);
  for (const Paint& paint : paints) {
    paints_.emplace_back(paint, surface, *rays_, options);
  }
  mask_.emplace(surface.mesh(), *rays_, pixel_, options.width, options.height);
  run.check();
  std::optional<Floor> floor;
  if (options.ground) {
    ground_.emplace(surface.mesh(), surface.rays(), unit_direction(options.up).normalized(),
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
  SceneBand band{FragmentRows(options_.width, first, last - first, paints_.size()), first_row};
  parallel_for(
      run, static_cast<std::size_t>(last - first), 1, [&](std::size_t begin, std::size_t end) {
        for (int y = first + static_cast<int>(begin); y < first + static_cast<int>(end); ++y) {
          make_fragments(y, band.rows);
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

Scene::Sample Scene::aimed(int x, int y, double right, double down) const {
  Sample sample;
  sample.x = x;
  sample.y = y;
  sample.ray = rays_->ray(x + 0.5 + right, y + 0.5 + down);
  return sample;
}

void Scene::trace(SamplePacket& samples, std::size_t count, double width) const {
  RayPacket packet;
  bool any = false;
  for (std::size_t i = 0; i < count; ++i) {
    const bool may_hit = samples[i].ray.can_hit && mask_->may_show(samples[i].x, samples[i].y);
    packet[i] = samples[i].ray.segment();
    packet[i].tfar = may_hit ? packet[i].tfar : -1.0F;
    any = any || may_hit;
  }
  if (any) {
    const std::array<RayHit, 4> hits =
        surface_->rays().closest_hits(packet, count, static_cast<float>(width));
    for (std::size_t i = 0; i < count; ++i) {
      samples[i].hit = hits[i];
    }
  }
  for (std::size_t i = 0; i < count && creases_; ++i) {
    const double line_t = creases_->closest_hit(samples[i].ray, samples[i].x, samples[i].y).t;
    samples[i].on_line = std::isfinite(line_t) &&
                         (!samples[i].hit || line_t <= static_cast<double>(samples[i].hit.t));
  }
}

bool Scene::may_show_anything(int x, int y) const {
  return mask_->may_show(x, y) || (creases_ && creases_->may_show(x, y)) ||
         std::any_of(paints_.begin(), paints_.end(), [&](const PreparedPaint& paint) {
           return paint.tubes() && paint.tubes()->may_show(x, y);
         });
}

void Scene::make_fragments(int y, FragmentRows& rows) const {
  for (int first = 0; first < options_.width; first += 4) {
    SamplePacket packet{};
    const auto count = static_cast<std::size_t>(std::min(4, options_.width - first));
    bool any = false;
    for (int x = first; x < std::min(first + 4, options_.width); ++x) {
      any = any || may_show_anything(x, y);
    }
    if (!any) {
      continue;
    }
    for (std::size_t i = 0; i < count; ++i) {
      packet[i] = aimed(first + static_cast<int>(i), y, 0.0, 0.0);
    }
    trace(packet, count, pixel_);
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t index = rows.index(packet[i].x, y);
      Fragment& fragment = rows.fragments[index];
      fragment.line = packet[i].on_line;
      fragment.hit = static_cast<bool>(packet[i].hit);
      if (fragment.hit) {
        fragment.place = surface_->place(packet[i].ray.segment(), packet[i].hit);
      }
      for (std::size_t c = 0; c < paints_.size(); ++c) {
        rows.of_paints[index * paints_.size() + c] = paint_fragment(paints_[c], packet[i]);
      }
    }
    if (pattern_.size() > 1) {
      find_breaks(packet, count, rows);
    }
  }
}

void Scene::find_breaks(const SamplePacket& middles, std::size_t count, FragmentRows& rows) const {
  // Between the middles of four pixels: something half a pixel wide before the surface meets it.
  SamplePacket corners{};
  for (std::size_t i = 0; i < count; ++i) {
    corners[i] = aimed(middles[i].x, middles[i].y, 0.5, 0.5);
  }
  trace(corners, count, pixel_);
  for (std::size_t i = 0; i < count; ++i) {
    Fragment& fragment = rows.fragments[rows.index(middles[i].x, middles[i].y)];
    const RaySegment ray = corners[i].ray.segment();
    const RayHit& hit = corners[i].hit;
    if (fragment.hit) {
      const Vec3f offset = ray.origin + hit.t * ray.direction - fragment.place.position;
      fragment.breaks = !hit || std::abs(fragment.place.normal.dot(offset)) >
                                    kBreakPx * static_cast<float>(pixel_);
    } else if (hit) {
      fragment.breaks = true;
    } else if (mask_->may_show(middles[i].x, middles[i].y)) {
      SamplePacket around{};
      for (std::size_t k = 0; k < few_.size(); ++k) {
        around[k] = aimed(middles[i].x, middles[i].y, few_[k][0], few_[k][1]);
      }
      trace(around, few_.size(), pixel_);
      fragment.breaks = std::any_of(around.begin(), around.end(), [](const Sample& sample) {
        return static_cast<bool>(sample.hit);
      });
    }
  }
}

PaintFragment Scene::paint_fragment(const PreparedPaint& paint, const Sample& sample) const {
  PaintFragment fragment;
  fragment.tube =
      paint.tubes() && std::isfinite(paint.tubes()->closest_hit(sample.ray, sample.x, sample.y).t);
  if (sample.hit) {
    const SurfaceMaterials::Shown shown = paint.shown(sample.hit, pixel_);
    fragment.albedo = shown.colour.cast<float>();
    fragment.emission = shown.emission.cast<float>();
    fragment.opaque = shown.opacity == 1.0 && !shown.unlit;
  }
  return fragment;
}

}  // namespace vantage
