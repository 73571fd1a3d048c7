// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <functional>
#include <optional>
#include <string_view>

#include "vantage/core/error.h"
#include "vantage/io/model.h"

#include "io/readers.h"

/// Aborts where a reader gave what no caller may be given.
inline void expect_sound(const vantage::Model& model) {
  for (const vantage::Vec3& point : model.mesh.positions) {
    if (!point.allFinite()) {
      std::abort();
    }
  }
  for (const vantage::Triangle& t : model.mesh.triangles) {
    if (std::max({t[0], t[1], t[2]}) >= model.mesh.positions.size()) {
      std::abort();
    }
  }
  const vantage::Appearance& look = model.appearance;
  for (const vantage::Material& material : look.materials) {
    if (material.texture && *material.texture >= look.textures.size()) {
      std::abort();
    }
  }
  std::size_t last = 0;
  for (const vantage::ModelPart& part : model.parts) {
    if (part.first_triangle < last || part.triangle_count > model.mesh.triangles.size() ||
        part.first_triangle > model.mesh.triangles.size() - part.triangle_count) {
      std::abort();
    }
    last = part.first_triangle;
  }
}

/// What a reader makes of a document, sound; nothing if it refuses it.
inline std::optional<vantage::Model> sound_model(const std::function<vantage::Model()>& read) {
  try {
    vantage::Model model = read();
    expect_sound(model);
    return model;
  } catch (const vantage::FormatError&) {
    return std::nullopt;
  } catch (const vantage::IoError&) {  // of files beside it
    return std::nullopt;
  }
}

/// Aborts unless both are refused, or both hold the same places and corners.
inline void expect_same(const std::optional<vantage::Model>& one,
                        const std::optional<vantage::Model>& other) {
  if (one.has_value() != other.has_value() ||
      (one && (one->mesh.positions != other->mesh.positions ||
               one->mesh.triangles != other->mesh.triangles))) {
    std::abort();
  }
}

/// Aborts unless a limit of one face less than the model has refuses it.
inline void expect_limit(const vantage::Model& model,
                         const std::function<vantage::Model(std::size_t most)>& read) {
  const std::size_t faces = model.mesh.triangles.size();
  if (faces > 1 && sound_model([&] { return read(faces - 1); })) {
    std::abort();
  }
}
