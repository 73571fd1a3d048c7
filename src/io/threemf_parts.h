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

/// The transform that leaves everything where it is.
inline ThreemfTransform unmoved() {
  return (ThreemfTransform() << 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0)
      .finished();
}

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
  std::size_t unprinted = 0;          ///< Items that are not to be printed.
  bool has_unread_materials = false;  ///< Textures or mixtures.
  /// Extensions that the part needs and nobody reads here: the ends of their namespaces.
  std::vector<std::string> unread_extensions{};
};

/// Names of elements, attributes and namespaces that are not those of 3MF; each is kept. [ours]
inline constexpr std::size_t kMostThreemfNames = 10'000;
/// Elements may be nested this deep: the format needs six levels. [ours]
inline constexpr int kDeepestThreemfElement = 64;
/// Bytes that an element with its attributes, or a comment, may have: names are the longest. [ours]
inline constexpr std::size_t kLongestThreemfElement = 1'000'000;

/// Reads a part of the type 3D model, piece by piece. A document type, and with it every entity, is
/// refused.
class ThreemfPartReader {
 public:
  /// \param name of the part, for messages. \param records_left objects, uses of them and colours that
  /// may still be read; counts down. All must outlive this.
  ThreemfPartReader(const std::string& name, const ModelBuilder& builder,
                    std::size_t& records_left);
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
