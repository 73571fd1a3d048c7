// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <tiny_gltf.h>

#include "io/model_builder.h"
#include "io/readers.h"

namespace vantage {

/// Whether a primitive, as its extras say, has morph targets; they are not read.
bool is_morphed_primitive(const tinygltf::Primitive& primitive);

/// A glTF file: its structure as tinygltf reads it, and its buffers as we read them.
struct GltfDocument {
  tinygltf::Model structure{};         ///< Scenes, nodes, meshes, accessors, buffer views.
  std::vector<SharedBytes> buffers{};  ///< All bytes of each buffer; none is null.
  /// Of each material, linear, in [0, 1].
  std::vector<std::array<double, 3>> base_colours{};
  /// Which TEXCOORD_n the colour texture of each material uses.
  std::vector<int> texcoord_sets{};
  /// Whether what shows a material may be clear: that it is not said to be opaque.
  std::vector<bool> counts_opacity{};
  std::vector<bool> hidden_nodes{};  ///< Nodes that are not shown, nor what is below them.
  std::size_t total_bytes = 0;       ///< Of the file and its buffers, each counted once.
  std::size_t unpacked_bytes = 0;    ///< Of what was packed in them.
};

/// Reads the container, the JSON and the buffers. tinygltf sees only the part of the JSON that
/// describes geometry: no pictures, no extras of the file, no URIs, hence no file access and no deep nesting. If
/// the builder keeps what faces look like, it receives the materials too.
/// \throw FormatError, IoError
GltfDocument read_gltf_document(std::string_view bytes, const Surroundings& surroundings,
                                ModelBuilder& builder);

}  // namespace vantage
