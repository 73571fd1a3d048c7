// SPDX-License-Identifier: MIT
#include "render/contours.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "core/parallel.h"

namespace vantage {
namespace {

constexpr double kNothing = std::numeric_limits<double>::infinity();
/// Where no ray was cast, since nothing breaks there.
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
/// A step in depth counts if it is so many times what the slopes beside it foretell. [ours]: a
/// surface that merely turns away makes steps that grow by less from sample to sample.
constexpr double kSudden = 3.0;

/// Depths of a piece of the picture, one per sample, with a border.
struct DepthGrid {
  int width = 0;
  int rows = 0;
  std::vector<double> depth{};

  [[nodiscard]] double at(int x, int y) const {
    return depth[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                 static_cast<std::size_t>(x)];
  }
};

double slope(double a, double b) {
  return a == kNothing || b == kNothing ? 0.0 : std::abs(a - b);
}

/// Whether the surface breaks between b and c, of four samples in a row.
bool breaks(double a, double b, double c, double d, double least_jump) {
  if (std::isnan(b) || std::isnan(c)) {
    return false;
  }
  if (b == kNothing || c == kNothing) {
    return b != c;
  }
  const double jump = std::abs(b - c);
  return jump > least_jump && jump > kSudden * std::max(slope(a, b), slope(c, d));
}

/// Marks samples within `radius` of the point (x, y), given in samples.
void dab(std::vector<std::uint8_t>& ink, int width, int rows, double x, double y, double radius) {
  const int x0 = std::max(0, static_cast<int>(std::ceil(x - radius)));
  const int x1 = std::min(width - 1, static_cast<int>(std::floor(x + radius)));
  const int y0 = std::max(0, static_cast<int>(std::ceil(y - radius)));
  const int y1 = std::min(rows - 1, static_cast<int>(std::floor(y + radius)));
  for (int j = y0; j <= y1; ++j) {
    for (int i = x0; i <= x1; ++i) {
      if ((i - x) * (i - x) + (j - y) * (j - y) <= radius * radius) {
        ink[static_cast<std::size_t>(j) * static_cast<std::size_t>(width) +
            static_cast<std::size_t>(i)] = 1;
      }
    }
  }
}

std::vector<std::uint8_t> drawn_lines(const DepthGrid& grid, double radius, double least_jump) {
  std::vector<std::uint8_t> ink(grid.depth.size(), 0);
  for (int y = 0; y < grid.rows; ++y) {
    for (int x = 1; x + 2 < grid.width; ++x) {
      if (breaks(grid.at(x - 1, y), grid.at(x, y), grid.at(x + 1, y), grid.at(x + 2, y),
                 least_jump)) {
        dab(ink, grid.width, grid.rows, x + 0.5, y, radius);
      }
    }
  }
  for (int y = 1; y + 2 < grid.rows; ++y) {
    for (int x = 0; x < grid.width; ++x) {
      if (breaks(grid.at(x, y - 1), grid.at(x, y), grid.at(x, y + 1), grid.at(x, y + 2),
                 least_jump)) {
        dab(ink, grid.width, grid.rows, x, y + 0.5, radius);
      }
    }
  }
  return ink;
}

}  // namespace

Contours::Contours(const RayScene& scene, const PictureRays& rays, int width, int side,
                   double line_px, double least_jump)
    : scene_(&scene),
      rays_(&rays),
      width_(width),
      side_(side),
      radius_(0.5 * line_px * side),
      least_jump_(least_jump) {}

double Contours::depth(int x, int y) const {
  const PictureRay ray = rays_->ray((x + 0.5) / side_, (y + 0.5) / side_);
  if (!ray.can_hit) {
    return kNothing;
  }
  const RayHit hit = scene_->closest_hit(ray.origin.cast<float>(), ray.direction.cast<float>());
  return hit ? -(ray.origin + static_cast<double>(hit.t) * ray.direction).dot(rays_->back())
             : kNothing;
}

std::vector<double> Contours::coverage(int first_row, int rows, const MayBreak& may_break,
                                       const RunContext& run) const {
  // Lines reach in from breaks beside these rows, and a break needs two samples on either side.
  const int halo = static_cast<int>(std::ceil(radius_)) + 2;
  const int first = first_row * side_ - halo;
  // Floor of a sample over the samples of a pixel, also before the picture.
  const auto pixel_of = [&](int sample) { return (sample + halo * side_) / side_ - halo; };
  const int left = pixel_of(-halo) - 1;
  const int top = pixel_of(first) - 1;
  const int across = pixel_of(width_ * side_ + halo - 1) + 2 - left;
  const int down = pixel_of(first + rows * side_ + 2 * halo - 1) + 2 - top;
  std::vector<std::uint8_t> wanted(static_cast<std::size_t>(across) *
                                   static_cast<std::size_t>(down));
  const auto wanted_at = [&](int x, int y) -> std::uint8_t& {
    return wanted[static_cast<std::size_t>(y - top) * static_cast<std::size_t>(across) +
                  static_cast<std::size_t>(x - left)];
  };
  for (int y = top; y < top + down; ++y) {
    for (int x = left; x < left + across; ++x) {
      if (!may_break(x, y)) {
        continue;
      }
      for (int j = std::max(top, y - 1); j <= std::min(top + down - 1, y + 1); ++j) {
        for (int i = std::max(left, x - 1); i <= std::min(left + across - 1, x + 1); ++i) {
          wanted_at(i, j) = 1;
        }
      }
    }
  }
  DepthGrid grid{width_ * side_ + 2 * halo, rows * side_ + 2 * halo, {}};
  grid.depth.assign(static_cast<std::size_t>(grid.width) * static_cast<std::size_t>(grid.rows),
                    kNothing);
  parallel_for(
      run, static_cast<std::size_t>(grid.rows), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t row = begin; row < end; ++row) {
          const int y = first + static_cast<int>(row);
          for (int x = 0; x < grid.width; ++x) {
            grid.depth[row * static_cast<std::size_t>(grid.width) + static_cast<std::size_t>(x)] =
                wanted_at(pixel_of(x - halo), pixel_of(y)) != 0 ? depth(x - halo, y) : kUnknown;
          }
        }
      });
  const std::vector<std::uint8_t> ink = drawn_lines(grid, radius_, least_jump_);
  std::vector<double> covered(static_cast<std::size_t>(width_) * static_cast<std::size_t>(rows));
  for (int y = 0; y < rows * side_; ++y) {
    for (int x = 0; x < width_ * side_; ++x) {
      const std::size_t sample =
          static_cast<std::size_t>(y + halo) * static_cast<std::size_t>(grid.width) +
          static_cast<std::size_t>(x + halo);
      covered[static_cast<std::size_t>(y / side_) * static_cast<std::size_t>(width_) +
              static_cast<std::size_t>(x / side_)] += ink[sample];
    }
  }
  for (double& share : covered) {
    share /= side_ * side_;
  }
  return covered;
}

}  // namespace vantage
