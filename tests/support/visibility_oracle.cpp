// SPDX-License-Identifier: MIT
#include "support/visibility_oracle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <Eigen/Geometry>

namespace vantage::test {
namespace {

using Wide = Eigen::Matrix<long double, 3, 1>;

// Signed volumes below this share of the product of the lengths they come from are not trusted.
constexpr long double kMargin = 1e-13L;

/// −1, 0 (not sure) or 1: the sign of a · (b × c).
int side(const Wide& a, const Wide& b, const Wide& c) {
  const long double volume = a.dot(b.cross(c));
  const long double doubt =
      kMargin * a.norm() * std::max(b.norm(), (b - c).norm()) * std::max(c.norm(), (b - c).norm());
  if (std::abs(volume) <= doubt) {
    return 0;
  }
  return volume > 0 ? 1 : -1;
}

struct Face {
  std::array<std::uint32_t, 3> place{};  // position ids of the corners
  std::array<Wide, 3> corner{};
  Wide normal = Wide::Zero();
};

/// Whether the open segment from `start` towards the eye passes through the face.
Seen blocks(const Face& face, const Wide& start, const Wide& to_eye, bool bounded) {
  const Wide a = face.corner[0] - start;
  const Wide b = face.corner[1] - start;
  const Wide c = face.corner[2] - start;
  const std::array<int, 3> turn{side(to_eye, b, c), side(to_eye, c, a), side(to_eye, a, b)};
  const auto [low, high] = std::minmax_element(turn.begin(), turn.end());
  if (*low < 0 && *high > 0) {
    return Seen::No;
  }
  // The face's plane must have the start on one side and the eye on the other.
  const long double size = std::max({a.norm(), b.norm(), c.norm()});
  const long double height = face.normal.dot(a);
  const long double doubt = kMargin * size;
  const long double slope = face.normal.dot(to_eye);
  const long double beyond = bounded ? slope - height : slope;
  const long double slope_doubt = kMargin * to_eye.norm();
  const bool same_side =
      (height > doubt && beyond < -slope_doubt) || (height < -doubt && beyond > slope_doubt);
  if (same_side) {
    return Seen::No;
  }
  const bool sure =
      (*low > 0 || *high < 0) && std::abs(height) > doubt && std::abs(beyond) > slope_doubt;
  return sure ? Seen::Yes : Seen::Exactly;
}

/// Whether one of the vertex's faces is turned to the eye.
Seen turned(const std::vector<const Face*>& faces, const Wide& to_eye, FaceSides sides) {
  Seen best = Seen::No;
  for (const Face* face : faces) {
    const long double height = face->normal.dot(to_eye);
    const long double lift = sides == FaceSides::Both ? std::abs(height) : height;
    if (lift > kMargin * to_eye.norm()) {
      return Seen::Yes;
    }
    if (std::abs(height) <= kMargin * to_eye.norm()) {
      best = Seen::Exactly;
    }
  }
  return best;
}

/// For each vertex the lowest vertex of equal position.
std::vector<std::uint32_t> places(const TriMesh& mesh) {
  std::map<std::array<double, 3>, std::uint32_t> place_of_position;
  std::vector<std::uint32_t> place(mesh.positions.size());
  for (std::size_t v = 0; v < place.size(); ++v) {
    const Vec3 p = mesh.positions[v] + Vec3::Zero();  // −0 becomes 0
    place[v] = place_of_position.try_emplace({p.x(), p.y(), p.z()}, static_cast<std::uint32_t>(v))
                   .first->second;
  }
  return place;
}

std::vector<Face> faces_with_area(const TriMesh& mesh, const std::vector<std::uint32_t>& place) {
  std::vector<Face> faces;
  for (const auto& t : mesh.triangles) {
    Face face;
    for (std::size_t i = 0; i < 3; ++i) {
      face.place[i] = place[t[i]];
      face.corner[i] = mesh.positions[t[i]].cast<long double>();
    }
    face.normal = (face.corner[1] - face.corner[0]).cross(face.corner[2] - face.corner[0]);
    if (face.normal.norm() > 0) {
      face.normal.normalize();
      faces.push_back(face);
    }
  }
  return faces;
}

/// What all faces that do not hold the place together do to a segment.
Seen reaches(const std::vector<Face>& faces, std::uint32_t place, const Wide& start,
             const Wide& to_eye, bool bounded) {
  Seen result = Seen::Yes;
  for (const Face& face : faces) {
    if (std::find(face.place.begin(), face.place.end(), place) != face.place.end()) {
      continue;
    }
    const Seen blocked = blocks(face, start, to_eye, bounded);
    if (blocked == Seen::Yes) {
      return Seen::No;
    }
    result = blocked == Seen::Exactly ? Seen::Exactly : result;
  }
  return result;
}

}  // namespace

std::vector<Seen> brute_force_visibility(const TriMesh& mesh, FaceSides sides, const Viewpoint& eye,
                                         std::size_t step) {
  const std::vector<std::uint32_t> place = places(mesh);
  const std::vector<Face> faces = faces_with_area(mesh, place);
  std::vector<std::vector<const Face*>> faces_at(mesh.positions.size());
  for (const Face& face : faces) {
    for (const std::uint32_t p : face.place) {
      faces_at[p].push_back(&face);
    }
  }
  std::vector<bool> named(mesh.positions.size(), false);
  for (const auto& t : mesh.triangles) {
    named[t[0]] = named[t[1]] = named[t[2]] = true;
  }

  const bool bounded = eye.projection == Projection::Perspective;
  std::vector<Seen> result(mesh.positions.size(), step == 1 ? Seen::No : Seen::Exactly);
  for (std::size_t v = 0; v < result.size(); v += step) {
    result[v] = Seen::No;
    const Wide start = mesh.positions[v].cast<long double>();
    const Wide to_eye = bounded ? Wide(eye.position.cast<long double>() - start)
                                : Wide(eye.position.cast<long double>());
    const Seen facing = named[v] ? turned(faces_at[place[v]], to_eye, sides) : Seen::No;
    if (facing == Seen::No) {
      continue;
    }
    const Seen open = reaches(faces, place[v], start, to_eye, bounded);
    result[v] = open == Seen::Yes ? facing : open;
  }
  return result;
}

}  // namespace vantage::test
