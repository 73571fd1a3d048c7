// SPDX-License-Identifier: MIT
// Any bytes as a mesh packed by Draco or as a buffer view packed by meshopt, in a file that is sound
// around them: a model with finite points, or a FormatError. The first bytes choose.
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "vantage/core/error.h"
#include "vantage/io/model.h"

#include "io/byte_cursor.h"
#include "io/draco_mesh.h"

namespace {

using vantage::DracoMesh;

void unpack_by_draco(std::string_view bytes) {
  constexpr std::size_t kMost = 1 << 16;  // so that a run is quick
  const DracoMesh mesh = vantage::unpack_draco(bytes, {{0, 5126, 3}, {1, 5121, 4}}, kMost);
  if (!mesh.problem.empty()) {
    return;
  }
  if (mesh.attributes[0].size() != mesh.points * 12 || mesh.corners.size() % 12 != 0) {
    std::abort();
  }
  for (std::size_t at = 0; at < mesh.corners.size(); at += 4) {
    if (vantage::decode<std::uint32_t>(mesh.corners.data() + at, vantage::ByteOrder::Little) >=
        mesh.points) {
      std::abort();
    }
  }
}

std::string glb(std::string json, std::string binary) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  binary.resize((binary.size() + 3) / 4 * 4, '\0');
  std::string bytes = "glTF";
  vantage::append_little_endian(bytes, std::uint32_t{2});
  vantage::append_little_endian(bytes,
                                static_cast<std::uint32_t>(28 + json.size() + binary.size()));
  vantage::append_little_endian(bytes, static_cast<std::uint32_t>(json.size()));
  bytes += "JSON" + json;
  vantage::append_little_endian(bytes, static_cast<std::uint32_t>(binary.size()));
  return bytes + std::string("BIN\0", 4) + binary;
}

void unpack_by_meshopt(std::uint8_t choice, std::uint8_t stride, std::uint8_t count,
                       std::string_view bytes) {
  constexpr std::array<const char*, 3> kModes{"ATTRIBUTES", "TRIANGLES", "INDICES"};
  constexpr std::array<const char*, 4> kFilters{"NONE", "OCTAHEDRAL", "QUATERNION", "EXPONENTIAL"};
  const std::string json =
      R"({"asset":{"version":"2.0"},"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"mode":0,)"
      R"("attributes":{"POSITION":0}}]}],"accessors":[{"bufferView":0,"componentType":5126,)"
      R"("count":)" +
      std::to_string(count) +
      R"(,"type":"VEC3"}],"bufferViews":[{"buffer":0,"byteLength":1,"byteStride":12,)"
      R"("extensions":{"EXT_meshopt_compression":{"buffer":0,"byteLength":)" +
      std::to_string(bytes.size()) + R"(,"byteStride":)" + std::to_string(stride) + R"(,"count":)" +
      std::to_string(count) + R"(,"mode":")" + kModes[choice % 3] + R"(","filter":")" +
      kFilters[choice / 3 % 4] + R"("}}}],"buffers":[{"byteLength":)" +
      std::to_string(bytes.size()) + "}]}";
  for (const vantage::Vec3& point :
       vantage::parse_model(glb(json, std::string(bytes)), "fuzz.glb").mesh.positions) {
    if (!point.allFinite()) {
      std::abort();
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  if (bytes.starts_with("DRACO")) {
    unpack_by_draco(bytes);
    return 0;
  }
  if (size < 3) {
    return 0;
  }
  try {
    unpack_by_meshopt(data[0], data[1], data[2], bytes.substr(3));
  } catch (const vantage::FormatError&) {
    return 0;
  }
  return 0;
}
