// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "io/gltf_document.h"
#include "io/model_builder.h"

namespace vantage {

/// What a node does to what is below it. \throw FormatError
Eigen::Matrix4d gltf_local_transform(const tinygltf::Node& node, std::size_t index,
                                     const ModelBuilder& builder);

/// Where nodes stand in the scene, for joints, which skins name by their index.
class GltfNodes {
 public:
  /// Refers to both.
  GltfNodes(const GltfDocument& document, const ModelBuilder& builder);

  /// \throw FormatError if there is no such node, or it is its own ancestor.
  /// \complexity O(1) a node on the way to one that was asked about, or to the scene.
  const Eigen::Matrix4d& world(int node);

 private:
  const std::vector<tinygltf::Node>& nodes_;
  const ModelBuilder& builder_;
  std::vector<int> parent_;                              // of each node, or −1
  std::vector<std::optional<Eigen::Matrix4d>> world_{};  // of those asked about and above them
};

}  // namespace vantage
