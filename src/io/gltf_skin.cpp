// SPDX-License-Identifier: MIT
#include "io/gltf_skin.h"

#include <string>

namespace vantage {

GltfSkin::GltfSkin(const GltfDocument& document, int skin, GltfNodes& nodes,
                   const ModelBuilder& builder) {
  const std::vector<tinygltf::Skin>& skins = document.structure.skins;
  if (skin < 0 || static_cast<std::size_t>(skin) >= skins.size()) {
    builder.fail("skin " + std::to_string(skin) + " does not exist");
  }
  const tinygltf::Skin& held = skins[static_cast<std::size_t>(skin)];
  if (held.joints.size() > document.structure.nodes.size()) {
    builder.fail("skin " + std::to_string(skin) + " has more joints than there are nodes");
  }
  for (const int joint : held.joints) {
    joints_.push_back(nodes.world(joint));
  }
  if (held.inverseBindMatrices < 0) {
    return;
  }
  const GltfAccessor inverse(document, held.inverseBindMatrices, document.total_bytes, builder);
  if (inverse.components() != 16 || inverse.count() < joints_.size()) {
    builder.fail("the inverse bind matrices of skin " + std::to_string(skin) +
                 " are not one matrix a joint");
  }
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    Eigen::Matrix4d bind;
    for (int k = 0; k < 16; ++k) {
      bind(k % 4, k / 4) = inverse.value(j, k);  // by columns
    }
    joints_[j] *= bind;
  }
}

std::size_t GltfSkinnedVertices::sets_of(const tinygltf::Primitive& primitive) {
  std::size_t sets = 0;
  while (primitive.attributes.count("JOINTS_" + std::to_string(sets)) > 0 &&
         primitive.attributes.count("WEIGHTS_" + std::to_string(sets)) > 0) {
    ++sets;
  }
  return sets;
}

GltfSkinnedVertices::GltfSkinnedVertices(const GltfDocument& document,
                                         const tinygltf::Primitive& primitive, std::size_t count,
                                         const GltfSkin& skin, const ModelBuilder& builder)
    : skin_(skin), builder_(builder) {
  const auto accessor = [&](const char* name, std::size_t set) {
    return GltfAccessor(document, primitive.attributes.at(name + std::to_string(set)), count,
                        builder);
  };
  const std::size_t sets = sets_of(primitive);
  for (std::size_t set = 0; set < sets; ++set) {
    sets_.push_back({accessor("JOINTS_", set), accessor("WEIGHTS_", set)});
    const Set& added = sets_.back();
    if (added.joints.count() != count || added.weights.count() != count ||
        added.joints.components() != 4 || added.weights.components() != 4 ||
        !added.joints.is_integer()) {
      builder.fail("the joints and weights of a primitive do not fit its positions");
    }
  }
}

Eigen::Matrix4d GltfSkinnedVertices::transform(std::size_t vertex) const {
  Eigen::Matrix4d sum = Eigen::Matrix4d::Zero();
  double weights = 0.0;
  for (const Set& set : sets_) {
    for (int c = 0; c < 4; ++c) {
      const double weight = set.weights.value(vertex, c);
      if (weight == 0.0) {
        continue;
      }
      const auto joint = static_cast<std::size_t>(set.joints.value(vertex, c));
      if (joint >= skin_.joints().size()) {
        builder_.fail("a vertex is held by joint " + std::to_string(joint) + " of " +
                      std::to_string(skin_.joints().size()));
      }
      sum += weight * skin_.joints()[joint];
      weights += weight;
    }
  }
  return weights > 0.0 ? Eigen::Matrix4d(sum / weights) : Eigen::Matrix4d::Identity();
}

}  // namespace vantage
