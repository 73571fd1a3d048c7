// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <Eigen/LU>

#include "vantage/render/render.h"

#include "core/srgb.h"
#include "render/colour_scale.h"

namespace vantage {
namespace {

constexpr Rgb8 kGrey{128, 128, 128};

/// Control colours at equal steps of the value. Lightness climbs from the blue to the yellow, so
/// that most of the range also reads in grey, and falls towards the red, as in the paper's figures.
constexpr std::array<Rgb8, 9> kControls{{{{46, 58, 152}},
                                         {{44, 104, 202}},
                                         {{38, 154, 214}},
                                         {{48, 190, 180}},
                                         {{98, 202, 108}},
                                         {{180, 214, 70}},
                                         {{246, 204, 60}},
                                         {{240, 132, 48}},
                                         {{196, 38, 40}}}};

Eigen::Matrix3d lms_of_rgb() {
  Eigen::Matrix3d M;
  M << 0.4122214708, 0.5363325363, 0.0514459929,  //
      0.2119034982, 0.6806995451, 0.1073969566,   //
      0.0883024619, 0.2817188376, 0.6299787005;
  return M;
}

/// Control colours as cube roots of cone responses. OKLab is a linear map of these, so joining
/// colours linearly here or in OKLab is the same.
std::array<Vec3, kControls.size()> control_roots() {
  const Eigen::Matrix3d M = lms_of_rgb();
  std::array<Vec3, kControls.size()> roots{};
  for (std::size_t c = 0; c < kControls.size(); ++c) {
    const Vec3 lms = M * linear_of_srgb(kControls[c]);
    roots[c] = Vec3(std::cbrt(lms[0]), std::cbrt(lms[1]), std::cbrt(lms[2]));
  }
  return roots;
}

}  // namespace

Rgb8 cool_warm(double value) {
  static const std::array<Vec3, kControls.size()> roots = control_roots();
  static const Eigen::Matrix3d rgb_of_lms = lms_of_rgb().inverse();
  if (std::isnan(value)) {
    return kGrey;
  }
  const double place = std::clamp(value, 0.0, 1.0) * static_cast<double>(roots.size() - 1);
  const auto left = std::min(static_cast<std::size_t>(place), roots.size() - 2);
  const double t = place - static_cast<double>(left);
  const Vec3 root = (1.0 - t) * roots[left] + t * roots[left + 1];
  const Vec3 lms = root.cwiseProduct(root).cwiseProduct(root);
  return srgb_of_linear(Vec3(rgb_of_lms * lms));
}

std::vector<float> shares_of_range(std::span<const double> values) {
  double low = 0.0;
  double high = 0.0;
  bool any = false;
  for (const double value : values) {
    if (std::isfinite(value)) {
      low = any ? std::min(low, value) : value;
      high = any ? std::max(high, value) : value;
      any = true;
    }
  }
  // Halves, so that the span of a map that fills the range of double stays finite.
  const double half_span = 0.5 * high - 0.5 * low;
  std::vector<float> shares;
  shares.reserve(values.size());
  for (const double value : values) {
    const bool scales = std::isfinite(value) && half_span > 0.0;
    const double flat = std::isfinite(value) ? 0.0 : value;
    const double share = scales ? (0.5 * value - 0.5 * low) / half_span : flat;
    shares.push_back(static_cast<float>(std::isnan(share) ? share : std::clamp(share, 0.0, 1.0)));
  }
  return shares;
}

std::vector<Rgb8> colour_map(std::span<const double> values) {
  std::vector<Rgb8> colours;
  colours.reserve(values.size());
  for (const float share : shares_of_range(values)) {
    colours.push_back(cool_warm(static_cast<double>(share)));
  }
  return colours;
}

const Vec3& linear_cool_warm(float share) {
  constexpr std::size_t kSteps = 2048;  // eight times as many as a channel has
  static const std::vector<Vec3> colours = [] {
    std::vector<Vec3> table;
    for (std::size_t i = 0; i <= kSteps; ++i) {
      table.push_back(linear_of_srgb(cool_warm(static_cast<double>(i) / kSteps)));
    }
    table.push_back(linear_of_srgb(kGrey));
    return table;
  }();
  return std::isnan(share) ? colours.back()
                           : colours[static_cast<std::size_t>(
                                 std::lround(std::clamp(share, 0.0F, 1.0F) * kSteps))];
}

}  // namespace vantage
