// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include <nlohmann/json_fwd.hpp>

#include "io/gltf_document.h"
#include "io/model_builder.h"

namespace vantage {

/// Member of a primitive's extras in GltfDocument::structure: its place among the primitives of the
/// file, in order of appearance. The reader of the structure may leave out malformed ones.
inline constexpr const char* kPrimitiveNumber = "primitive";

/// Whether a buffer only stands in for readers that cannot unpack: its bytes are not needed.
bool is_fallback_buffer(const nlohmann::json& buffer);

/// Whether the indices and attributes of a primitive are packed by Draco.
bool is_packed_primitive(const nlohmann::json& primitive);

/// Unpacks what EXT_meshopt_compression and KHR_draco_mesh_compression hold and appends it to the
/// document as buffers, buffer views and accessors, so that no later reader needs to know. In all
/// it may take as much memory as total_bytes allows.
/// \pre document.structure and document.buffers are there. \throw FormatError
void unpack_gltf(const nlohmann::json& root, GltfDocument& document, const ModelBuilder& builder);

}  // namespace vantage
