// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "vantage/core/image.h"
#include "vantage/mesh/tri_mesh.h"

/// \file
/// How a file wants its surface to look: colours, pictures laid on it, holes and glass.

namespace vantage {

/// What a texture shows beyond its borders.
enum class TextureWrap { Repeat, Mirror, Clamp };

/// A picture to lay on a surface. Its coordinates run from (0, 0) at the top left corner to (1, 1) at
/// the bottom right one.
struct Texture {
  Image image{};                             ///< sRGB with straight alpha.
  TextureWrap wrap_u = TextureWrap::Repeat;  ///< From left to right.
  TextureWrap wrap_v = TextureWrap::Repeat;  ///< From top to bottom.
  bool nearest = false;  ///< Magnified as squares, as pixel art is, not smoothly.
};

/// What the opacity of a place means.
enum class AlphaMode {
  Opaque,  ///< Nothing.
  Mask,    ///< Below `alpha_cutoff` there is a hole, else it is opaque.
  Blend,   ///< What is behind shows through.
};

/// A material; its colours are multiplied by each other and by those of the vertices.
struct Material {
  std::array<double, 3> colour{1.0, 1.0, 1.0};  ///< Linear, in [0, 1].
  double opacity = 1.0;                         ///< In [0, 1], times that of the texture.
  AlphaMode alpha = AlphaMode::Opaque;          ///< What the opacity means.
  double alpha_cutoff = 0.5;                    ///< In [0, 1].
  bool unlit = false;                           ///< Shown as it is, without light or shade.
  std::optional<std::uint32_t> texture{};       ///< Index into Appearance::textures.
  std::array<double, 3> emission{};             ///< Light of its own, linear, in [0, 1].
  /// Index of the picture that it is multiplied by; it lies as `texture` does.
  std::optional<std::uint32_t> emission_texture{};
  /// Rows of the map from a surface's coordinates to the texture's: (u', v') = (a u + b v + c, …).
  std::array<double, 6> uv_transform{1.0, 0.0, 0.0, 0.0, 1.0, 0.0};
};

/// Materials of a mesh. Both sides of a face are shown alike.
struct Appearance {
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  std::vector<Material> materials{};                  ///< Empty: nothing is known.
  std::vector<Texture> textures{};                    ///< Each picture once.
  std::vector<std::uint32_t> material_of_triangle{};  ///< |F|, kNone for faces without one.
  std::vector<std::array<float, 2>> uvs{};            ///< Finite coordinates on textures.
  std::vector<Triangle> uv_of_triangle{};  ///< |F| corners' uvs, kNone without; or empty.
};

}  // namespace vantage
