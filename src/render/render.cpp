// SPDX-License-Identifier: MIT
#include "vantage/render/render.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "vantage/core/error.h"

#include "core/parallel.h"
#include "core/srgb.h"
#include "render/drawn_surface.h"
#include "render/scene.h"

namespace vantage {
namespace {

constexpr int kMaxSidePx = 16384;
/// Pixels between two reports of progress.
constexpr int kBandPixels = 1 << 18;

void check_mesh_to_draw(const TriMesh& mesh) {
  if (mesh.positions.empty()) {
    throw InvalidInput("there is nothing to draw: the model is empty");
  }
  if (mesh.triangles.empty()) {
    throw InvalidInput(
        "there is no surface to draw: the model has points but no faces; make a surface from the "
        "points first, for example by Poisson reconstruction in MeshLab");
  }
}

void check_input(const TriMesh& mesh, const Paint& paint, const RenderOptions& options) {
  const std::span<const Rgb8> vertex_colours = paint.vertex_colours;
  const TubeOverlay& overlay = paint.overlay;
  check_fields(options, kRenderFields);
  if (options.width < 1 || options.height < 1 || options.width > kMaxSidePx ||
      options.height > kMaxSidePx) {
    throw InvalidInput("a picture's width and height must be between 1 and " +
                       std::to_string(kMaxSidePx) + " pixels");
  }
  if (!vertex_colours.empty() && vertex_colours.size() != mesh.positions.size()) {
    throw InvalidInput("there are " + std::to_string(vertex_colours.size()) + " colours for " +
                       std::to_string(mesh.positions.size()) + " vertices");
  }
  if (!paint.vertex_values.empty() && paint.vertex_values.size() != mesh.positions.size()) {
    throw InvalidInput("there are " + std::to_string(paint.vertex_values.size()) + " values for " +
                       std::to_string(mesh.positions.size()) + " vertices");
  }
  if (!unit_vector(options.up)) {
    throw InvalidInput("the up direction of a ground must be finite and not zero");
  }
  if (overlay.graph != nullptr && !(overlay.radius > 0.0 && std::isfinite(overlay.radius))) {
    throw InvalidInput("the radius of overlaid tubes must be above 0");
  }
}

/// A pixel as integers, sRGB with straight alpha. What cannot be seen is black.
template <class Channel>
std::array<Channel, 4> encoded(const Light& light) {
  constexpr double kFull = std::numeric_limits<Channel>::max();
  const auto alpha = static_cast<Channel>(std::lround(kFull * light.alpha));
  if (alpha == 0) {
    return {};
  }
  std::array<Channel, 4> pixel{};
  for (std::size_t c = 0; c < 3; ++c) {
    const double value = light.colour[static_cast<Eigen::Index>(c)];
    pixel[c] = static_cast<Channel>(std::lround(kFull * encoded_of_linear(value)));
  }
  pixel[3] = alpha;
  return pixel;
}

template <>
std::array<std::uint8_t, 4> encoded(const Light& light) {
  const auto alpha = static_cast<std::uint8_t>(std::lround(255.0 * light.alpha));
  if (alpha == 0) {
    return {};
  }
  const auto [red, green, blue] = srgb_of_linear(light.colour);
  return {red, green, blue, alpha};
}

/// RGBA of every pixel, row by row, one picture a paint.
template <class Channel>
std::vector<std::vector<Channel>> drawn(const DrawnSurface& surface, const Camera& camera,
                                        std::span<const Paint> paints, const RenderOptions& options,
                                        const RunContext& run) {
  for (const Paint& paint : paints) {
    check_input(surface.mesh(), paint, options);
  }
  const auto width = static_cast<std::size_t>(options.width);
  std::vector<std::vector<Channel>> pictures(paints.size());
  for (std::vector<Channel>& rgba : pictures) {
    rgba.resize(4 * width * static_cast<std::size_t>(options.height));
  }
  run.advance("render", 0.0);
  with_threads(run, [&] {
    const Scene scene(surface, camera, paints, options, run);
    const int band_rows = std::max(1, kBandPixels / options.width);
    for (int first = 0; first < options.height; first += band_rows) {
      run.advance("render", 0.1 + 0.9 * first / options.height);
      const int rows = std::min(band_rows, options.height - first);
      const SceneBand band = scene.band(first, rows, run);
      parallel_for(run, static_cast<std::size_t>(rows), 1, [&](std::size_t begin, std::size_t end) {
        std::vector<PixelLight> lights(paints.size());
        for (std::size_t i = begin * width; i < end * width; ++i) {
          const std::size_t at = 4 * (static_cast<std::size_t>(first) * width + i);
          scene.pixel(static_cast<int>(i % width), first + static_cast<int>(i / width), band,
                      lights);
          for (std::size_t c = 0; c < paints.size(); ++c) {
            const std::array<Channel, 4> pixel = encoded<Channel>(lights[c].light);
            std::copy(pixel.begin(), pixel.end(),
                      pictures[c].begin() + static_cast<std::ptrdiff_t>(at));
          }
        }
      });
    }
  });
  run.advance("render", 1.0);
  return pictures;
}

bool has_materials(const Appearance* appearance) {
  return appearance != nullptr && !appearance->materials.empty();
}

}  // namespace

void set_quality(RenderOptions& options, Quality quality) {
  constexpr std::array<std::array<int, 2>, 3> kRays{{{9, 8}, {16, 8}, {64, 64}}};
  options.samples = kRays[static_cast<std::size_t>(quality)][0];
  options.ambient_rays = kRays[static_cast<std::size_t>(quality)][1];
}

void set_quality_word(RenderOptions& options, std::string_view word) {
  const auto index = index_of_word(kQualityWords, word);
  if (!index) {
    throw InvalidInput("option quality must be draft, normal or fine, not '" + std::string(word) +
                       "'");
  }
  set_quality(options, static_cast<Quality>(*index));
}

std::string quality_word(const RenderOptions& options) {
  for (const Quality quality : {Quality::Draft, Quality::Normal, Quality::Fine}) {
    RenderOptions of_quality;
    set_quality(of_quality, quality);
    if (of_quality.samples == options.samples && of_quality.ambient_rays == options.ambient_rays) {
      return std::string(word_at(kQualityWords, static_cast<std::size_t>(quality)));
    }
  }
  return "";
}

PictureSurface::PictureSurface(const TriMesh& mesh, const Appearance* appearance, double crease_deg,
                               const RunContext& run) {
  check_mesh_to_draw(mesh);
  RenderOptions options;
  options.crease_deg = crease_deg;
  check_fields(options, kRenderFields);
  with_threads(run, [&] {
    surface_ = std::make_unique<const DrawnSurface>(mesh, appearance, crease_deg, run);
  });
}

PictureSurface::~PictureSurface() = default;
PictureSurface::PictureSurface(PictureSurface&&) noexcept = default;
PictureSurface& PictureSurface::operator=(PictureSurface&&) noexcept = default;

std::vector<Image> PictureSurface::render(const Camera& camera, std::span<const Paint> paints,
                                          const RenderOptions& options,
                                          const RunContext& run) const {
  const bool any_materials = std::any_of(paints.begin(), paints.end(), [](const Paint& paint) {
    return has_materials(paint.appearance);
  });
  if (paints.empty() || (paints.size() > 1 && any_materials)) {
    throw InvalidInput("one picture with materials, or any number without, can be drawn at once");
  }
  std::vector<Image> images;
  for (std::vector<std::uint8_t>& rgba :
       drawn<std::uint8_t>(*surface_, camera, paints, options, run)) {
    images.push_back({options.width, options.height, std::move(rgba)});
  }
  return images;
}

DeepImage PictureSurface::render_deep(const Camera& camera, const Paint& paint,
                                      const RenderOptions& options, const RunContext& run) const {
  auto pictures = drawn<std::uint16_t>(*surface_, camera, std::span(&paint, 1), options, run);
  return {options.width, options.height, std::move(pictures.front())};
}

Image render_painted(const TriMesh& mesh, const Camera& camera, const Paint& paint,
                     const RenderOptions& options, const RunContext& run) {
  const PictureSurface surface(mesh, paint.appearance, options.crease_deg, run);
  return std::move(surface.render(camera, std::span(&paint, 1), options, run).front());
}

DeepImage render_deep(const TriMesh& mesh, const Camera& camera, const Paint& paint,
                      const RenderOptions& options, const RunContext& run) {
  const PictureSurface surface(mesh, paint.appearance, options.crease_deg, run);
  return surface.render_deep(camera, paint, options, run);
}

Image render(const TriMesh& mesh, const Camera& camera, std::span<const Rgb8> vertex_colours,
             const TubeOverlay& overlay, const RenderOptions& options, const RunContext& run) {
  return render_painted(mesh, camera, {.vertex_colours = vertex_colours, .overlay = overlay},
                        options, run);
}

}  // namespace vantage
