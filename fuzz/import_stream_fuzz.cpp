// SPDX-License-Identifier: MIT
// Whatever vantage-import sends gives a model with valid indices and finite points, or a FormatError.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "vantage/core/error.h"
#include "vantage/io/model.h"
#include "vantage/mesh/mesh_check.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto sent = [&](const vantage::ImportRequest&, const vantage::RunContext&) {
    return std::string(reinterpret_cast<const char*>(data), size);
  };
  try {
    const vantage::Model model =
        vantage::parse_model("?", "fuzz.fbx", {}, {.appearance = true, .importer = sent});
    for (const vantage::Vec3& point : model.mesh.positions) {
      if (!point.allFinite()) {
        std::abort();
      }
    }
    const vantage::Appearance& look = model.appearance;
    for (const vantage::Material& material : look.materials) {
      if (material.texture && *material.texture >= look.textures.size()) {
        std::abort();
      }
    }
    // Looks at every index.
    if (vantage::check_mesh(model.mesh).faces != model.mesh.triangles.size()) {
      std::abort();
    }
  } catch (const vantage::FormatError&) {
    return 0;
  }
  return 0;
}
