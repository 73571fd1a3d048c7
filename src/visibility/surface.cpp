// SPDX-License-Identifier: MIT
#include "visibility/surface.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <Eigen/Geometry>

#include "vantage/core/error.h"
#include "vantage/mesh/measures.h"
#include "vantage/mesh/mesh_check.h"
#include "vantage/mesh/topology.h"

#include "core/parallel.h"
#include "core/unit_direction.h"

namespace vantage {
namespace {

// A face whose height over its longest side is below this has no area: in a UnitFrame, where
// coordinates carry rounding errors of 2^-53, its normal would be noise.
constexpr double kFlatHeight = 0x1p-48;

// Bits per axis of a Morton code.
constexpr int kMortonBits = 20;

/// Moves the low 21 bits of `value` apart so that two zero bits follow each.
std::uint64_t spread(std::uint64_t value) {
  value &= 0x1fffff;
  value = (value | value << 32U) & 0x1f00000000ffffU;
  value = (value | value << 16U) & 0x1f0000ff0000ffU;
  value = (value | value << 8U) & 0x100f00f00f00f00fU;
  value = (value | value << 4U) & 0x10c30c30c30c30c3U;
  return (value | value << 2U) & 0x1249249249249249U;
}

bool has_area(const Vec3& a, const Vec3& b, const Vec3& c, double twice_area) {
  const double longest =
      std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
  return twice_area * twice_area > kFlatHeight * kFlatHeight * longest && longest > 0.0;
}

/// A face in the making, with corners numbered as in the welded mesh.
struct LooseFace {
  Triangle corners{};
  Vec3 area_vector = Vec3::Zero();
  FaceSides sides = FaceSides::Both;
  std::uint32_t of_mesh = 0;
};

std::vector<LooseFace> faces_with_area(const TriMesh& mesh, const WeldedMesh& welded,
                                       const std::vector<Vec3>& positions,
                                       std::span<const FaceSides> sides) {
  const bool is_one = sides.size() == 1;
  const Components components = is_one ? Components{} : connected_components(mesh);
  if (!is_one && sides.size() != components.count) {
    throw InvalidInput("visibility needs the sides of each of the " +
                       std::to_string(components.count) + " components, got " +
                       std::to_string(sides.size()));
  }
  std::vector<LooseFace> faces;
  faces.reserve(mesh.triangles.size());
  for (std::uint32_t f = 0; f < mesh.triangles.size(); ++f) {
    const Triangle& t = mesh.triangles[f];
    LooseFace face;
    face.of_mesh = f;
    for (std::size_t corner = 0; corner < 3; ++corner) {
      face.corners[corner] = welded.welded_of_vertex[t[corner]];
    }
    const Vec3& a = positions[face.corners[0]];
    const Vec3& b = positions[face.corners[1]];
    const Vec3& c = positions[face.corners[2]];
    face.area_vector = (b - a).cross(c - a);
    face.sides = is_one ? sides[0] : sides[components.of_vertex[t[0]]];
    if (has_area(a, b, c, face.area_vector.norm())) {
      faces.push_back(face);
    }
  }
  return faces;
}

/// Corners in an order that faces of the same place share: of faces that are seen from their fronts
/// alone only those that also run the same way.
Triangle place_of(const LooseFace& face) {
  Triangle corners = face.corners;
  if (face.sides == FaceSides::Both) {
    std::sort(corners.begin(), corners.end());
  } else {
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
  }
  return corners;
}

/// For each face 1 if an earlier one stands in its place: it neither shows nor hides anything more, and
/// each would be held against all of them.
std::vector<std::uint8_t> find_repeated(const std::vector<LooseFace>& faces) {
  std::vector<std::pair<Triangle, std::uint32_t>> places;
  places.reserve(faces.size());
  for (std::uint32_t f = 0; f < faces.size(); ++f) {
    places.emplace_back(place_of(faces[f]), f);
  }
  std::sort(places.begin(), places.end());
  std::vector<std::uint8_t> is_repeated(faces.size(), 0);
  for (std::size_t i = 1; i < places.size(); ++i) {
    is_repeated[places[i].second] = places[i].first == places[i - 1].first ? 1 : 0;
  }
  return is_repeated;
}

std::vector<LooseFace> without_repeated(const std::vector<LooseFace>& faces) {
  const std::vector<std::uint8_t> is_repeated = find_repeated(faces);
  std::vector<LooseFace> first;
  first.reserve(faces.size());
  for (std::size_t f = 0; f < faces.size(); ++f) {
    if (is_repeated[f] == 0) {
      first.push_back(faces[f]);
    }
  }
  return first;
}

/// Numbers the welded vertices that faces use along a Morton curve.
std::vector<std::uint32_t> number_samples(const std::vector<Vec3>& positions,
                                          const std::vector<LooseFace>& faces, Surface& surface) {
  std::vector<std::uint32_t> sample_of_welded(positions.size(), Surface::kNoSample);
  std::vector<std::uint32_t> used;
  for (const LooseFace& face : faces) {
    for (const std::uint32_t v : face.corners) {
      if (std::exchange(sample_of_welded[v], 0) == Surface::kNoSample) {
        used.push_back(v);
      }
    }
  }
  std::vector<Vec3> points;
  points.reserve(used.size());
  for (const std::uint32_t v : used) {
    points.push_back(positions[v]);
  }
  for (const std::uint32_t i : morton_order(points)) {
    sample_of_welded[used[i]] = static_cast<std::uint32_t>(surface.samples.size());
    surface.samples.push_back(points[i]);
  }
  return sample_of_welded;
}

/// \param samples where they are rounded.
FacePlanes planes_of(const Surface& surface, const std::vector<Vec3>& samples) {
  FacePlanes planes;
  for (std::size_t f = 0; f < surface.faces.size(); ++f) {
    const Vec3 normal = surface.area_vectors[f] / surface.twice_areas[f];
    planes.x.push_back(static_cast<float>(normal.x()));
    planes.y.push_back(static_cast<float>(normal.y()));
    planes.z.push_back(static_cast<float>(normal.z()));
    planes.offset.push_back(static_cast<float>(normal.dot(samples[surface.faces[f][0]])));
  }
  return planes;
}

// A face whose normal is this close to a right angle with the line of sight is seen edge on: the
// rounding of positions in a UnitFrame and of the dot product, in radians.
constexpr double kEdgeOn = 0x1p-46;
// Blocks per chunk: some tenths of a millisecond.
constexpr std::size_t kBlockGrain = 128;

/// Which side of the face is turned to the eye, in double: 1 front, 2 back, 0 edge on.
std::uint8_t exact_side(const Surface& surface, std::size_t f, const Viewpoint& eye) {
  const Vec3 sight = eye.projection == Projection::Perspective
                         ? Vec3(eye.position - surface.samples[surface.faces[f][0]])
                         : eye.position;
  const double height = surface.area_vectors[f].dot(sight);
  if (!(std::abs(height) > kEdgeOn * surface.twice_areas[f] * sight.norm())) {
    return 0;
  }
  return height > 0.0 ? 1 : 2;
}

/// Which side all of a block's faces turn to the eye; 0 if that is not clear.
void find_turned_blocks(const FaceBlocks& blocks, const Viewpoint& eye, float error_bound,
                        std::vector<std::uint8_t>& turned) {
  const Eigen::Vector3f at = eye.position.cast<float>();
  const bool perspective = eye.projection == Projection::Perspective;
  turned.assign(blocks.balls.radius.size(), 0);
  // Squares of far eyes overflow; each face is looked at then.
  constexpr float kFarthest = 1e6F;
  if (blocks.cosine.empty() || !(at.norm() < kFarthest)) {
    return;
  }
  for (std::size_t i = 0; i < turned.size(); ++i) {
    const Eigen::Vector3f centre(blocks.balls.centres.x[i], blocks.balls.centres.y[i],
                                 blocks.balls.centres.z[i]);
    const Eigen::Vector3f axis(blocks.axes.x[i], blocks.axes.y[i], blocks.axes.z[i]);
    const Eigen::Vector3f sight = perspective ? Eigen::Vector3f(at - centre) : at;
    // How high the eye is over the planes of normals within the cone, through points in the ball.
    const float along = axis.dot(sight);
    const float aside = std::sqrt(std::max(0.0F, sight.squaredNorm() - along * along));
    const float cosine = blocks.cosine[i];
    const float sine = std::sqrt(std::max(0.0F, 1.0F - cosine * cosine));
    // Far more than rounding, that of a narrow cone's cosine above all.
    const float bound = 0x1p10F * error_bound + (perspective ? blocks.balls.radius[i] : 0.0F);
    const float least = along * cosine - aside * sine;
    const float most = along * cosine + aside * sine;
    const bool is_cone = cosine > 0.0F;
    turned[i] = is_cone && least > bound ? 1 : is_cone && most < -bound ? 2 : 0;
  }
}

/// Adds the cones around the normals of each block.
void add_cones(const Surface& surface, FaceBlocks& blocks) {
  const auto normal = [&](std::size_t f) -> Vec3 {
    return surface.area_vectors[f] / surface.twice_areas[f];
  };
  const std::size_t count = surface.faces.size();
  for (std::size_t begin = 0; begin < count; begin += FaceBlocks::kFaces) {
    const std::size_t end = std::min(count, begin + FaceBlocks::kFaces);
    Vec3 sum = Vec3::Zero();
    for (std::size_t f = begin; f < end; ++f) {
      sum += normal(f);
    }
    const double length = sum.norm();
    const Vec3 axis = length > 0.0 ? Vec3(sum / length) : Vec3(Vec3::UnitZ());
    double least = 1.0;
    for (std::size_t f = begin; f < end; ++f) {
      least = std::min(least, normal(f).dot(axis));
    }
    blocks.axes.x.push_back(static_cast<float>(axis.x()));
    blocks.axes.y.push_back(static_cast<float>(axis.y()));
    blocks.axes.z.push_back(static_cast<float>(axis.z()));
    blocks.cosine.push_back(static_cast<float>(std::max(0.0, least)));
  }
}

/// \param samples where they are rounded.
FaceBlocks blocks_of(const Surface& surface, const std::vector<Vec3>& samples) {
  FaceBlocks blocks;
  const std::size_t count = surface.faces.size();
  for (std::size_t begin = 0; begin < count; begin += FaceBlocks::kFaces) {
    std::vector<Vec3> corners;
    for (std::size_t f = begin; f < std::min(count, begin + FaceBlocks::kFaces); ++f) {
      for (const std::uint32_t sample : surface.faces[f]) {
        corners.push_back(samples[sample]);
      }
    }
    const Box box = bounding_box(corners);
    const Vec3 centre = 0.5 * (box.low + box.high);
    double squared = 0.0;
    for (const Vec3& p : corners) {
      squared = std::max(squared, (p - centre).squaredNorm());
    }
    // More than the centre and the radius lose to float.
    constexpr double kRounding = 0x1p-22;
    blocks.balls.centres.x.push_back(static_cast<float>(centre.x()));
    blocks.balls.centres.y.push_back(static_cast<float>(centre.y()));
    blocks.balls.centres.z.push_back(static_cast<float>(centre.z()));
    blocks.balls.radius.push_back(
        static_cast<float>(std::sqrt(squared) * (1.0 + kRounding) + kRounding));
  }
  return blocks;
}

/// Rounds its samples and faces.
void add_rounded(Surface& surface) {
  const std::vector<Vec3> samples = surface.rounding.to_frame(surface.samples);
  surface.rounded = rounded_points(samples);
  surface.planes = planes_of(surface, samples);
  surface.blocks = blocks_of(surface, samples);
  add_cones(surface, surface.blocks);
}

}  // namespace

FloatPoints rounded_points(std::span<const Vec3> points) {
  FloatPoints rounded;
  for (const Vec3& p : points) {
    rounded.x.push_back(static_cast<float>(p.x()));
    rounded.y.push_back(static_cast<float>(p.y()));
    rounded.z.push_back(static_cast<float>(p.z()));
  }
  return rounded;
}

std::vector<std::uint8_t> vertices_of_samples(const Surface& surface,
                                              std::span<const std::uint8_t> of_sample) {
  std::vector<std::uint8_t> of_vertex(surface.sample_of_vertex.size(), 0);
  for (std::size_t v = 0; v < of_vertex.size(); ++v) {
    const std::uint32_t sample = surface.sample_of_vertex[v];
    of_vertex[v] = sample == Surface::kNoSample ? std::uint8_t{0} : of_sample[sample];
  }
  return of_vertex;
}

Viewpoint eye_in_frame(const Viewpoint& eye, const UnitFrame& frame) {
  if (!eye.position.allFinite()) {
    throw InvalidInput("the eye of a visibility query must be finite");
  }
  if (eye.projection == Projection::Perspective) {
    return {eye.projection, frame.to_frame(eye.position)};
  }
  return {eye.projection, unit_direction(eye.position).normalized()};
}

std::vector<std::uint32_t> morton_order(std::span<const Vec3> points) {
  const Box box = bounding_box(points);
  const double side = box.longest_side();
  const double cells = side > 0.0 ? static_cast<double>((1 << kMortonBits) - 1) / side : 0.0;
  std::vector<std::pair<std::uint64_t, std::uint32_t>> keyed;
  keyed.reserve(points.size());
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const Vec3 cell = (points[i] - box.low) * cells;
    keyed.emplace_back(spread(static_cast<std::uint64_t>(cell.x())) |
                           spread(static_cast<std::uint64_t>(cell.y())) << 1U |
                           spread(static_cast<std::uint64_t>(cell.z())) << 2U,
                       i);
  }
  std::sort(keyed.begin(), keyed.end());
  std::vector<std::uint32_t> order;
  order.reserve(points.size());
  for (const auto& [key, i] : keyed) {
    order.push_back(i);
  }
  return order;
}

