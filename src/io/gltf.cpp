// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "vantage/core/error.h"

#include "core/srgb.h"
#include "io/gltf_accessor.h"
#include "io/gltf_document.h"
#include "io/gltf_nodes.h"
#include "io/gltf_skin.h"
#include "io/gltf_triangles.h"
#include "io/model_builder.h"
#include "io/readers.h"
#include "io/reuse_budget.h"

namespace vantage {
namespace {

using Transform = Eigen::Matrix4d;

/// Nodes may be visited this often, and once more for each byte of the file. A valid file visits
/// each node once; some exporters share subtrees, and a malicious one doubles at every level.
constexpr std::size_t kMostVisitsInSmallFile = 10'000;

class SceneReader {
 public:
  SceneReader(const GltfDocument& document, ModelBuilder& builder)
      : document_(document),
        gltf_(document.structure),
        builder_(builder),
        of_mesh_(document.structure.meshes.size()) {}

  void read() {
    is_counting_ = true;  // before anything is made
    walk();
    is_counting_ = false;
    walk();
    if (shapeless_primitives_ > 0) {
      builder_.note("primitives without positions left out: " +
                    std::to_string(shapeless_primitives_));
    }
    if (uncoloured_primitives_ > 0) {
      builder_.note("colours of vertices that cannot be read were left out (" +
                    std::to_string(uncoloured_primitives_) + " of such)");
    }
    if (untextured_primitives_ > 0) {
      builder_.note("texture coordinates of a primitive left out: they are not in the file (" +
                    std::to_string(untextured_primitives_) + " of such)");
    }
    if (hidden_nodes_ > 0) {
      builder_.note("nodes that the file hides left out, with all below them: " +
                    std::to_string(hidden_nodes_));
    }
    if (has_clear_) {
      builder_.note("the opacity of vertices was left out; their colours are read");
    }
    if (skipped_primitives_ > 0) {
      builder_.note("primitives of points or lines left out: " +
                    std::to_string(skipped_primitives_));
    }
  }

  [[nodiscard]] bool vertices_have_colours() const { return vertices_have_colours_; }

 private:
  /// Goes to every node that is shown.
  void walk() {
    budget_ = kMostInSmallFile + kMostPerByte * document_.total_bytes + document_.unpacked_bytes;
    visits_left_ = kMostVisitsInSmallFile + document_.total_bytes;
    const std::vector<int> roots = root_nodes();
    std::vector<Level> levels;
    levels.push_back({roots, Transform::Identity()});
    while (!levels.empty()) {
      Level& level = levels.back();
      if (level.next == level.nodes.size()) {
        levels.pop_back();
        continue;
      }
      const int node = level.nodes[level.next++];
      const Transform parent = level.parent;  // its place moves as levels are added
      read_node(node, parent, levels);
    }
  }

  /// Nodes side by side, and which of them is next. A stack of these is no deeper than the file has
  /// nodes, however often they name each other.
  struct Level {
    std::span<const int> nodes;
    Transform parent;
    std::size_t next = 0;
  };

  /// The default scene, else the first, else every node that is nobody's child.
  std::vector<int> root_nodes() {
    if (!gltf_.scenes.empty()) {
      const int scene = gltf_.defaultScene < 0 ? 0 : gltf_.defaultScene;
      if (static_cast<std::size_t>(scene) >= gltf_.scenes.size()) {
        builder_.fail("the default scene does not exist");
      }
      const std::vector<int>& nodes = gltf_.scenes[static_cast<std::size_t>(scene)].nodes;
      if (nodes.empty() && !is_counting_) {
        builder_.note("scene " + std::to_string(scene) + ", which is the one shown, has no nodes");
      }
      return nodes;
    }
    std::vector<bool> is_child(gltf_.nodes.size(), false);
    for (const tinygltf::Node& node : gltf_.nodes) {
      for (const int child : node.children) {
        if (child >= 0 && static_cast<std::size_t>(child) < is_child.size()) {
          is_child[static_cast<std::size_t>(child)] = true;
        }
      }
    }
    std::vector<int> roots;
    for (std::size_t n = 0; n < is_child.size(); ++n) {
      if (!is_child[n]) {
        roots.push_back(static_cast<int>(n));
      }
    }
    if (gltf_.nodes.empty() && !gltf_.meshes.empty()) {
      if (!is_counting_) {
        builder_.note("the file has no scene: each mesh is shown once, where it stands");
      }
      for (std::size_t m = 0; m < gltf_.meshes.size(); ++m) {
        show_mesh(m, gltf_.meshes[m].name, Transform::Identity());
      }
    }
    return roots;
  }

