// SPDX-License-Identifier: MIT
#pragma once

#include <utility>

#include "vantage/io/model.h"

namespace vantage::test {

/// A model as a reader would give it, around a procedural mesh.
inline Model model_of(TriMesh mesh) {
  Model model;
  model.name = "shape";
  model.polygons = mesh.triangles.size();
  model.mesh = std::move(mesh);
  return model;
}

}  // namespace vantage::test