std::vector<std::uint32_t> repeated_faces(const TriMesh& mesh, std::span<const FaceSides> sides) {
  const WeldedMesh welded = weld(mesh);
  const UnitFrame frame = unit_frame(referenced_points(mesh));
  const std::vector<LooseFace> faces =
      faces_with_area(mesh, welded, frame.to_frame(welded.mesh.positions), sides);
  const std::vector<std::uint8_t> is_repeated = find_repeated(faces);
  std::vector<std::uint32_t> repeated;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    if (is_repeated[f] != 0) {
      repeated.push_back(faces[f].of_mesh);
    }
  }
  return repeated;
}

Surface visibility_surface(const TriMesh& mesh, std::span<const FaceSides> sides) {
  const WeldedMesh welded = weld(mesh);
  Surface surface;
  surface.frame = unit_frame(referenced_points(mesh));
  const std::vector<Vec3> positions = surface.frame.to_frame(welded.mesh.positions);
  const std::vector<LooseFace> faces =
      without_repeated(faces_with_area(mesh, welded, positions, sides));
  const std::vector<std::uint32_t> sample_of_welded = number_samples(positions, faces, surface);

  std::vector<Vec3> centres;
  centres.reserve(faces.size());
  for (const LooseFace& face : faces) {
    const auto& [a, b, c] = face.corners;
    centres.emplace_back(positions[a] + positions[b] + positions[c]);
  }
  for (const std::uint32_t f : morton_order(centres)) {
    const auto& [a, b, c] = faces[f].corners;
    surface.faces.push_back({sample_of_welded[a], sample_of_welded[b], sample_of_welded[c]});
    surface.area_vectors.push_back(faces[f].area_vector);
    surface.twice_areas.push_back(faces[f].area_vector.norm());
    surface.sides.push_back(faces[f].sides);
    surface.face_of_mesh.push_back(faces[f].of_mesh);
  }
  add_rounded(surface);

  // A vertex that no face names is never seen, even at a position that others use.
  surface.sample_of_vertex.assign(mesh.positions.size(), Surface::kNoSample);
  for (const Triangle& t : mesh.triangles) {
    for (const std::uint32_t v : t) {
      surface.sample_of_vertex[v] = sample_of_welded[welded.welded_of_vertex[v]];
    }
  }
  return surface;
}