  void read_node(int index, const Transform& parent, std::vector<Level>& levels) {
    const auto n = static_cast<std::size_t>(index);
    if (index < 0 || n >= gltf_.nodes.size()) {
      builder_.fail("node " + std::to_string(index) + " does not exist");
    }
    if (levels.size() > gltf_.nodes.size()) {
      builder_.fail("node " + std::to_string(n) + " is its own ancestor");
    }
    if (visits_left_-- == 0) {
      builder_.fail(
          "its nodes share their children so often that the model is out of proportion "
          "to the file");
    }
    if (n < document_.hidden_nodes.size() && document_.hidden_nodes[n]) {
      hidden_nodes_ += is_counting_ ? 1 : 0;
      return;
    }
    const tinygltf::Node& node = gltf_.nodes[n];
    const Transform world = parent * gltf_local_transform(node, n, builder_);
    if (!world.allFinite()) {
      builder_.fail("the transform of node " + std::to_string(n) + " is not finite");
    }
    if (node.mesh >= 0) {
      if (static_cast<std::size_t>(node.mesh) >= gltf_.meshes.size()) {
        builder_.fail("node " + std::to_string(n) + " shows a mesh that does not exist");
      }
      const auto m = static_cast<std::size_t>(node.mesh);
      const std::string& name = node.name.empty() ? gltf_.meshes[m].name : node.name;
      spend(name.size());
      show_mesh(m, name, world, node.skin >= 0 ? &skin_at(node.skin) : nullptr);
    }
    levels.push_back({node.children, world});
  }

  /// The skin of that index, made when first asked for.
  const GltfSkin& skin_at(int index) {
    if (!nodes_) {
      nodes_.emplace(document_, builder_);
    }
    auto known = skins_.find(index);
    if (known == skins_.end()) {
      known = skins_.emplace(index, GltfSkin(document_, index, *nodes_, builder_)).first;
      spend(known->second.joints().size());
    }
    return known->second;
  }

  /// What a mesh adds each time that it is shown.
  struct Amount {
    std::size_t spent = 0;  // of the budget
    std::size_t faces = 0;
    std::size_t vertices = 0;  // of surfaces
  };

  /// \param skin that places the vertices instead of the node; null: none.
  void show_mesh(std::size_t m, const std::string& name, const Transform& world,
                 const GltfSkin* skin = nullptr) {
    if (!is_counting_) {
      builder_.begin_part(name);
      read_mesh(gltf_.meshes[m], world, skin);
      return;
    }
    if (!of_mesh_[m]) {
      of_mesh_[m] = amount_of(gltf_.meshes[m]);
    }
    spend(of_mesh_[m]->spent);
    faces_ += of_mesh_[m]->faces;
    vertices_ += of_mesh_[m]->vertices;
    builder_.check_counts(faces_, vertices_);
  }

  /// Elements of an accessor; of one that is not there none, which is complained of when it is read.
  [[nodiscard]] std::size_t elements(int accessor) {
    const auto a = static_cast<std::size_t>(accessor);
    if (accessor < 0 || a >= gltf_.accessors.size()) {
      return 0;
    }
    const auto [known, is_new] = elements_.try_emplace(accessor, 0);
    if (is_new) {  // a sparse one is read for it, and many primitives may share one
      builder_.run().check();
      known->second = GltfAccessor(document_, accessor, budget_, builder_).count();
    }
    return known->second;
  }

  [[nodiscard]] Amount amount_of(const tinygltf::Mesh& mesh) {
    Amount amount{.spent = mesh.primitives.size()};
    for (const tinygltf::Primitive& primitive : mesh.primitives) {
      const auto position = primitive.attributes.find("POSITION");
      const bool is_surface = primitive.mode >= TINYGLTF_MODE_TRIANGLES;
      if (position == primitive.attributes.end() ||
          (!is_surface && primitive.mode != TINYGLTF_MODE_POINTS)) {
        continue;
      }
      (is_surface ? surfaces_have_colours_ : points_have_colours_) |= has_colours(primitive);
      if (!is_surface) {
        continue;  // whether points are shown is not known yet
      }
      const std::size_t points = elements(position->second);
      const std::size_t corners = primitive.indices < 0 ? points : elements(primitive.indices);
      const bool is_list = primitive.mode == TINYGLTF_MODE_TRIANGLES;
      amount.spent += points + corners;
      amount.vertices += points;
      amount.faces += is_list ? corners / 3 : corners - std::min<std::size_t>(corners, 2);
    }
    return amount;
  }

  [[nodiscard]] bool has_colours(const tinygltf::Primitive& primitive) const {
    return primitive.attributes.count("COLOR_0") > 0 ||
           base_colour(primitive) != std::array{1.0, 1.0, 1.0};
  }

  /// Points count only without faces, once what is shown has been counted.
  [[nodiscard]] bool shows_points() const { return faces_ == 0; }

