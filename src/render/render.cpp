// SPDX-License-Identifier: MIT
#include "vantage/render/render.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
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

template <class Channel>
std::vector<Channel> drawn(const TriMesh& mesh, const Camera& camera, const Paint& paint,
                           const RenderOptions& options, const RunContext& run) {
  check_input(mesh, paint, options);
  const auto width = static_cast<std::size_t>(options.width);
  std::vector<Channel> rgba(4 * width * static_cast<std::size_t>(options.height));
  run.advance("render", 0.0);
  with_threads(run, [&] {
    const Scene scene(mesh, camera, paint, options, run);
    for (int band = 0; band < options.height; band += kBandPx) {
      run.advance("render", 0.1 + 0.9 * band / options.height);
      const int rows = std::min(kBandPx, options.height - band);
      const SceneBand prepared = scene.band(band, rows, run);
      parallel_for(run, static_cast<std::size_t>(rows), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t row = begin; row < end; ++row) {
          const int y = band + static_cast<int>(row);
          for (int x = 0; x < options.width; ++x) {
            const std::array<Channel, 4> pixel = encoded<Channel>(scene.pixel(x, y, prepared));
            const std::size_t at =
                4 * (static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x));
            std::copy(pixel.begin(), pixel.end(), rgba.begin() + static_cast<std::ptrdiff_t>(at));
          }
        }
      });
    }
  });
  run.advance("render", 1.0);
  return rgba;
}

}  // namespace

void set_quality(RenderOptions& options, Quality quality) {
  constexpr std::array<std::array<int, 2>, 3> kRays{{{9, 1}, {16, 2}, {64, 4}}};
  options.samples = kRays[static_cast<std::size_t>(quality)][0];
  options.ambient_rays = kRays[static_cast<std::size_t>(quality)][1];
}

Image render_painted(const TriMesh& mesh, const Camera& camera, const Paint& paint,
                     const RenderOptions& options, const RunContext& run) {
  Image image{options.width, options.height, {}};
  image.rgba = drawn<std::uint8_t>(mesh, camera, paint, options, run);
  return image;
}

DeepImage render_deep(const TriMesh& mesh, const Camera& camera, const Paint& paint,
                      const RenderOptions& options, const RunContext& run) {
  DeepImage image{options.width, options.height, {}};
  image.rgba = drawn<std::uint16_t>(mesh, camera, paint, options, run);
  return image;
}

Image render(const TriMesh& mesh, const Camera& camera, std::span<const Rgb8> vertex_colours,
             const TubeOverlay& overlay, const RenderOptions& options, const RunContext& run) {
  return render_painted(mesh, camera, {vertex_colours, overlay, nullptr}, options, run);
}

}  // namespace vantage