Surface part_of(const Surface& whole, std::span<const std::uint32_t> samples,
                std::span<const std::uint32_t> faces) {
  Surface part;
  part.frame = whole.frame;
  for (const std::uint32_t i : samples) {
    part.samples.push_back(whole.samples[i]);
  }
  const auto place_of = [&](std::uint32_t sample) {
    return static_cast<std::uint32_t>(std::lower_bound(samples.begin(), samples.end(), sample) -
                                      samples.begin());
  };
  for (const std::uint32_t f : faces) {
    const auto& [a, b, c] = whole.faces[f];
    part.faces.push_back({place_of(a), place_of(b), place_of(c)});
    part.area_vectors.push_back(whole.area_vectors[f]);
    part.twice_areas.push_back(whole.twice_areas[f]);
    part.sides.push_back(whole.sides[f]);
    if (!whole.back_faces.empty()) {
      part.back_faces.push_back(whole.back_faces[f]);
    }
  }
  part.rounding = unit_frame(part.samples);
  add_rounded(part);
  return part;
}

Viewpoint eye_of_rounded(const Surface& surface, const Viewpoint& eye) {
  const bool is_place = eye.projection == Projection::Perspective;
  return {eye.projection, is_place ? surface.rounding.to_frame(eye.position) : eye.position};
}

