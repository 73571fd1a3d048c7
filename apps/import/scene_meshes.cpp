// SPDX-License-Identifier: MIT
#include "scene_meshes.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include <Eigen/Core>
#include <Eigen/LU>
#include <assimp/material.h>

namespace vantage::importing {
namespace {

/// In double: in Assimp's float a small shape far from the origin would collapse.
using Place = Eigen::Matrix4d;

Place place_of(const aiMatrix4x4& matrix) {
  Place place;
  for (unsigned row = 0; row < 4; ++row) {
    for (unsigned column = 0; column < 4; ++column) {
      place(row, column) = static_cast<double>(matrix[row][column]);
    }
  }
  return place;
}

Eigen::Vector3d placed(const Place& place, const aiVector3D& p) {
  return place.topLeftCorner<3, 3>() * Eigen::Vector3d(static_cast<double>(p.x),
                                                       static_cast<double>(p.y),
                                                       static_cast<double>(p.z)) +
         place.topRightCorner<3, 1>();
}

/// A node and where it is in the scene.
struct PlacedNode {
  const aiNode* node;
  Place place;
};

/// In the order of the file; a stack of our own, because files may nest them without end.
std::vector<PlacedNode> placed_nodes(const aiScene& scene) {
  std::vector<PlacedNode> nodes;
  std::vector<PlacedNode> open{{scene.mRootNode, Place::Identity()}};
  while (!open.empty()) {
    PlacedNode next = open.back();
    open.pop_back();
    next.place = next.place * place_of(next.node->mTransformation);
    for (unsigned c = next.node->mNumChildren; c > 0; --c) {
      open.push_back({next.node->mChildren[c - 1], next.place});
    }
    nodes.push_back(next);
  }
  return nodes;
}

/// Where a mesh's vertices are, and whether its faces are turned over by that.
struct PlacedMesh {
  std::vector<Eigen::Vector3d> positions{};
  bool is_mirrored = false;
};

bool mirrors(const Place& place) {
  return place.topLeftCorner<3, 3>().determinant() < 0.0;
}

/// Knows where the bones of meshes are.
class Bones {
 public:
  explicit Bones(const std::vector<PlacedNode>& nodes) {
    for (const PlacedNode& one : nodes) {
      place_of_name_.try_emplace(one.node->mName.C_Str(), one.place);
    }
  }

  /// Vertices where their bones hold them, by shares, or the node if none does. Bones turn a mesh over as one.
  [[nodiscard]] PlacedMesh placed_mesh(const aiMesh& mesh, const Place& node) const {
    PlacedMesh result{std::vector<Eigen::Vector3d>(mesh.mNumVertices, Eigen::Vector3d::Zero()),
                      mirrors(node)};
    std::vector<double> shares(mesh.mNumVertices, 0.0);
    for (unsigned b = 0; b < mesh.mNumBones; ++b) {
      const aiBone& bone = *mesh.mBones[b];
      const auto found = place_of_name_.find(bone.mName.C_Str());
      if (found == place_of_name_.end()) {
        continue;
      }
      const Place place = found->second * place_of(bone.mOffsetMatrix);
      result.is_mirrored = mirrors(place);
      for (unsigned w = 0; w < bone.mNumWeights; ++w) {
        const unsigned v = bone.mWeights[w].mVertexId;
        const auto share = static_cast<double>(bone.mWeights[w].mWeight);
        if (v < mesh.mNumVertices && share > 0.0) {
          result.positions[v] += share * placed(place, mesh.mVertices[v]);
          shares[v] += share;
        }
      }
    }
    for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
      result.positions[v] = shares[v] > 0.0 ? Eigen::Vector3d(result.positions[v] / shares[v])
                                            : placed(node, mesh.mVertices[v]);
    }
    return result;
  }

