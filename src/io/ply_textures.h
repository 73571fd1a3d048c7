// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "vantage/mesh/appearance.h"

#include "io/model_builder.h"
#include "io/ply_header.h"
#include "io/readers.h"

namespace vantage {

/// The pictures that a PLY names ("comment TextureFile NAME") and how it lays them on its faces.
class PlyTextures {
 public:
  /// How faces name places on a picture.
  enum class Places { None, OfVertices, OfCorners };

  /// Reads the pictures if they are wanted. \param builder must outlive this; is told of what is
  /// left out.
  PlyTextures(const PlyHeader& header, const Surroundings& surroundings, ModelBuilder& builder);

  [[nodiscard]] Places places() const { return places_; }

  /// The material with this picture, counted from 0 in the order of the header; kNone if none has it.
  [[nodiscard]] std::uint32_t material(double number) const;

  /// Gives the builder the materials.
  void finish();

 private:
  void read(const PlyHeader& header, const Surroundings& surroundings);

  ModelBuilder& builder_;
  Places places_ = Places::None;
  std::vector<std::uint32_t> material_of_picture_{};
  std::vector<Texture> textures_{};
};

}  // namespace vantage
