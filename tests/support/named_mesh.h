// SPDX-License-Identifier: MIT
#pragma once

#include <ostream>
#include <string>

#include "vantage/mesh/tri_mesh.h"

namespace vantage::test {

/// A parameter of tests: a mesh that failures call by its name.
struct NamedMesh {
  std::string name;
  TriMesh mesh;
};

inline std::ostream& operator<<(std::ostream& out, const NamedMesh& shape) {
  return out << shape.name;
}

}  // namespace vantage::test