  void read_mesh(const tinygltf::Mesh& mesh, const Transform& world, const GltfSkin* skin) {
    spend(mesh.primitives.size());
    for (const tinygltf::Primitive& primitive : mesh.primitives) {
      const bool is_surface = primitive.mode >= TINYGLTF_MODE_TRIANGLES;
      const bool is_cloud = primitive.mode == TINYGLTF_MODE_POINTS && shows_points();
      if (primitive.mode < TINYGLTF_MODE_POINTS || primitive.mode > TINYGLTF_MODE_TRIANGLE_FAN) {
        builder_.fail("a primitive has the unknown mode " + std::to_string(primitive.mode));
      }
      if (is_surface || is_cloud) {
        read_primitive(primitive, world, skin);
      } else {
        ++skipped_primitives_;
      }
    }
  }

  /// Counts `amount` against what the whole file may show.
  void spend(std::size_t amount) {
    if (amount > budget_) {
      builder_.fail("shows its meshes so often that the model is out of proportion to the file");
    }
    budget_ -= amount;
  }

  void read_primitive(const tinygltf::Primitive& primitive, const Transform& world,
                      const GltfSkin* skin) {
    const auto position = primitive.attributes.find("POSITION");
    if (position == primitive.attributes.end()) {
      ++shapeless_primitives_;
      return;
    }
    const GltfAccessor points(document_, position->second, budget_, builder_);
    if (points.components() != 3) {
      builder_.fail("the positions of a primitive do not have 3 components");
    }
    if (!points.has_data()) {
      builder_.fail(std::string("the positions of a primitive have no data") +
                    (is_morphed_primitive(primitive) ? ": its shape is in morph targets, which are "
                                                       "not read; bake them, for example in Blender"
                                                     : ""));
    }
    spend(points.count());
    std::optional<GltfSkinnedVertices> skinned;
    if (skin != nullptr) {
      spend(points.count() * GltfSkinnedVertices::sets_of(primitive));
      skinned.emplace(document_, primitive, points.count(), *skin, builder_);
    }
    const bool is_held = skinned && skinned->are_held();
    const std::size_t first = builder_.point_count();
    for (std::size_t i = 0; i < points.count(); ++i) {
      const Eigen::Vector4d local(points.value(i, 0), points.value(i, 1), points.value(i, 2), 1.0);
      const Vec3 at = (is_held ? skinned->transform(i) * local : world * local).head<3>();
      if (!at.allFinite()) {
        builder_.fail("position " + std::to_string(i) + " of accessor " +
                      std::to_string(position->second) + " is not finite");
      }
      builder_.add_point(at, {"vertex", builder_.point_count()});
      builder_.advance(first + i, first + points.count());
    }
    read_colours(primitive, points.count());
    read_uvs(primitive, points.count());
    if (primitive.mode != TINYGLTF_MODE_POINTS) {
      const Eigen::Matrix4d placed =
          is_held && points.count() > 0 ? skinned->transform(0) : Eigen::Matrix4d(world);
      const bool is_mirrored = placed.topLeftCorner<3, 3>().determinant() < 0.0;
      add_gltf_triangles(corners_of(primitive, points.count()), primitive.mode, first, is_mirrored,
                         builder_);
    }
  }

  void read_colours(const tinygltf::Primitive& primitive, std::size_t count) {
    if (!surfaces_have_colours_ && !(shows_points() && points_have_colours_)) {
      return;
    }
    // What a vertex looks like is the product of both, in linear light; textures are the material's.
    const std::array<double, 3> base = base_colour(primitive);
    const auto colour = primitive.attributes.find("COLOR_0");
    if (colour == primitive.attributes.end()) {
      for (std::size_t i = 0; i < count; ++i) {
        builder_.add_colour(encoded_of_linear(base[0]), encoded_of_linear(base[1]),
                            encoded_of_linear(base[2]));
      }
      return;
    }
    std::vector<std::array<double, 3>> values(count, {1.0, 1.0, 1.0});
    const auto material = static_cast<std::size_t>(primitive.material);
    const bool counts_opacity = primitive.material >= 0 &&
                                material < document_.counts_opacity.size() &&
                                document_.counts_opacity[material];
    try {
      const GltfAccessor colours(document_, colour->second, count, builder_);
      if (colours.count() != count || colours.components() < 3) {
        builder_.fail("the colours of a primitive do not fit its positions");
      }
      for (std::size_t i = 0; i < count; ++i) {
        has_clear_ |= counts_opacity && colours.components() > 3 && colours.value(i, 3) < 1.0;
        values[i] = {colours.value(i, 0), colours.value(i, 1), colours.value(i, 2)};
      }
      vertices_have_colours_ = true;
    } catch (const FormatError&) {  // the shape is sound without them
      ++uncoloured_primitives_;
    }
    for (const auto& value : values) {
      builder_.add_colour(encoded_of_linear(base[0] * value[0]),
                          encoded_of_linear(base[1] * value[1]),
                          encoded_of_linear(base[2] * value[2]));
    }
  }

