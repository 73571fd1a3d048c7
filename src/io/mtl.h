// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <map>
#include <string>
#include <string_view>

namespace vantage {

/// A picture that a material names, and how it lies.
struct MtlMap {
  std::string name{};                      ///< As written; empty if there is none.
  bool clamp = false;                      ///< -clamp on.
  std::array<double, 2> scale{1.0, 1.0};   ///< -s
  std::array<double, 2> offset{0.0, 0.0};  ///< -o

  [[nodiscard]] bool lies_as(const MtlMap& other) const {
    return clamp == other.clamp && scale == other.scale && offset == other.offset;
  }
};

/// What a material of a Wavefront library says that we show.
struct MtlMaterial {
  std::array<double, 3> colour{1.0, 1.0, 1.0};  ///< Kd, encoded as sRGB by custom, in [0, 1].
  double opacity = 1.0;                         ///< d, or 1 − Tr without d.
  bool has_d = false;                           ///< Some programs write Tr for what others call d.
  MtlMap picture{};                             ///< map_Kd
  MtlMap mask{};                                ///< map_d
};

/// The materials of a library by name; of several of one name the first counts. What is not well
/// formed is passed over.
std::map<std::string, MtlMaterial, std::less<>> parse_mtl(std::string_view text);

}  // namespace vantage