 private:
  std::unordered_map<std::string, Place> place_of_name_{};
};

/// Whether the file says that the node's own meshes are not to be seen, as FBX can.
bool is_hidden(const aiNode& node) {
  bool is_shown = true;
  return node.mNumMeshes > 0 && node.mMetaData != nullptr &&
         node.mMetaData->Get("Show", is_shown) && !is_shown;
}

/// Unless that leaves nothing.
void leave_out_hidden(std::vector<PlacedNode>& nodes, StreamWriter& out) {
  const auto hidden = [](const PlacedNode& at) { return is_hidden(*at.node); };
  const auto shown = [&](const PlacedNode& at) { return at.node->mNumMeshes > 0 && !hidden(at); };
  if (std::any_of(nodes.begin(), nodes.end(), shown)) {
    if (const std::size_t count = std::erase_if(nodes, hidden); count > 0) {
      out.note("nodes that the file hides left out: " + std::to_string(count));
    }
  }
}

/// Whether Assimp named a node for which the file has no name.
bool is_made_up(std::string_view name) {
  return name.starts_with('<') || name.starts_with("$ColladaAutoName$");
}

std::string part_name(const aiNode& node, const aiMesh& mesh) {
  const bool named = node.mName.length > 0 && !is_made_up(node.mName.C_Str()) &&
                     (node.mParent != nullptr || mesh.mName.length == 0);
  return named ? node.mName.C_Str() : mesh.mName.C_Str();
}

/// Some readers fill in black that cannot be seen where a file has no colours.
bool has_vertex_colours(const aiMesh& mesh) {
  return mesh.HasVertexColors(0) &&
         std::any_of(mesh.mColors[0], mesh.mColors[0] + mesh.mNumVertices,
                     [](const aiColor4D& c) { return c != aiColor4D(0.0F, 0.0F, 0.0F, 0.0F); });
}

void add_vertices(const aiMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
                  StreamMesh& result) {
  result.positions.reserve(std::size_t{3} * mesh.mNumVertices);
  const bool has_colours = has_vertex_colours(mesh);
  for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
    const Eigen::Vector3d& p = positions[v];
    result.positions.insert(result.positions.end(), {p.x(), p.y(), p.z()});
    if (has_colours) {
      const aiColor4D& c = mesh.mColors[0][v];
      result.colours.insert(result.colours.end(), {c.r, c.g, c.b});
    }
    if (mesh.HasTextureCoords(0)) {
      const aiVector3D& t = mesh.mTextureCoords[0][v];
      result.places.insert(result.places.end(), {t.x, t.y});
    }
  }
}

/// A transform that mirrors turns faces over, which is taken back.
void add_faces(const aiMesh& mesh, bool mirrored, StreamMesh& result) {
  for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
    const aiFace& face = mesh.mFaces[f];
    result.faces.push_back(face.mNumIndices);
    for (unsigned c = 0; c < face.mNumIndices; ++c) {
      result.faces.push_back(face.mIndices[mirrored ? face.mNumIndices - 1 - c : c]);
    }
  }
  result.face_count = mesh.mNumFaces;
}

StreamMesh stream_mesh(const aiMesh& mesh, const PlacedNode& at, const Bones& bones) {
  StreamMesh result;
  result.name = part_name(*at.node, mesh);
  result.material = mesh.mMaterialIndex;
  const PlacedMesh placed = bones.placed_mesh(mesh, at.place);
  add_vertices(mesh, placed.positions, result);
  add_faces(mesh, placed.is_mirrored, result);
  return result;
}

}  // namespace

void send_meshes(const aiScene& scene, StreamWriter& out) {
  std::vector<PlacedNode> nodes = placed_nodes(scene);
  const Bones bones(nodes);
  leave_out_hidden(nodes, out);
  bool any_bones = false;
  for (const PlacedNode& at : nodes) {
    std::string last;
    for (unsigned m = 0; m < at.node->mNumMeshes; ++m) {
      const aiMesh& mesh = *scene.mMeshes[at.node->mMeshes[m]];
      const std::string name = part_name(*at.node, mesh);
      if (mesh.mVertices != nullptr) {
        StreamMesh sent = stream_mesh(mesh, at, bones);
        sent.same_part = m > 0 && name == last;
        out.mesh(sent);
        any_bones |= mesh.mNumBones > 0;
      }
      last = name;
    }
  }
  if (any_bones) {
    out.note("skinned meshes are shown as their joints stand in the file, without animation");
  }
}

}  // namespace vantage::importing
