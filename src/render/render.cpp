// SPDX-License-Identifier: MIT
#include "vantage/render/render.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "vantage/core/error.h"

#include "core/parallel.h"
#include "render/scene.h"

namespace vantage {
namespace {

constexpr int kMaxSidePx = 16384;
/// Rows between two reports of progress: fine enough to stop within a second.
constexpr int kBandPx = 64;

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
  if (!(options.up.norm() > 0.0) || !options.up.allFinite()) {
    throw InvalidInput("the up direction of a ground must be finite and not zero");
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
      const SceneBand prepared = scene.band(band, rows, run);
      parallel_for(run, static_cast<std::size_t>(rows), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t row = begin; row < end; ++row) {
          const int y = band + static_cast<int>(row);
          for (int x = 0; x < options.width; ++x) {
            const std::array<std::uint8_t, 4> bytes = scene.pixel(x, y, prepared);
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
