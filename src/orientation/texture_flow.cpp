// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "vantage/orientation/orientation.h"

namespace vantage {
namespace {

/// One face with a picture on it.
struct PicturedFace {
  Vec3 normal;          ///< Unit, as the face is wound.
  Vec3 up;              ///< Unit, the way the picture's top lies.
  Vec3 right;           ///< Unit, the way its right side lies.
  double area = 0.0;    ///< Of the face.
  double texels = 0.0;  ///< Area in the picture.
};

using Corners = std::array<Vec3, 3>;
using Places = std::array<std::array<double, 2>, 3>;

/// \return false for a face without area, here or in the picture.
bool lay(const Corners& at, const Places& uv, PicturedFace& face) {
  const Vec3 one = at[1] - at[0];
  const Vec3 two = at[2] - at[0];
  const Vec3 twice = one.cross(two);
  const double u1 = uv[1][0] - uv[0][0];
  const double v1 = uv[1][1] - uv[0][1];
  const double u2 = uv[2][0] - uv[0][0];
  const double v2 = uv[2][1] - uv[0][1];
  const double turn = u1 * v2 - u2 * v1;
  const double length = twice.norm();
  if (!(length > 0.0) || !(std::abs(turn) > 0.0)) {
    return false;
  }
  const double sign = turn > 0.0 ? 1.0 : -1.0;
  const Vec3 up = sign * (u1 * two - u2 * one);
  const Vec3 right = sign * (v2 * one - v1 * two);
  if (!(up.norm() > 0.0) || !(right.norm() > 0.0)) {
    return false;
  }
  face = {twice / length, up.normalized(), right.normalized(), 0.5 * length, 0.5 * std::abs(turn)};
  return true;
}

double fourth(double cosine) {
  const double square = cosine > 0.0 ? cosine * cosine : 0.0;
  return square * square;
}

}  // namespace

TextureFlow texture_flow(const TriMesh& mesh, const Appearance& appearance) {
  TextureFlow flow;
  if (appearance.uv_of_triangle.size() != mesh.triangles.size()) {
    return flow;
  }
  double area = 0.0;
  double texels = 0.0;
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    Corners at;
    Places uv{};
    bool has_places = true;
    for (std::size_t c = 0; c < 3; ++c) {
      at[c] = mesh.positions[mesh.triangles[f][c]];
      const std::uint32_t place = appearance.uv_of_triangle[f][c];
      has_places = has_places && place < appearance.uvs.size();
      if (has_places) {
        uv[c] = {static_cast<double>(appearance.uvs[place][0]),
                 static_cast<double>(appearance.uvs[place][1])};
      }
    }
    area += 0.5 * (at[1] - at[0]).cross(at[2] - at[0]).norm();
    PicturedFace face;
    if (!has_places || !lay(at, uv, face)) {
      continue;
    }
    flow.share += face.area;
    texels += face.texels;
    for (std::size_t s = 0; s < 6; ++s) {
      TextureFlow::Side& side = flow.side[s];
      const auto k = static_cast<Eigen::Index>(s / 2);
      const double sign = s % 2 == 0 ? 1.0 : -1.0;
      const double faces = fourth(sign * face.normal[k]);
      side.area += face.area * faces;
      side.texels += face.texels * faces;
      side.up += face.area * faces * face.up;
      side.right += face.area * faces * face.right;
    }
    for (Eigen::Index k = 0; k < 3; ++k) {
      flow.up_along[k] += face.area * std::abs(face.up[k]);
      flow.right_along[k] += face.area * std::abs(face.right[k]);
    }
    flow.up += face.area * face.up;
    flow.right += face.area * face.right;
  }
  if (!(area > 0.0)) {
    return {};
  }
  flow.scale(1.0 / area, texels > 0.0 ? 1.0 / texels : 0.0);
  return flow;
}

void TextureFlow::scale(double by, double texels_by) {
  share *= by;
  for (Vec3* vector : {&up, &right, &up_along, &right_along}) {
    *vector *= by;
  }
  for (Side& one : side) {
    one.area *= by;
    one.texels *= texels_by;
    one.up *= by;
    one.right *= by;
  }
}

}  // namespace vantage
