// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "vantage/io/model.h"

#include "io/byte_cursor.h"
#include "unit/io/error_text.h"
#include "unit/io/glb_bytes.h"

namespace vantage::test {

/// Four points of a unit square (48 bytes) and the indices 0 1 2 3 as bytes.
inline std::string square_bytes() {
  std::string bytes;
  for (const float value : {0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F, 0.F, 1.F, 1.F, 0.F}) {
    append_little_endian(bytes, value);
  }
  return bytes + std::string("\0\1\2\3", 4);
}

/// The parts of a file that a test may change.
struct Scene {
  std::string nodes = R"([{"mesh":0}])";
  std::string primitive = R"({"attributes":{"POSITION":0},"indices":1,"mode":5})";
  std::string accessors =
      R"({"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},
         {"bufferView":1,"componentType":5121,"count":4,"type":"SCALAR"})";
  std::string views = R"({"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":4})";
  std::string more{};  ///< Further members of the root, each with a comma in front.
  std::string buffer = R"({"byteLength":52})";
  std::string binary = square_bytes();

  [[nodiscard]] std::string bytes() const {
    return glb(R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":)" + nodes +
                   R"(,"meshes":[{"name":"m","primitives":[)" + primitive + R"(]}],"accessors":[)" +
                   accessors + R"(],"bufferViews":[)" + views + R"(],"buffers":[)" + buffer + "]" +
                   more + "}",
               binary);
  }

  [[nodiscard]] Model parsed() const { return parse_model(bytes(), "a.glb"); }

  [[nodiscard]] std::string error() const { return error_text(bytes(), "a.glb"); }
};

}  // namespace vantage::test
