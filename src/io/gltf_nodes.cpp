// SPDX-License-Identifier: MIT
#include "io/gltf_nodes.h"

#include <string>

#include <Eigen/Geometry>

#include "vantage/mesh/tri_mesh.h"

namespace vantage {

Eigen::Matrix4d gltf_local_transform(const tinygltf::Node& node, std::size_t index,
                                     const ModelBuilder& builder) {
  const auto has_size = [&](const std::vector<double>& values, std::size_t size) {
    if (!values.empty() && values.size() != size) {
      builder.fail("the transform of node " + std::to_string(index) + " has " +
                   std::to_string(values.size()) + " numbers instead of " + std::to_string(size));
    }
    return !values.empty();
  };
  if (has_size(node.matrix, 16)) {
    return Eigen::Map<const Eigen::Matrix4d>(node.matrix.data());  // both are column-major
  }
  Eigen::Affine3d transform = Eigen::Affine3d::Identity();
  if (has_size(node.translation, 3)) {
    transform.translate(Eigen::Map<const Vec3>(node.translation.data()));
  }
  if (has_size(node.rotation, 4)) {
    Eigen::Quaterniond turn(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]);
    if (!(turn.norm() > 0.0)) {
      builder.fail("the rotation of node " + std::to_string(index) + " is zero");
    }
    transform.rotate(turn.normalized());
  }
  if (has_size(node.scale, 3)) {
    transform.scale(Eigen::Map<const Vec3>(node.scale.data()));
  }
  return transform.matrix();
}

GltfNodes::GltfNodes(const GltfDocument& document, const ModelBuilder& builder)
    : nodes_(document.structure.nodes),
      builder_(builder),
      parent_(nodes_.size(), -1),
      world_(nodes_.size()) {
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    for (const int child : nodes_[n].children) {
      if (child >= 0 && static_cast<std::size_t>(child) < parent_.size()) {
        parent_[static_cast<std::size_t>(child)] = static_cast<int>(n);
      }
    }
  }
}

const Eigen::Matrix4d& GltfNodes::world(int node) {
  if (node < 0 || static_cast<std::size_t>(node) >= nodes_.size()) {
    builder_.fail("node " + std::to_string(node) + " does not exist");
  }
  std::vector<std::size_t> way;  // up to the scene, or to a node that is known
  for (int at = node; at >= 0 && !world_[static_cast<std::size_t>(at)];
       at = parent_[static_cast<std::size_t>(at)]) {
    way.push_back(static_cast<std::size_t>(at));
    if (way.size() > nodes_.size()) {
      builder_.fail("node " + std::to_string(node) + " is its own ancestor");
    }
  }
  for (; !way.empty(); way.pop_back()) {
    const std::size_t n = way.back();
    const Eigen::Matrix4d local = gltf_local_transform(nodes_[n], n, builder_);
    world_[n] = parent_[n] < 0 ? local : *world_[static_cast<std::size_t>(parent_[n])] * local;
  }
  return *world_[static_cast<std::size_t>(node)];
}

}  // namespace vantage
