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
#include "render/scene.h"

namespace vantage {
namespace {

constexpr int kMaxSidePx = 16384;
/// Rows between two reports of progress: fine enough to stop within a second.
constexpr int kBandPx = 64;

void check_input(const TriMesh& mesh, const Paint& paint, const RenderOptions& options) {
  const std::span<const Rgb8> vertex_colours = paint.vertex_colours;
  const TubeOverlay& overlay = paint.overlay;
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
  if (!(options.up.norm() > 0.0) || !options.up.allFinite()) {
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

/// RGBA of every pixel, row by row, one picture a paint.
template <class Channel>
std::vector<std::vector<Channel>> drawn(const TriMesh& mesh, const Camera& camera,
                                        std::span<const Paint> paints, const RenderOptions& options,
                                        const RunContext& run) {
  for (const Paint& paint : paints) {
    check_input(mesh, paint, options);
  }
  const auto width = static_cast<std::size_t>(options.width);
  std::vector<std::vector<Channel>> pictures(paints.size());
  for (std::vector<Channel>& rgba : pictures) {
    rgba.resize(4 * width * static_cast<std::size_t>(options.height));
  }
  run.advance("render", 0.0);
  with_threads(run, [&] {
    const Scene scene(mesh, camera, paints, options, run);
    for (int band = 0; band < options.height; band += kBandPx) {
      run.advance("render", 0.1 + 0.9 * band / options.height);
      const int rows = std::min(kBandPx, options.height - band);
      const SceneBand prepared = scene.band(band, rows, run);
      parallel_for(run, static_cast<std::size_t>(rows), 1, [&](std::size_t begin, std::size_t end) {
        std::vector<Light> lights(paints.size());
        for (std::size_t i = begin * width; i < end * width; ++i) {
          const std::size_t at = 4 * (static_cast<std::size_t>(band) * width + i);
          scene.pixel(static_cast<int>(i % width), band + static_cast<int>(i / width), prepared,
                      lights);
          for (std::size_t c = 0; c < paints.size(); ++c) {
            const std::array<Channel, 4> pixel = encoded<Channel>(lights[c]);
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

}  // namespace

void set_quality(RenderOptions& options, Quality quality) {
  constexpr std::array<std::array<int, 2>, 3> kRays{{{9, 1}, {16, 2}, {64, 4}}};
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

std::vector<Image> render_coats(const TriMesh& mesh, const Camera& camera,
                                std::span<const Paint> paints, const RenderOptions& options,
                                const RunContext& run) {
  const bool any_materials = std::any_of(paints.begin(), paints.end(), [](const Paint& paint) {
    return paint.appearance != nullptr && !paint.appearance->materials.empty();
  });
  if (paints.empty() || (paints.size() > 1 && any_materials)) {
    throw InvalidInput("one picture with materials, or any number without, can be drawn at once");
  }
  std::vector<Image> images;
  for (std::vector<std::uint8_t>& rgba : drawn<std::uint8_t>(mesh, camera, paints, options, run)) {
    images.push_back({options.width, options.height, std::move(rgba)});
  }
  return images;
}

Image render_painted(const TriMesh& mesh, const Camera& camera, const Paint& paint,
                     const RenderOptions& options, const RunContext& run) {
  return std::move(render_coats(mesh, camera, {&paint, 1}, options, run).front());
}

DeepImage render_deep(const TriMesh& mesh, const Camera& camera, const Paint& paint,
                      const RenderOptions& options, const RunContext& run) {
  auto pictures = drawn<std::uint16_t>(mesh, camera, std::span(&paint, 1), options, run);
  return {options.width, options.height, std::move(pictures.front())};
}

Image render(const TriMesh& mesh, const Camera& camera, std::span<const Rgb8> vertex_colours,
             const TubeOverlay& overlay, const RenderOptions& options, const RunContext& run) {
  return render_painted(mesh, camera, {vertex_colours, overlay, nullptr}, options, run);
}

}  // namespace vantage
