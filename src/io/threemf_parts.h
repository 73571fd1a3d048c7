// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "vantage/mesh/appearance.h"
#include "vantage/mesh/tri_mesh.h"

#include "io/model_builder.h"

namespace vantage {

/// Rows as 3MF writes them: a point is a row in front of it, the last row shifts.
using ThreemfTransform = Eigen::Matrix<double, 4, 3>;

/// An object shown somewhere.
struct ThreemfUse {
  std::string part{};  ///< Of the package; empty: the one that says so.
  std::uint32_t object = 0;
  ThreemfTransform transform{};
};

/// Either a mesh, or other objects put together.
struct ThreemfObject {
  std::string name{};
  bool is_model = true;  ///< Not a support or the like.
  std::vector<Vec3> points{};
  std::vector<Triangle> triangles{};
  std::vector<std::uint32_t> materials{};  ///< One a triangle: index into ThreemfPart::materials.
  std::vector<ThreemfUse> components{};
};

/// What one part of the package, an XML file, says.
struct ThreemfPart {
  std::string unit = "millimeter";
  std::map<std::uint32_t, ThreemfObject> objects{};
  std::vector<ThreemfUse> items{};    ///< What is to be built.
  std::vector<Material> materials{};  ///< Colours only.
  bool needs_double = false;          ///< Coordinates say more than a float holds.
};

/// Reads a part of the type 3D model, piece by piece. A document type, and with it every entity, is
/// refused.
class ThreemfPartReader {
 public:
  /// \param name of the part, for messages. Both must outlive this.
  ThreemfPartReader(const std::string& name, const ModelBuilder& builder);
  ~ThreemfPartReader();
  ThreemfPartReader(const ThreemfPartReader&) = delete;
  ThreemfPartReader& operator=(const ThreemfPartReader&) = delete;

  /// \throw FormatError
  void add(std::string_view piece);
  ThreemfPart finish();

 private:
  class State;
  std::unique_ptr<State> state_;
};

/// The part that is the model, by the package's relationships ("_rels/.rels"); empty if they do not
/// say.
std::string threemf_root(std::string_view relationships);

}  // namespace vantage