void find_turned(const Surface& surface, const Viewpoint& eye, TurnedFaces& turned,
                 const RunContext& run) {
  const Viewpoint rounded_eye = eye_of_rounded(surface, eye);
  const FacePlanes& planes = surface.planes;
  const std::size_t count = surface.faces.size();
  std::vector<std::uint8_t>& of_face = turned.of_face;
  of_face.resize(count);
  const bool perspective = eye.projection == Projection::Perspective;
  const auto length = static_cast<float>(rounded_eye.position.norm());
  const Eigen::Vector3f at = rounded_eye.position.cast<float>();
  const float offset = perspective ? 1.0F : 0.0F;
  // Bounds the rounding of the float height below: a dozen roundings of numbers of this size.
  const float error_bound = 0x1p-19F * (length + 2.0F);
  find_turned_blocks(surface.blocks, rounded_eye, error_bound, turned.of_block);
  const auto faces_of = [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) {
      const float height = planes.x[f] * at.x() + planes.y[f] * at.y() + planes.z[f] * at.z() -
                           offset * planes.offset[f];
      const int side = height > 0.0F ? 1 : 2;
      of_face[f] = static_cast<std::uint8_t>(std::abs(height) > error_bound ? side : 3);
    }
    for (std::size_t f = begin; f < end; ++f) {
      if (of_face[f] == 3) {
        of_face[f] = exact_side(surface, f, eye);
      }
    }
  };
  constexpr std::size_t kFaces = FaceBlocks::kFaces;
  parallel_for(run, turned.of_block.size(), kBlockGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t block = begin; block < end; ++block) {
      const std::size_t first = block * kFaces;
      const std::size_t last = std::min(count, first + kFaces);
      if (turned.of_block[block] == 0) {
        faces_of(first, last);
      } else {
        std::fill(of_face.data() + first, of_face.data() + last, turned.of_block[block]);
      }
    }
  });
}

}  // namespace vantage
