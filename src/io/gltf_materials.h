// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include <nlohmann/json.hpp>

#include "io/gltf_document.h"
#include "io/model_builder.h"
#include "io/readers.h"

namespace vantage {

/// The linear colour of each material, in [0, 1]; white where the file says nothing that makes sense.
std::vector<std::array<double, 3>> gltf_base_colours(const nlohmann::json& root);

/// Which TEXCOORD_n each material's textures use.
std::vector<int> gltf_texcoord_sets(const nlohmann::json& root);

/// Whether the opacity of each material counts: that it is not said to be opaque.
std::vector<bool> gltf_counts_opacity(const nlohmann::json& root);

/// Reads materials and the pictures that their colour textures show into the builder: base colour or,
/// of KHR_materials_pbrSpecularGlossiness, diffuse colour; KHR_texture_transform, EXT_texture_webp,
/// KHR_materials_unlit, emission with KHR_materials_emissive_strength. Their colours stay white: the reader gives them to the vertices.
/// \param document with its buffers.
void read_gltf_materials(const nlohmann::json& root, const GltfDocument& document,
                         const Surroundings& surroundings, ModelBuilder& builder);

}  // namespace vantage
