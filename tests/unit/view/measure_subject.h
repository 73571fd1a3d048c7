// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include "vantage/mesh/measures.h"
#include "vantage/view/measure.h"

namespace vantage::test {

/// A subject with all that the built-in measures need.
struct Subject {
  explicit Subject(TriMesh shape, Projection projection = Projection::Orthographic)
      : mesh(std::move(shape)), kssm(mesh.positions.size(), 1.0) {
    given.surface = &mesh;
    given.sides = sides;
    given.camera = {.sphere = enclosing_sphere(mesh.positions), .projection = projection};
    given.kssm = kssm;
    graph.nodes = {given.camera.sphere.centre, given.camera.sphere.centre + Vec3::UnitX()};
    graph.edges = {{0, 1}};
    node_of_vertex.assign(mesh.positions.size(), 0);
    given.skeleton = &graph;
    given.node_of_vertex = node_of_vertex;
  }

  Subject(const Subject&) = delete;
  Subject& operator=(const Subject&) = delete;

  [[nodiscard]] double value(std::string_view name, const Vec3& direction) const {
    const ViewMeasurer measurer(given, {find_measure(name)}, 1);
    return measurer.values(std::vector<Vec3>{direction.normalized()})[0][0];
  }

  TriMesh mesh;
  std::vector<FaceSides> sides{FaceSides::Front};
  std::vector<double> kssm;
  CurveGraph graph{};
  std::vector<std::uint32_t> node_of_vertex{};
  MeasureSubject given{};
};

}  // namespace vantage::test
