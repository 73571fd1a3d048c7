// SPDX-License-Identifier: MIT
#include <algorithm>
#include <charconv>
#include <map>

#include "vantage/core/error.h"
#include "vantage/mesh/topology.h"
#include "vantage/pipeline/shape_analysis.h"

namespace vantage {
namespace {

// Names shown when one is not found.
constexpr std::size_t kShownNames = 5;

void make_ascending(std::vector<std::uint32_t>& vertices) {
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
}

/// \throw InvalidInput if a part has triangles that the model has not.
void check_parts(const Model& model) {
  const std::size_t triangles = model.mesh.triangles.size();
  for (const ModelPart& part : model.parts) {
    if (part.first_triangle > triangles || part.triangle_count > triangles - part.first_triangle) {
      throw InvalidInput("part '" + part.name + "' has " + std::to_string(part.triangle_count) +
                         " triangles from number " + std::to_string(part.first_triangle) +
                         " on, but the model has only " + std::to_string(triangles) +
                         ": empty its parts, or make them fit");
    }
  }
}

std::vector<SceneObject> named_objects(const Model& model, const ShapeAnalysis& shape) {
  std::vector<SceneObject> objects;
  std::map<std::string, std::size_t> number_of_name;
  const auto add = [&](const std::string& name, std::size_t first, std::size_t end) {
    if (first >= end) {
      return;
    }
    const auto [entry, fresh] = number_of_name.try_emplace(name, objects.size());
    if (fresh) {
      objects.push_back({.name = name});
    }
    SceneObject& object = objects[entry->second];
    object.faces += end - first;
    for (std::size_t f = first; f < end; ++f) {
      for (const std::uint32_t v : model.mesh.triangles[f]) {
        object.vertices.push_back(shape.surface_vertex[v]);
      }
    }
  };
  check_parts(model);
  std::size_t named = 0;  // faces up to here belong to an object
  for (const ModelPart& part : model.parts) {
    add("", named, part.first_triangle);
    named = part.first_triangle + part.triangle_count;
    add(part.name, part.first_triangle, named);
  }
  add("", named, model.mesh.triangles.size());
  for (SceneObject& object : objects) {
    make_ascending(object.vertices);
  }
  return objects;
}

std::vector<SceneObject> component_objects(const ShapeAnalysis& shape) {
  const Components components = connected_components(shape.surface);
  constexpr std::size_t kNone = ~std::size_t{0};
  std::vector<std::size_t> object_of_component(components.count, kNone);
  std::vector<std::uint8_t> has_face(shape.surface.positions.size(), 0);
  for (const Triangle& t : shape.surface.triangles) {
    has_face[t[0]] = has_face[t[1]] = has_face[t[2]] = 1;
  }
  std::vector<SceneObject> objects;
  for (std::uint32_t v = 0; v < shape.surface.positions.size(); ++v) {
    std::size_t& object = object_of_component[components.of_vertex[v]];
    if (has_face[v] == 0) {
      continue;
    }
    if (object == kNone) {
      object = objects.size();
      objects.emplace_back();
    }
    objects[object].vertices.push_back(v);
  }
  for (const Triangle& t : shape.surface.triangles) {
    ++objects[object_of_component[components.of_vertex[t[0]]]].faces;
  }
  return objects;
}

}  // namespace

std::vector<SceneObject> list_objects(const Model& model, const ShapeAnalysis& shape) {
  std::vector<SceneObject> objects = named_objects(model, shape);
  return objects.size() > 1 ? objects : component_objects(shape);
}

const SceneObject& find_object(const std::vector<SceneObject>& objects, std::string_view focus) {
  for (const SceneObject& object : objects) {
    if (!object.name.empty() && object.name == focus) {
      return object;
    }
  }
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(focus.data(), focus.data() + focus.size(), number);
  if (error == std::errc{} && end == focus.data() + focus.size() && number < objects.size()) {
    return objects[number];
  }
  std::string names;
  std::size_t shown = 0;
  for (const SceneObject& object : objects) {
    if (!object.name.empty() && shown++ < kShownNames) {
      names += (shown == 1 ? ", or one of the names '" : "', '") + object.name;
    }
  }
  names += shown > 0 ? "'" : "";
  names += shown > kShownNames ? ", …" : "";
  throw InvalidInput("there is no object '" + std::string(focus) + "' to focus on; " +
                     (objects.size() > 1 ? "choose 0 to " + std::to_string(objects.size() - 1)
                                         : std::string("the only one is 0")) +
                     names + " (vantage info lists them)");
}

ShapeAnalysis prepare_surface(const Model& model, const ViewOptions& options,
                              const RunContext& run) {
  ShapeAnalysis shape = prepare_surface(model, run);
  if (!options.focus.empty()) {
    shape.focus = find_object(list_objects(model, shape), options.focus).vertices;
  }
  return shape;
}

}  // namespace vantage
