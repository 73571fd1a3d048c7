// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "vantage/io/model.h"
#include "vantage/pipeline/shape_analysis.h"

/// \file
/// One object of a scene: its significance alone counts while all the others still hide it.

namespace vantage {

/// An object of a scene.
struct SceneObject {
  std::string name{};                     ///< As in the file; empty for an unnamed component.
  std::size_t faces = 0;                  ///< Triangles of it in the file.
  std::vector<std::uint32_t> vertices{};  ///< Of the surface, ascending.
};

/// The objects of a scene, numbered from 0: where the file names at least two (OBJ groups and
/// objects, glTF nodes, solids of STL) these, those of one name together and faces before the first
/// name as an object without one; else the components of the surface, by lowest vertex.
/// \pre shape is prepare_surface(model) or more.
std::vector<SceneObject> list_objects(const Model& model, const ShapeAnalysis& shape);

/// The object of this name, or else of this number.
/// \throw InvalidInput that says what there is if there is none such.
const SceneObject& find_object(const std::vector<SceneObject>& objects, std::string_view focus);

/// Sets the significance of everything but the object to 0, and thereby what `total` refers to. A
/// vertex that two objects share belongs to both. \pre the map is there.
void focus_on(ShapeAnalysis& shape, const SceneObject& object);

}  // namespace vantage
