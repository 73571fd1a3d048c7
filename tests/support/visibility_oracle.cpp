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
  const long double across = (b - c).squaredNorm();
  const long double squared_doubt = kMargin * kMargin * a.squaredNorm() *
                                    std::max(b.squaredNorm(), across) *
                                    std::max(c.squaredNorm(), across);
  if (volume * volume <= squared_doubt) {
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
  const int first = side(to_eye, b, c);
  const int second = side(to_eye, c, a);
  if (first * second < 0) {
    return Seen::No;  // whatever the third says
  }
  const auto [low, high] = std::minmax({first, second, side(to_eye, a, b)});
  if (low < 0 && high > 0) {
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
      (low > 0 || high < 0) && std::abs(height) > doubt && std::abs(beyond) > slope_doubt;
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
  long double low = 0, high = 0;
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
  std::tie(face.low, face.high) = std::minmax({corner[0].y(), corner[1].y(), corner[2].y()});
  return face;
}

/// A shadow that another face casts on one: the points of the picture in all its halves.
using Shadow = std::vector<Half>;

/// How far the point lies inside the half; negative outside.
long double depth_in(const Half& half, long double x, long double y) {
  return half.x * x + half.y * y - half.offset;
}

/// Whether all corners lie on the outer side of one of the halves, so that nothing between them is in all.
bool lie_outside_one(const std::array<Wide, 3>& corners, const Shadow& shadow) {
  return std::any_of(shadow.begin(), shadow.end(), [&](const Half& half) {
    return std::all_of(corners.begin(), corners.end(),
                       [&](const Wide& c) { return depth_in(half, c.x(), c.y()) <= 0; });
  });
}

/// Whether all corners, and so all between them, lie in each of the halves.
bool lie_in_all(const std::array<Wide, 3>& corners, const Shadow& shadow) {
  return std::all_of(shadow.begin(), shadow.end(), [&](const Half& half) {
    return std::all_of(corners.begin(), corners.end(),
                       [&](const Wide& c) { return depth_in(half, c.x(), c.y()) >= 0; });
  });
}

/// Whether the point is in all halves, or so near that rounding may have put it outside: where two lines
/// meet that are almost parallel is not known well.
bool is_in_or_near(const Shadow& halves, long double x, long double y) {
  return std::all_of(halves.begin(), halves.end(), [&](const Half& half) {
    const long double size = std::abs(half.x * x) + std::abs(half.y * y) + std::abs(half.offset);
    return depth_in(half, x, y) >= -1e-9L * size;
  });
}

/// The part of the line at height y that lies in all of them; empty if the first is not below.
std::array<long double, 2> on_line(const Shadow& halves, long double y) {
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

/// Heights between which what is seen of the face's lines is linear: where two lines meet that bound
/// the face or shadows, if that is in the face and in what they bound. Others would change nothing.
std::vector<long double> heights_of_breaks(const Pictured& face,
                                           const std::vector<Shadow>& shadows) {
  std::vector<Shadow> bounded{Shadow(face.sides.begin(), face.sides.end())};
  bounded.insert(bounded.end(), shadows.begin(), shadows.end());
  std::vector<std::pair<Half, const Shadow*>> lines;
  for (const Shadow& one : bounded) {
    for (const Half& half : one) {
      lines.emplace_back(half, &one);
    }
  }
  std::vector<long double> heights{face.low, face.high};
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const auto& [a, of_a] = lines[i];
    for (std::size_t j = 0; j < i; ++j) {
      const auto& [b, of_b] = lines[j];
      const long double det = a.x * b.y - b.x * a.y;
      if (det == 0) {
        continue;
      }
      const long double y = (a.x * b.offset - b.x * a.offset) / det;
      const long double x = (a.offset * b.y - b.offset * a.y) / det;
      if (y > face.low && y < face.high && is_in_or_near(*of_a, x, y) &&
          is_in_or_near(*of_b, x, y) && is_in_or_near(bounded.front(), x, y)) {
        heights.push_back(y);
      }
    }
  }
  std::sort(heights.begin(), heights.end());
  return heights;
}

/// How much of the line at height y across the face none of the shadows hides.
long double length_left(const Pictured& face, const std::vector<Shadow>& shadows, long double y) {
  const auto [left, right] = on_line({face.sides.begin(), face.sides.end()}, y);
  std::vector<std::array<long double, 2>> hidden;
  for (const Shadow& shadow : shadows) {
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
  return seen + std::max(0.0L, right - from);
}

/// What none of the shadows hides of the face.
long double area_left(const Pictured& face, const std::vector<Shadow>& shadows) {
  const std::vector<long double> heights = heights_of_breaks(face, shadows);
  long double area = 0;
  for (std::size_t k = 1; k < heights.size(); ++k) {
    const long double step = heights[k] - heights[k - 1];
    if (step > 0) {
      area += step * length_left(face, shadows, (heights[k - 1] + heights[k]) / 2);
    }
  }
  return area;
}

/// Where the other face lies before the face: nowhere, an empty list, if no part of them does.
Shadow shadow_on(const Pictured& face, const Pictured& other) {
  const Shadow own(face.sides.begin(), face.sides.end());
  Shadow shadow(other.sides.begin(), other.sides.end());
  const Wide nearer = other.plane - face.plane;
  if (other.turned == 0 || nearer.norm() <= kMargin * (other.plane.norm() + face.plane.norm())) {
    return {};  // seen edge-on, or in one plane
  }
  shadow.push_back({nearer.x(), nearer.y(), -nearer.z()});
  const bool is_apart = lie_outside_one(other.corner, own) || lie_outside_one(face.corner, shadow);
  return is_apart ? Shadow{} : shadow;
}

/// What is seen of one of the faces in the picture.
long double area_seen(const std::vector<Pictured>& faces, std::size_t f) {
  const Pictured& face = faces[f];
  std::vector<Shadow> shadows;
  for (std::size_t g = 0; g < faces.size(); ++g) {
    Shadow shadow = g == f ? Shadow{} : shadow_on(face, faces[g]);
    if (shadow.empty()) {
      continue;
    }
    if (lie_in_all(face.corner, shadow)) {
      return 0;
    }
    shadows.push_back(std::move(shadow));
  }
  return area_left(face, shadows);
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
    areas[f] = static_cast<double>(distance * distance * area_seen(faces, f));
  }
  return areas;
}

}  // namespace vantage::test
