// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include <Eigen/Core>

#include "io/gltf_accessor.h"
#include "io/gltf_nodes.h"

namespace vantage {

/// What a skin does to vertices while its joints stand as their nodes do (glTF 2.0, section 3.7.3).
class GltfSkin {
 public:
  /// \throw FormatError
  GltfSkin(const GltfDocument& document, int skin, GltfNodes& nodes, const ModelBuilder& builder);

  /// One matrix a joint: from where its vertices were bound to where they are.
  [[nodiscard]] const std::vector<Eigen::Matrix4d>& joints() const { return joints_; }

 private:
  std::vector<Eigen::Matrix4d> joints_{};
};

/// The vertices of a primitive that a skin holds.
class GltfSkinnedVertices {
 public:
  /// How many sets of joints and weights the primitive has; each holds every vertex.
  static std::size_t sets_of(const tinygltf::Primitive& primitive);

  /// Refers to `skin`. \param count of vertices. \throw FormatError
  GltfSkinnedVertices(const GltfDocument& document, const tinygltf::Primitive& primitive,
                      std::size_t count, const GltfSkin& skin, const ModelBuilder& builder);

  /// Whether the primitive says which joints hold its vertices.
  [[nodiscard]] bool are_held() const { return !sets_.empty(); }

  /// The mean of its joints' matrices by their weights; the identity if no joint has any.
  /// \throw FormatError
  [[nodiscard]] Eigen::Matrix4d transform(std::size_t vertex) const;

 private:
  struct Set {
    GltfAccessor joints, weights;
  };

  const GltfSkin& skin_;
  const ModelBuilder& builder_;
  std::vector<Set> sets_{};  // four joints a vertex each
};

}  // namespace vantage
