// SPDX-License-Identifier: MIT
#pragma once

#include <assimp/scene.h>

#include "stream_writer.h"

namespace vantage::importing {

/// Sends the meshes of a scene where its nodes put them, in the order of the file: those with bones as the
/// nodes of the bones hold them.
void send_meshes(const aiScene& scene, StreamWriter& out);

}  // namespace vantage::importing