  /// Material and coordinates on its texture; one for each vertex, also where there are none.
  void read_uvs(const tinygltf::Primitive& primitive, std::size_t count) {
    if (!builder_.keeps_appearance()) {
      return;
    }
    const auto material = static_cast<std::size_t>(primitive.material);
    const bool known = primitive.material >= 0 && material < document_.texcoord_sets.size();
    builder_.begin_material(known ? static_cast<std::uint32_t>(material) : Appearance::kNone);
    const auto uv = primitive.attributes.find(
        "TEXCOORD_" + std::to_string(known ? document_.texcoord_sets[material] : 0));
    std::vector<std::array<double, 2>> values(count);
    if (known && uv != primitive.attributes.end()) {
      try {
        const GltfAccessor uvs(document_, uv->second, count, builder_);
        for (std::size_t i = 0; i < count && uvs.count() == count && uvs.components() > 1; ++i) {
          values[i] = {uvs.value(i, 0), uvs.value(i, 1)};
        }
      } catch (const FormatError&) {  // the shape is sound without them
        ++untextured_primitives_;
      }
    }
    for (const auto& [u, v] : values) {
      builder_.add_uv(u, v);
    }
  }

  /// Base colour factor of the primitive's material, linear, in [0, 1]; white without one.
  [[nodiscard]] std::array<double, 3> base_colour(const tinygltf::Primitive& primitive) const {
    const auto material = static_cast<std::size_t>(primitive.material);
    return primitive.material < 0 || material >= document_.base_colours.size()
               ? std::array{1.0, 1.0, 1.0}
               : document_.base_colours[material];
  }

  /// The corners of a primitive in drawing order, counted from 0 within the primitive.
  std::vector<std::uint64_t> corners_of(const tinygltf::Primitive& primitive,
                                        std::size_t vertices) {
    std::vector<std::uint64_t> corners;
    if (primitive.indices < 0) {
      spend(vertices);
      corners.resize(vertices);
      for (std::size_t i = 0; i < vertices; ++i) {
        corners[i] = i;
      }
      return corners;
    }
    const GltfAccessor indices(document_, primitive.indices, budget_, builder_);
    if (indices.components() != 1 || !indices.is_integer()) {
      builder_.fail("the indices of a primitive are not unsigned integers");
    }
    spend(indices.count());
    corners.reserve(indices.count());
    for (std::size_t i = 0; i < indices.count(); ++i) {
      corners.push_back(static_cast<std::uint64_t>(indices.value(i, 0)));
      if (corners.back() >= vertices) {
        builder_.fail("index " + std::to_string(i) + " of accessor " +
                      std::to_string(primitive.indices) + " names vertex " +
                      std::to_string(corners.back()) + ", but the primitive has only " +
                      std::to_string(vertices));
      }
    }
    return corners;
  }

  const GltfDocument& document_;
  std::optional<GltfNodes> nodes_{};
  std::map<int, GltfSkin> skins_{};
  const tinygltf::Model& gltf_;
  ModelBuilder& builder_;
  std::vector<std::optional<Amount>> of_mesh_;  // where it was asked for
  std::map<int, std::size_t> elements_{};       // of accessors that were asked for
  bool is_counting_ = false;
  std::size_t faces_ = 0;     // counted
  std::size_t vertices_ = 0;  // so too
  std::size_t budget_ = 0;
  std::size_t visits_left_ = 0;
  bool has_clear_ = false;              // a vertex is not opaque
  bool vertices_have_colours_ = false;  // of their own
  bool surfaces_have_colours_ = false;  // of what is shown
  bool points_have_colours_ = false;
  std::size_t hidden_nodes_ = 0;
  std::size_t skipped_primitives_ = 0;
  std::size_t shapeless_primitives_ = 0;
  std::size_t uncoloured_primitives_ = 0;
  std::size_t untextured_primitives_ = 0;
};

}  // namespace

Model parse_gltf(std::string_view bytes, std::string_view name, const RunContext& run,
                 const Surroundings& surroundings) {
  ModelBuilder builder(ModelFormat::Gltf, name, run, 0);
  if (surroundings.options.appearance) {
    builder.keep_appearance(/*of_vertices=*/true);
  }
  const GltfDocument document = read_gltf_document(bytes, surroundings, builder);
  builder.limit_faces(surroundings.options.max_faces);
  SceneReader reader(document, builder);
  reader.read();
  Model model = builder.finish();
  model.colours_are_materials = !model.vertex_colours.empty() && !reader.vertices_have_colours();
  return model;
}

}  // namespace vantage
