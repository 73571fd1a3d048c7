// SPDX-License-Identifier: MIT
#include "support/visibility_oracle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

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

namespace {

/// The points of the picture with x · normal ≥ offset.
struct Half {
  long double x = 0, y = 0, offset = 0;
};

/// A face in a picture that is orthographic: (x, y) and how near each corner is. In perspective
/// 1 / depth is linear over a plane's picture, as depth is else.
struct Pictured {
  std::array<Wide, 3> corner{};
  std::array<Half, 3> sides{};
  Wide plane = Wide::Zero();  // nearness = plane · (x, y, 1)
  long double low = 0, high = 0, left = 0, right = 0;
  int turned = 0;
};

Pictured pictured(const std::array<Wide, 3>& corner) {
  Pictured face;
  face.corner = corner;
  const Wide ab = corner[1] - corner[0];
  const Wide ac = corner[2] - corner[0];
  const long double twice = ab.x() * ac.y() - ab.y() * ac.x();
  face.turned = twice > 0 ? 1 : twice < 0 ? 2 : 0;
  if (face.turned == 0) {
    return face;
  }
  const long double sign = twice > 0 ? 1 : -1;
  for (std::size_t k = 0; k < 3; ++k) {
    const Wide& a = corner[k];
    const Wide way = sign * (corner[(k + 1) % 3] - a);
    face.sides[k] = {-way.y(), way.x(), -way.y() * a.x() + way.x() * a.y()};
  }
  const Wide normal = ab.cross(ac);
  face.plane = Wide(-normal.x(), -normal.y(), normal.dot(corner[0])) / normal.z();
  std::tie(face.left, face.right) = std::minmax({corner[0].x(), corner[1].x(), corner[2].x()});
  std::tie(face.low, face.high) = std::minmax({corner[0].y(), corner[1].y(), corner[2].y()});
  return face;
}

/// The part of the line at height y that lies in all of them; empty if the first is not below.
std::array<long double, 2> on_line(const std::vector<Half>& halves, long double y) {
  std::array<long double, 2> part{-1e30L, 1e30L};
  for (const Half& half : halves) {
    const long double rest = half.offset - half.y * y;
    if (half.x > 0) {
      part[0] = std::max(part[0], rest / half.x);
    } else if (half.x < 0) {
      part[1] = std::min(part[1], rest / half.x);
    } else if (rest > 0) {
      part[1] = part[0];
    }
  }
  return part;
}

/// What none of the shadows hides of the face, all of them given by their halves.
long double area_left(const Pictured& face, const std::vector<std::vector<Half>>& shadows) {
  const std::vector<Half> own(face.sides.begin(), face.sides.end());
  std::vector<Half> all = own;
  for (const auto& shadow : shadows) {
    all.insert(all.end(), shadow.begin(), shadow.end());
  }
  // Between heights where two lines meet, what is seen of a line is linear in its height.
  std::vector<long double> heights{face.low, face.high};
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const long double det = all[i].x * all[j].y - all[j].x * all[i].y;
      if (det != 0) {
        const long double y = (all[i].x * all[j].offset - all[j].x * all[i].offset) / det;
        if (y > face.low && y < face.high) {
          heights.push_back(y);
        }
      }
    }
  }
  std::sort(heights.begin(), heights.end());
  long double area = 0;
  std::vector<std::array<long double, 2>> hidden;
  for (std::size_t k = 1; k < heights.size(); ++k) {
    const long double y = (heights[k - 1] + heights[k]) / 2;
    const auto [left, right] = on_line(own, y);
    hidden.clear();
    for (const auto& shadow : shadows) {
      const auto part = on_line(shadow, y);
      if (part[1] > part[0]) {
        hidden.push_back(part);
      }
    }
    std::sort(hidden.begin(), hidden.end());
    long double from = left;
    long double seen = 0;
    for (const auto& part : hidden) {
      seen += std::max(0.0L, std::min(part[0], right) - from);
      from = std::max(from, part[1]);
    }
    seen += std::max(0.0L, right - from);
    area += seen * (heights[k] - heights[k - 1]);
  }
  return area;
}

}  // namespace

std::vector<double> brute_force_areas(const TriMesh& mesh, FaceSides sides, const Viewpoint& eye,
                                      const Vec3& centre) {
  const bool is_perspective = eye.projection == Projection::Perspective;
  const Wide at = eye.position.cast<long double>();
  const Wide middle = centre.cast<long double>();
  const Wide towards = is_perspective ? Wide((at - middle).normalized()) : Wide(at.normalized());
  const Wide right = towards.unitOrthogonal();
  const Wide up = towards.cross(right);
  const long double distance = is_perspective ? (at - middle).norm() : 1;
  std::vector<Pictured> faces;
  for (const Triangle& t : mesh.triangles) {
    std::array<Wide, 3> corner;
    for (std::size_t k = 0; k < 3; ++k) {
      const Wide place = mesh.positions[t[k]].cast<long double>() - middle;
      const long double depth = is_perspective ? distance - place.dot(towards) : 1;
      corner[k] = {place.dot(right) / depth, place.dot(up) / depth,
                   is_perspective ? 1 / depth : place.dot(towards)};
    }
    faces.push_back(pictured(corner));
  }
  std::vector<double> areas(faces.size(), 0.0);
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const Pictured& face = faces[f];
    if (face.turned == 0 || (face.turned == 2 && sides == FaceSides::Front)) {
      continue;
    }
    std::vector<std::vector<Half>> shadows;
    for (std::size_t g = 0; g < faces.size(); ++g) {
      const Pictured& other = faces[g];
      if (g == f || other.turned == 0 || !(other.low < face.high) || !(face.low < other.high) ||
          !(other.left < face.right) || !(face.left < other.right)) {
        continue;
      }
      const Wide nearer = other.plane - face.plane;
      if (nearer.norm() <= kMargin * (other.plane.norm() + face.plane.norm())) {
        continue;  // in one plane
      }
      std::vector<Half> shadow(other.sides.begin(), other.sides.end());
      shadow.push_back({nearer.x(), nearer.y(), -nearer.z()});
      shadows.push_back(std::move(shadow));
    }
    areas[f] = static_cast<double>(distance * distance * area_left(face, shadows));
  }
  return areas;
}

}  // namespace vantage::test
