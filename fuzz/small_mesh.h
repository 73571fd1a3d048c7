// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "vantage/io/model.h"
#include "vantage/pipeline/view_options.h"
#include "vantage/spatial/directions.h"

/// Any mesh on a small grid, so that coincidences abound: the first byte tells how many vertices there are; the
/// rest are their coordinates, then corners. \pre size is from kLeastMeshBytes to kMostMeshBytes
inline vantage::Model small_mesh(const std::uint8_t* data, std::size_t size) {
  constexpr std::size_t kMostFaces = 64;
  vantage::Model model;
  model.name = "fuzz";
  const std::size_t vertices = std::min<std::size_t>(data[0] % 64U + 3U, (size - 1) / 3);
  std::size_t at = 1;
  for (std::size_t v = 0; v < vertices; ++v, at += 3) {
    model.mesh.positions.emplace_back(data[at] % 16U, data[at + 1] % 16U, data[at + 2] % 16U);
  }
  for (; at + 2 < size && model.mesh.triangles.size() < kMostFaces && vertices > 0; at += 3) {
    const auto corner = [&](std::size_t i) {
      return static_cast<std::uint32_t>(data[i] % vertices);
    };
    model.mesh.triangles.push_back({corner(at), corner(at + 1), corner(at + 2)});
  }
  // The scale must not matter: the last bit of the first byte takes it far away.
  const double scale = (data[0] & 0x80U) != 0 ? 1e60 : 1e-60;
  if ((data[0] & 0x40U) != 0) {
    for (vantage::Vec3& p : model.mesh.positions) {
      p *= scale;
    }
  }
  model.polygons = model.mesh.triangles.size();
  return model;
}

inline constexpr std::size_t kLeastMeshBytes = 10;
inline constexpr std::size_t kMostMeshBytes = 512;

/// A closed surface of 42 vertices, of which each byte pulls one outwards.
inline vantage::Model small_star(const std::uint8_t* data, std::size_t size) {
  const vantage::DirectionSet sphere =
      vantage::direction_set(vantage::ViewSphereBase::Icosahedron, 1);
  vantage::Model model;
  model.name = "fuzz";
  model.mesh = {.positions = sphere.directions, .triangles = sphere.triangles};
  for (std::size_t v = 0; v < model.mesh.positions.size() && v < size; ++v) {
    model.mesh.positions[v] *= 1.0 + data[v] / 64.0;
  }
  model.polygons = model.mesh.triangles.size();
  return model;
}

/// What a run over such a mesh takes least time with.
inline vantage::ViewOptions quick_options() {
  vantage::ViewOptions options;
  options.search.strategy = vantage::SearchStrategy::Rapid;
  // So few faces are all huge: refining them first takes a hundred times longer than all else.
  options.contraction.method = vantage::ContractionMethod::Exact;
  return options;
}
